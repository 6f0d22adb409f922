#include <trochoid/run/simulate/work.h>

#include <algorithm>

namespace trochoid::run {

std::vector<Work> simulate_work(const inputs::Case& given) {
  // Measured: a row is kept, printed, and shown in the report.
  constexpr double row_evaluations = 6;
  constexpr double row_bytes = 250;
  const inputs::Sampling& s = given.sampling;
  const bool listed = !s.angles.empty();
  const double rows =
      listed ? static_cast<double>(s.angles.size()) : s.samples_per_rev * s.revolutions;
  // Turns repeat, and what repeats is not computed again.
  const double angles =
      listed ? rows : s.samples_per_rev * std::min(s.revolutions, 1.0);
  const double at_tip = evaluations_at_tip(given.setup, given.law);
  const double along = evaluations_per_angle(given.setup, given.law) - at_tip;
  const WorkKey key{.name = listed ? "sampling.angles_deg" : "sampling.samples_per_rev",
                    .value = listed ? rows : double(s.samples_per_rev),
                    .of = listed ? " values" : ""};
  std::vector<Work> parts = {{.what = "angles of the forces",
                              .count = rows,
                              .evaluations = angles * along + rows * row_evaluations,
                              .bytes = rows * row_bytes,
                              .key = key}};
  if (at_tip > 0) {
    const bool close = !listed && angles > most_angles_at_tip;
    parts.push_back({.what = "angles of the forces at the tip",
                     .count = close ? most_angles_at_tip : angles,
                     .evaluations = (close ? most_angles_at_tip : angles) * at_tip,
                     .key = key});
    parts.back().key.power = close ? 0.0 : 1.0;
  }
  return parts;
}

}  // namespace trochoid::run
