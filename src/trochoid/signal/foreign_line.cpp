#include <trochoid/signal/foreign_line.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/median.h>
#include <trochoid/numerics/spectrum.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace trochoid::signal {

namespace {

constexpr double fewest_turns = 12.0;
constexpr std::size_t most_samples = std::size_t{1} << 17U;
constexpr double apart = 6.0;  ///< bins from a harmonic
constexpr double part_of_turn =
    0.04;  ///< of the spindle frequency: its speed is not exact
constexpr double stands_out = 50.0;  ///< times the median power between the harmonics
constexpr double least_line = 0.05;

/// Without its mean, under Hann's window.
std::vector<double> windowed(std::span<const double> values) {
  const auto n = static_cast<double>(values.size());
  const double mean = std::reduce(values.begin(), values.end()) / n;
  std::vector<double> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double w = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi *
                                          (static_cast<double>(i) + 0.5) / n);
    out.push_back(w * (values[i] - mean));
  }
  return out;
}

/// Power of each bin.
std::vector<double> powers(std::span<const double> values) {
  std::vector<double> out;
  for (const auto& X : numerics::real_spectrum(windowed(values))) {
    out.push_back(std::norm(X));
  }
  return out;
}

struct Grid {
  double step = 0.0;     ///< of the bins [Hz]
  double spindle = 0.0;  ///< [Hz]

  [[nodiscard]] bool between_harmonics(std::size_t bin) const {
    const double f = static_cast<double>(bin) * step;
    const double off = std::abs(f - spindle * std::round(f / spindle));
    return off > std::max(apart * step, part_of_turn * spindle);
  }
};

/// Largest bin between the harmonics that stands out; none: 0.
std::size_t peak_of(const std::vector<double>& power, const Grid& grid) {
  std::vector<double> between;
  std::size_t best = 0;
  for (std::size_t k = 3; k + 3 < power.size(); ++k) {
    if (!grid.between_harmonics(k)) continue;
    between.push_back(power[k]);
    if (best == 0 || power[k] > power[best]) best = k;
  }
  if (between.size() < 16) return 0;
  const double usual = numerics::median(std::move(between));
  return power[best] > stands_out * usual ? best : 0;
}

}  // namespace

std::optional<ForeignLine> foreign_line(
    const std::array<std::vector<double>, 3>& channels, double rate, double Omega) {
  const std::size_t size = std::min(channels[0].size(), most_samples);
  if (size < 64 || !(rate > 0.0) || !(Omega > 0.0)) return std::nullopt;
  const std::size_t n = numerics::fast_length(size);
  const Grid grid{rate / static_cast<double>(n), Omega / unit::turn};
  if (static_cast<double>(n) / rate * grid.spindle < fewest_turns) return std::nullopt;
  std::optional<ForeignLine> found;
  double all = 0.0;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const std::vector<double> power = powers(std::span(channels[c]).first(n));
    all += 2.0 * std::reduce(power.begin(), power.end());
    const std::size_t peak = peak_of(power, grid);
    if (peak == 0) continue;
    double line = 0.0;
    double place = 0.0;
    for (std::size_t k = peak - 2; k <= peak + 2; ++k) {
      line += 2.0 * power[k];
      place += 2.0 * power[k] * static_cast<double>(k);
    }
    if (found && !(line > found->share)) continue;
    found = ForeignLine{c, grid.step * place / line, line};
  }
  if (!found || !(all > 0.0)) return std::nullopt;
  found->share = std::sqrt(found->share / all);  // S-11
  return found->share >= least_line ? found : std::nullopt;
}

}  // namespace trochoid::signal
