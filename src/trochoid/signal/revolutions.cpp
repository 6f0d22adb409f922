#include <trochoid/signal/revolutions.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::signal {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Sums of one bin; x from its middle, in units of its width.
struct Bin {
  int count = 0;
  double x = 0.0;
  double xx = 0.0;
  std::array<double, 3> y{};
  std::array<double, 3> xy{};
  std::array<double, 3> yy{};
};

/// Where a sample falls.
struct Place {
  std::size_t bin = 0;
  double x = 0.0;
};

Place place_of(double angle, std::size_t bins) {
  const double turns = angle / unit::turn;
  const double at = (turns - std::floor(turns)) * static_cast<double>(bins);
  // An angle at the edge of two bins falls into the upper one, despite rounding.
  const double lower = std::floor(at + 1e-9);
  return {static_cast<std::size_t>(lower) % bins, at - lower - 0.5};
}

/// Means first, then squares about them.
std::vector<Bin> sums(const std::array<std::vector<double>, 3>& channels,
                      std::span<const double> angle, double end, std::size_t bins) {
  std::vector<Bin> out(bins);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    if (angle[i] >= end) continue;
    const auto place = place_of(angle[i], bins);
    auto& bin = out[place.bin];
    ++bin.count;
    bin.x += place.x;
    for (std::size_t c = 0; c < 3; ++c) bin.y[c] += channels[c][i];
  }
  for (auto& bin : out) {
    const double n = std::max(bin.count, 1);
    bin.x /= n;
    for (double& y : bin.y) y /= n;
  }
  for (std::size_t i = 0; i < angle.size(); ++i) {
    if (angle[i] >= end) continue;
    const auto place = place_of(angle[i], bins);
    auto& bin = out[place.bin];
    const double dx = place.x - bin.x;
    bin.xx += dx * dx;
    for (std::size_t c = 0; c < 3; ++c) {
      const double dy = channels[c][i] - bin.y[c];
      bin.xy[c] += dx * dy;
      bin.yy[c] += dy * dy;
    }
  }
  return out;
}

void read_bin(const Bin& bin, std::size_t k, OneRevolution& out) {
  out.count[k] = bin.count;
  if (bin.count == 0) return;
  // A line needs angles that really differ.
  const bool line = bin.count >= 4 && bin.xx > 1e-4 * bin.count;
  const int free = bin.count - (line ? 2 : 1);
  // Beyond its samples a line foretells noise: at most a standard deviation of them away.
  const double reach = std::sqrt(bin.xx / bin.count);
  const double away = std::clamp(-bin.x, -reach, reach);
  for (std::size_t c = 0; c < 3; ++c) {
    const double slope = line ? bin.xy[c] / bin.xx : 0.0;
    out.mean[c][k] = bin.y[c] + slope * away;
    const double rest = bin.yy[c] - slope * bin.xy[c];
    if (free > 0) out.scatter[c][k] = std::sqrt(std::max(0.0, rest) / free);
  }
}

}  // namespace

std::vector<double> unwrapped(std::span<const double> angle) {
  std::vector<double> out(angle.begin(), angle.end());
  double add = 0.0;
  for (std::size_t i = 1; i < out.size(); ++i) {
    const double step = angle[i] - angle[i - 1];
    if (std::abs(step) > 0.5 * unit::turn)
      add -= unit::turn * std::round(step / unit::turn);
    out[i] = angle[i] + add;
  }
  return out;
}

OneRevolution fold(const std::array<std::vector<double>, 3>& channels,
                   std::span<const double> angle, int bins) {
  const auto n = angle.size();
  if (bins < 1 || channels[0].size() != n || channels[1].size() != n ||
      channels[2].size() != n) {
    throw std::invalid_argument("fold: one angle and three forces a sample are needed");
  }
  const auto b = static_cast<std::size_t>(bins);
  OneRevolution out;
  out.count.assign(b, 0);
  for (std::size_t k = 0; k < b; ++k) {
    out.angle.push_back((static_cast<double>(k) + 0.5) * unit::turn / bins);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    out.mean[c].assign(b, nan);
    out.scatter[c].assign(b, nan);
  }
  if (n == 0) return out;
  // One sample more than the last whole turn would count its angle twice.
  const double step =
      n > 1 ? (angle[n - 1] - angle[0]) / static_cast<double>(n - 1) : 0;
  const double turns = std::floor((angle[n - 1] - angle[0] + step) / unit::turn + 1e-9);
  out.revolutions = static_cast<int>(std::clamp(turns, 0.0, 1e9));
  const double end = turns >= 1.0 ? angle[0] + turns * unit::turn - 0.5 * step
                                  : std::numeric_limits<double>::infinity();
  const auto bin = sums(channels, angle, end, b);
  for (std::size_t k = 0; k < b; ++k) read_bin(bin[k], k, out);
  return out;
}

}  // namespace trochoid::signal
