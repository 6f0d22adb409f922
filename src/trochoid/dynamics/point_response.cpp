#include <trochoid/dynamics/point_response.h>
#include <trochoid/structure/thinned.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace trochoid::dynamics {

namespace {

using Complex = std::complex<double>;

/// Four lines in a row, or all of a response with fewer.
struct Window {
  const MeasuredReceptance& part;
  std::size_t first = 0;
  std::size_t count = 0;

  /// Of omega in the polynomial through the lines.
  [[nodiscard]] double weight(std::size_t i, double omega) const {
    double w = 1.0;
    for (std::size_t j = first; j < first + count; ++j) {
      if (j != i) {
        w *= (omega - part.omega[j]) / (part.omega[i] - part.omega[j]);
      }
    }
    return w;
  }
};

/// H (omega - p) is a parabola through four lines; without a pole a cubic.
Complex between_lines(const Window& window, double omega, Complex pole,
                      bool with_pole) {
  Complex sum;
  for (std::size_t i = window.first; i < window.first + window.count; ++i) {
    const Complex H = window.part.H[i];
    sum +=
        window.weight(i, omega) * (with_pole ? H * (window.part.omega[i] - pole) : H);
  }
  return with_pole ? sum / (omega - pole) : sum;
}

/// @brief The pole that four lines have between them: the third divided difference of
/// (omega - p) H is 0 (D-34).
Complex pole_of(const Window& window) {
  Complex of_H;
  Complex of_moment;
  const double origin = window.part.omega[window.first];
  for (std::size_t i = window.first; i < window.first + window.count; ++i) {
    double product = 1.0;
    for (std::size_t j = window.first; j < window.first + window.count; ++j) {
      if (j != i) product *= window.part.omega[i] - window.part.omega[j];
    }
    of_H += window.part.H[i] / product;
    of_moment += (window.part.omega[i] - origin) * window.part.H[i] / product;
  }
  return origin + of_moment / of_H;
}

/// Third differences above this fraction of the response: it bends between its lines.
constexpr double bends = 0.02;
/// A pole nearer to the real axis than this fraction of a line's distance is none that
/// lines show.
constexpr double least_width = 0.2;
/// Neighbours of four lines see the same pole, within this fraction of its distance from
/// the real axis; what noise makes differs from four lines to the next.
constexpr double same_pole = 0.3;

/// Whether a cubic through these lines is not enough.
bool bends_in(const Window& window) {
  const auto* H = window.part.H.data() + window.first;
  const double third = std::abs(H[3] - 3.0 * H[2] + 3.0 * H[1] - H[0]);
  double most = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    most = std::max(most, std::abs(H[i]));
  }
  return third > bends * most;
}

/// Whether a pole is that of a resonance: the four lines before or after see it too.
bool is_resonance(const Window& window, Complex pole) {
  const MeasuredReceptance& part = window.part;
  const double distance = (part.omega[window.first + 3] - part.omega[window.first]) / 3;
  if (!(pole.imag() > least_width * distance)) {
    return false;
  }
  const auto agrees = [&](std::size_t first) {
    const Complex other = pole_of({part, first, 4});
    return std::abs(other - pole) < same_pole * pole.imag();
  };
  return (window.first > 0 && agrees(window.first - 1)) ||
         (window.first + 4 < part.omega.size() && agrees(window.first + 1));
}

/// From the four lines around omega, or from all if there are fewer.
Complex between_lines(const MeasuredReceptance& part, double omega) {
  const std::size_t n = part.omega.size();
  const std::size_t count = std::min<std::size_t>(4, n);
  const auto above = std::upper_bound(part.omega.begin(), part.omega.end(), omega);
  const auto after = static_cast<std::size_t>(above - part.omega.begin());
  const Window window{
      part, std::min(after > count / 2 ? after - count / 2 : 0, n - count), count};
  if (count < 4 || !bends_in(window)) {
    return between_lines(window, omega, {}, false);
  }
  const Complex pole = pole_of(window);
  return between_lines(window, omega, pole, is_resonance(window, pole));  // D-34
}

std::complex<double> at(const MeasuredReceptance& part, double omega) {
  if (omega < part.omega.front()) {
    return part.H.front().real();
  }
  if (omega > part.omega.back()) {
    return 0.0;
  }
  return between_lines(part, omega);
}

}  // namespace

ComplexMatrix2 receptance(const PointResponse& point, double omega) noexcept {
  ComplexMatrix2 G{};
  for (const MeasuredReceptance& part : point.parts) {
    G[2 * part.motion + part.force] += at(part, std::abs(omega));
  }
  if (omega < 0) {
    for (std::complex<double>& g : G) {
      g = std::conj(g);
    }
  }
  return G;  // D-20
}

Band band_of(const PointResponse& point) noexcept {
  Band band{0.0, std::numeric_limits<double>::infinity()};
  for (const MeasuredReceptance& part : point.parts) {
    band.from = std::max(band.from, part.omega.front());
    band.to = std::min(band.to, part.omega.back());
  }
  return band;
}

namespace {

/// A resonance is this much of the largest, at least.
constexpr double least_peak = 0.05;
/// And so many times the scatter of the lines: its flanks then are six times as far below.
constexpr double above_scatter = 20.0;

/// Scatter around a line: noise of an accelerometer grows towards slow lines. So many
/// lines that a coarse peak among them is not their median.
double scatter_around(std::span<const Complex> H, std::size_t line) {
  constexpr std::size_t beside = 20;
  const std::size_t from = line > beside ? line - beside : 0;
  return structure::scatter_of_lines(
      H.subspan(from, std::min(2 * beside + 1, H.size() - from)));
}

/// @brief From a line down the flank of a peak, to the last above half of its power.
/// @return nothing where the response rises above the top first
std::optional<std::size_t> flank(const std::vector<double>& size, std::size_t top,
                                 std::ptrdiff_t step) {
  const double half_power = size[top] / std::sqrt(2.0);
  auto i = static_cast<std::ptrdiff_t>(top);
  const auto n = static_cast<std::ptrdiff_t>(size.size());
  while (i + step >= 0 && i + step < n) {
    const double next = size[static_cast<std::size_t>(i + step)];
    if (next > size[top]) return std::nullopt;
    if (next < half_power) break;
    i += step;
  }
  return static_cast<std::size_t>(i);
}

}  // namespace

std::vector<Peak> peaks(const MeasuredReceptance& part) {
  std::vector<double> size;
  for (const Complex& H : part.H) size.push_back(std::abs(H));
  const double least = least_peak * std::ranges::max(size);
  std::vector<Peak> found;
  for (std::size_t top = 0; top < size.size(); ++top) {
    const bool rises = top == 0 || size[top] > size[top - 1];
    if (!rises || size[top] < least) continue;
    const auto from = flank(size, top, -1);
    const auto to = flank(size, top, 1);
    if (!from || !to) continue;
    if (size[top] < above_scatter * scatter_around(part.H, top)) continue;
    found.push_back({.omega = part.omega[top],
                     .width = part.omega[*to] - part.omega[*from],
                     .lines = *to - *from + 1,
                     .height = size[top],
                     .at_the_edge = top == 0 || top + 1 == size.size()});
  }
  return found;
}

double line_distance(const PointResponse& point) noexcept {
  double least = std::numeric_limits<double>::infinity();
  for (const MeasuredReceptance& part : point.parts) {
    const auto lines = static_cast<double>(part.omega.size() - 1);
    least = std::min(least, (part.omega.back() - part.omega.front()) / lines);
  }
  return least;
}

}  // namespace trochoid::dynamics
