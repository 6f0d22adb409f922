#include <trochoid/surface/bent_start.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace trochoid::surface {

namespace {

constexpr int angles_per_pitch = 5;
constexpr int starts_per_turn = 12;
constexpr std::size_t most_heights = 6;
constexpr std::size_t enough = 1500;
constexpr std::size_t kept = 3;

/// Rows at a few heights, as if all were taken at one place along the wall.
std::vector<Reading> sample_of(std::span<const Reading> rows) {
  std::map<double, std::size_t> heights;
  double x = 0.0;
  for (const Reading& r : rows) {
    heights.try_emplace(r.height, 0);
    x += r.x / static_cast<double>(rows.size());
  }
  std::size_t rank = 0;
  for (auto& [height, at] : heights) {
    at = rank++;
  }
  const bool scan = 4 * heights.size() > rows.size();
  const std::size_t every =
      scan ? 1 : (heights.size() + most_heights - 1) / most_heights;
  const std::size_t one_of = 1 + rows.size() / every / enough;
  std::vector<Reading> sample;
  std::size_t seen = 0;
  for (const Reading& r : rows) {
    if (heights.at(r.height) % every == 0 && seen++ % one_of == 0) {
      sample.push_back(r);
      sample.back().x = x;
    }
  }
  return sample;
}

/// Sum of squares about the mean of each height: the coefficients matter little then.
double misfit(std::span<const Reading> rows, std::span<const double> e) {
  struct Sums {
    double n = 0.0;
    double sum = 0.0;
    double squares = 0.0;
  };
  std::map<double, Sums> heights;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    Sums& at = heights[rows[i].height];
    const double r = rows[i].error - e[i];
    at.n += 1;
    at.sum += r;
    at.squares += r * r;
  }
  double total = 0.0;
  for (const auto& [height, at] : heights) {
    total += at.squares - at.sum * at.sum / at.n;
  }
  return total;
}

}  // namespace

std::vector<JointState> bent_starts(const Setting& setting,
                                    std::span<const Reading> rows, Feedback feedback,
                                    const JointState& about, double size) {
  const std::vector<Reading> sample = sample_of(rows);
  const ToothModel model(setting, sample);
  const int teeth = setting.setup.cutter.teeth();
  const double feed = teeth * setting.setup.cut.f_z;
  const int angles = model.labelled() ? angles_per_pitch * teeth : angles_per_pitch;
  const double range = model.labelled() ? unit::turn : unit::turn / teeth;
  const int starts = model.has_phase() ? starts_per_turn : 1;
  std::vector<std::pair<double, JointState>> tried;
  for (int a = 0; a < angles; ++a) {
    const double angle = range * a / angles;
    JointState state = about;
    state.runout = {size * std::cos(angle), size * std::sin(angle)};
    const auto forces =
        model.forces_with(feedback, model.forces(state.runout), state.K);
    for (int k = 0; forces.found && k < starts; ++k) {
      state.start = feed * k / starts;
      tried.emplace_back(
          misfit(sample, model.predict(forces, state.K, state.runout, state.start)),
          state);
    }
  }
  std::sort(tried.begin(), tried.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<JointState> best;
  for (std::size_t i = 0; i < std::min(kept, tried.size()); ++i) {
    best.push_back(tried[i].second);
  }
  return best;
}

}  // namespace trochoid::surface
