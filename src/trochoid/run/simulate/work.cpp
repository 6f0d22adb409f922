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
  return {{.what = "angles of the forces",
           .count = rows,
           .evaluations = angles * evaluations_per_angle(given.setup, given.law) +
                          rows * row_evaluations,
           .bytes = rows * row_bytes,
           .key = {.name = listed ? "sampling.angles_deg" : "sampling.samples_per_rev",
                   .value = listed ? rows : double(s.samples_per_rev),
                   .of = listed ? " values" : ""}}};
}

}  // namespace trochoid::run
