#include <trochoid/identification/turn_force.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

constexpr std::size_t first_intervals = 32;
/// Intervals are not halved below this [rad]: between them a kink is as good as found.
constexpr double smallest = 4e-7;

/// Values at x of the polynomials of degree four that are 1 in one of the nodes 0, 1/4,
/// ..., 1 and 0 in the others.
std::array<double, 5> weights(double x) noexcept {
  const double t = 4.0 * x;
  const double a = t - 1.0;
  const double b = t - 2.0;
  const double c = t - 3.0;
  const double d = t - 4.0;
  return {a * b * c * d / 24.0, -t * b * c * d / 6.0, t * a * c * d / 4.0,
          -t * a * b * d / 6.0, t * a * b * c / 24.0};
}

}  // namespace

force::Vector3 TurnForce::Interval::at(double phi) const noexcept {
  const std::array<double, 5> w = weights((phi - from) / width);
  force::Vector3 out{};
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t q = 0; q < 3; ++q) out[q] += w[i] * F[i][q];
  }
  return out;
}

/// The two halves of each interval.
std::vector<TurnForce::Interval> TurnForce::halved(
    const Function& force, const std::vector<Interval>& parents) {
  std::vector<double> phi;
  for (const Interval& p : parents) {
    for (const double x : {0.125, 0.375, 0.625, 0.875})
      phi.push_back(p.from + x * p.width);
  }
  const std::vector<force::Vector3> F = force(phi);
  evaluations_ += phi.size();
  std::vector<Interval> out;
  for (std::size_t i = 0; i < parents.size(); ++i) {
    const Interval& p = parents[i];
    const double half = 0.5 * p.width;
    out.push_back({p.from, half, {p.F[0], F[4 * i], p.F[1], F[4 * i + 1], p.F[2]}});
    out.push_back(
        {p.from + half, half, {p.F[2], F[4 * i + 2], p.F[3], F[4 * i + 3], p.F[4]}});
  }
  return out;
}

/// How far the parent is off at the nodes that its halves add [N].
double TurnForce::largest_miss(const Interval& parent, const Interval& left,
                               const Interval& right) const noexcept {
  double out = 0.0;
  for (const Interval* half : {&left, &right}) {
    for (const std::size_t i : {1U, 3U}) {
      const double phi = half->from + 0.25 * static_cast<double>(i) * half->width;
      const force::Vector3 F = parent.at(phi);
      for (std::size_t q = 0; q < 3; ++q) {
        out = std::max(out, std::abs(F[q] - half->F[i][q]));
      }
    }
  }
  return out;
}

TurnForce::TurnForce(const Function& force, double tolerance) {
  constexpr std::size_t nodes = 4 * first_intervals;
  std::vector<double> phi(nodes);
  for (std::size_t k = 0; k < nodes; ++k) {
    phi[k] = unit::turn * static_cast<double>(k) / static_cast<double>(nodes);
  }
  const std::vector<force::Vector3> F = force(phi);
  evaluations_ = nodes;
  double peak = 0.0;
  for (const force::Vector3& f : F) {
    for (const double v : f) peak = std::max(peak, std::abs(v));
  }
  std::vector<Interval> open;
  for (std::size_t i = 0; i < first_intervals; ++i) {
    Interval& one = open.emplace_back();
    one.from = phi[4 * i];
    one.width = unit::turn / static_cast<double>(first_intervals);
    for (std::size_t k = 0; k < 5; ++k) one.F[k] = F[(4 * i + k) % nodes];
  }
  while (!open.empty()) {
    const std::vector<Interval> halves = halved(force, open);
    std::vector<Interval> next;
    for (std::size_t i = 0; i < open.size(); ++i) {
      const Interval& left = halves[2 * i];
      const Interval& right = halves[2 * i + 1];
      const bool met = largest_miss(open[i], left, right) <= tolerance * peak;
      auto& to = met || left.width < smallest ? intervals_ : next;
      to.push_back(left);
      to.push_back(right);
    }
    open = std::move(next);
  }
  std::ranges::sort(intervals_, {}, &Interval::from);
}

force::Vector3 TurnForce::at(double phi) const noexcept {
  const double u = phi - unit::turn * std::floor(phi / unit::turn);
  const auto after = std::ranges::upper_bound(intervals_, u, {}, &Interval::from);
  return (after == intervals_.begin() ? after : std::prev(after))->at(u);
}

}  // namespace trochoid::identification
