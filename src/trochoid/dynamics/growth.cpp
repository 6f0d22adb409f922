#include <trochoid/dynamics/growth.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

namespace trochoid::dynamics {

namespace {

using Point = std::array<double, 2>;

/// Changes of a stretch, and what a recurrence may leave unexplained.
constexpr std::size_t stretch = 6;
constexpr double unexplained = 0.02;
std::vector<Point> changes(std::span<const Point> once) {
  std::vector<Point> d;
  for (std::size_t n = 1; n < once.size(); ++n) {
    d.push_back({once[n][0] - once[n - 1][0], once[n][1] - once[n - 1][1]});
  }
  return d;
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1];
}

struct Recurrence {
  double growth = 0.0;
  double left = 0.0;  ///< of the changes, as a part
};

/// Least squares of d_(n+1) = a d_n + b d_(n-1).
std::optional<Recurrence> recurrence(std::span<const Point> d) {
  double aa = 0.0;
  double ab = 0.0;
  double bb = 0.0;
  double ay = 0.0;
  double by = 0.0;
  double yy = 0.0;
  for (std::size_t n = 1; n + 1 < d.size(); ++n) {
    aa += dot(d[n], d[n]);
    ab += dot(d[n], d[n - 1]);
    bb += dot(d[n - 1], d[n - 1]);
    ay += dot(d[n], d[n + 1]);
    by += dot(d[n - 1], d[n + 1]);
    yy += dot(d[n + 1], d[n + 1]);
  }
  const double determinant = aa * bb - ab * ab;
  if (!(yy > 0)) {
    return std::nullopt;
  }
  double a = ay / aa;  // a single multiplier: the two columns are one
  double b = 0.0;
  if (determinant > 1e-10 * aa * bb) {
    a = (ay * bb - by * ab) / determinant;
    b = (by * aa - ay * ab) / determinant;
  }
  const double left = std::max(0.0, yy - a * ay - b * by) / yy;
  const std::complex<double> root = std::sqrt(std::complex<double>(0.25 * a * a + b));
  return Recurrence{std::max(std::abs(0.5 * a + root), std::abs(0.5 * a - root)),
                    std::sqrt(left)};
}

double mean_square(std::span<const Point> d) {
  double sum = 0.0;
  for (const Point& p : d) {
    sum += dot(p, p);
  }
  return sum / static_cast<double>(d.size());
}

}  // namespace

std::optional<double> growth_per_turn(std::span<const Point> once, double small) {
  const std::vector<Point> d = changes(once);
  std::optional<Recurrence> best;
  for (std::size_t n = 0; n + stretch <= d.size(); ++n) {
    const auto part = std::span(d).subspan(n, stretch);
    if (std::any_of(part.begin(), part.end(),
                    [&](const Point& p) { return dot(p, p) > small * small; })) {
      continue;
    }
    const auto fit = recurrence(part);
    if (fit && fit->left < unexplained && (!best || fit->left < best->left)) {
      best = fit;
    }
  }
  return best ? std::optional(best->growth) : std::nullopt;  // T-11
}

std::optional<double> late_change(std::span<const Point> once) {
  if (once.size() < 9) {
    return std::nullopt;
  }
  const std::vector<Point> d = changes(once);
  const std::size_t quarter = d.size() / 4;
  const std::span all(d);
  const double late = mean_square(all.last(quarter));
  const double before = mean_square(all.subspan(d.size() - 2 * quarter, quarter));
  return before > 0 ? std::optional(std::sqrt(late / before)) : std::nullopt;
}

double late_size(std::span<const Point> once) {
  const std::vector<Point> d = changes(once);
  double largest = 0.0;
  for (std::size_t n = d.size() - d.size() / 4; n < d.size(); ++n) {
    largest = std::max(largest, std::sqrt(dot(d[n], d[n])));
  }
  return largest;
}

}  // namespace trochoid::dynamics
