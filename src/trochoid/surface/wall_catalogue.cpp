#include <trochoid/surface/plan_wall.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::surface {

namespace {

/// Places in a tooth feed; more readings are laid over more turns.
constexpr int per_tooth = 4;
/// Heights that differ by less are one [m].
constexpr double same_height = 1e-10;

std::vector<double> sorted(std::span<const double> heights) {
  std::vector<double> out(heights.begin(), heights.end());
  std::sort(out.begin(), out.end());
  const auto same = [](double a, double b) { return b - a < same_height; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

}  // namespace

int whole_places(int per_height, int teeth) noexcept {
  const int in_each = (std::max(per_height, 1) + teeth - 1) / teeth;
  const int whole =
      in_each <= 2 ? in_each : per_tooth * ((in_each + per_tooth - 1) / per_tooth);
  return whole * teeth;
}

std::vector<double> heights_of(const WallDesign& design, double a_p) {
  std::vector<double> out;
  for (int i = 0; i < design.heights; ++i) {
    const double share = design.heights > 1 ? i / (design.heights - 1.0) - 0.5 : 0.0;
    out.push_back(a_p * (0.5 + design.spread * share));
  }
  return out;
}

WallCatalogue::WallCatalogue(const WallTrial& trial, std::span<const double> heights,
                             double position)
    : trial_(trial), heights_(sorted(heights)) {
  const double f_z = trial.setting.setup.cut.f_z;
  const bool numbered = trial.setting.model == Model::imprint;
  for (const double height : heights_) {
    for (int k = 0; k < trial.setting.setup.cutter.teeth(); ++k) {
      for (int p = 0; p < per_tooth; ++p) {
        const double within = numbered ? 0.0 : (p + 0.5) / per_tooth;
        rows_.push_back({.x = position,
                         .travel = position + f_z * (k + within),
                         .height = height,
                         .tooth = numbered ? k : -1});
      }
    }
  }
  derivatives_ = derivatives_of(trial, rows_);
}

std::size_t WallCatalogue::place_of(double height) const {
  const auto at =
      std::lower_bound(heights_.begin(), heights_.end(), height - same_height);
  if (at == heights_.end() || std::abs(*at - height) > 2 * same_height) {
    throw std::invalid_argument("a height that is not in the catalogue");
  }
  return static_cast<std::size_t>(at - heights_.begin());
}

void WallCatalogue::add(std::size_t height, int in_each, int turn,
                        PlannedReadings& out) const {
  const force::Setup& setup = trial_.setting.setup;
  const int teeth = setup.cutter.teeth();
  const int places = teeth * per_tooth;
  for (int i = 0; i < teeth * in_each; ++i) {
    // One, two half a tooth feed apart, or all.
    const int stride = per_tooth / in_each;
    const int place = i * stride + stride / 2 - (in_each == per_tooth ? 0 : 1);
    const auto row =
        height * static_cast<std::size_t>(places) + static_cast<std::size_t>(place);
    Reading reading = rows_[row];
    reading.travel += turn * teeth * setup.cut.f_z;
    out.readings.push_back(reading);
    out.row.push_back(row);
  }
}

PlannedReadings WallCatalogue::readings_of(const WallDesign& design) const {
  const int teeth = trial_.setting.setup.cutter.teeth();
  const int in_each = whole_places(design.per_height, teeth) / teeth;
  PlannedReadings out;
  for (const double height : heights_of(design, trial_.setting.setup.cut.a_p)) {
    const std::size_t at = place_of(height);
    for (int left = in_each, turn = 0; left > 0; left -= per_tooth, ++turn) {
      add(at, std::min(left, per_tooth), turn, out);
    }
  }
  return out;
}

PlannedReadings WallCatalogue::readings_at(double height, int count) const {
  const std::size_t at = place_of(height);
  const int places = trial_.setting.setup.cutter.teeth() * per_tooth;
  PlannedReadings out;
  for (int i = 0; i < count; ++i) {
    const auto row = at * static_cast<std::size_t>(places) +
                     static_cast<std::size_t>(i * places / count % places);
    out.readings.push_back(rows_[row]);
    out.row.push_back(row);
  }
  return out;
}

WallPrediction WallCatalogue::predict(const PlannedReadings& planned) const {
  return prediction_of(trial_, derivatives_, planned);
}

}  // namespace trochoid::surface
