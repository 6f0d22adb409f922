#include <trochoid/surface/envelope.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::surface {

namespace {

constexpr double turn = 2 * std::numbers::pi;

/// delta is the first of up to this many functions.
constexpr std::size_t most_functions = 8;

double first_value(const numerics::PeriodicPieces& f, double phi) noexcept {
  std::array<double, most_functions> values{};
  f.value(phi, std::span(values).first(f.functions()));
  return values[0];
}

/// How many turns before and after the nearest one are looked at. A turn farther away
/// stands feed^2/2R_e higher, which no deflection of a cut makes up for.
constexpr int turns_around = 2;

/// theta on a pass of a tooth where it is at x; none where it never is near the wall.
bool angle_at(const HeightCut& cut, const EdgePlace& tooth, double at_wall, double x,
              double& theta) noexcept {
  // x = x_wall + feed (theta - theta_s)/turn + R sin(theta), by Newton's method
  const double slope = cut.side.sigma > 0 ? -1.0 : 1.0;
  const double u = (x - at_wall) / tooth.R;
  if (std::abs(u) > 0.9) {
    return false;
  }
  double t = std::asin(std::clamp(u, -1.0, 1.0)) * slope;  // theta - theta_s
  for (int i = 0; i < 8; ++i) {
    const double value = cut.feed * t / turn + slope * tooth.R * std::sin(t);
    const double rate = cut.feed / turn + slope * tooth.R * std::cos(t);
    const double step = (x - at_wall - value) / rate;
    t += step;
    if (std::abs(step) < 1e-13) {
      break;
    }
  }
  theta = cut.side.theta + t;
  return std::abs(t) < 1.3;
}

}  // namespace

std::size_t last_entered(std::span<const EdgePlace> tips, double entry,
                         double phi) noexcept {
  constexpr double slack = 1e-9;  // [rad]: just entering counts
  std::size_t tooth = 0;
  double latest = turn;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    double since = std::fmod(phi - tips[i].behind - entry + slack, turn);
    since += since < 0 ? turn : 0.0;
    if (since < latest) {
      latest = since;
      tooth = i;
    }
  }
  return tooth;
}

SurfacePoint quasi_static_error(const HeightCut& cut, std::size_t tooth,
                                double phi) noexcept {
  return {first_value(cut.deflection, phi) - (cut.teeth[tooth].R - cut.R),
          static_cast<int>(tooth), phi};  // E-7
}

std::vector<SurfacePoint> imprint_errors(const HeightCut& cut) {
  std::vector<SurfacePoint> points;
  for (std::size_t i = 0; i < cut.teeth.size(); ++i) {
    const double phi = cut.side.theta + cut.teeth[i].behind;
    points.push_back({first_value(cut.deflection, phi) - (cut.teeth[i].R - cut.R),
                      static_cast<int>(i), phi});  // E-8
  }
  return points;
}

SurfacePoint envelope_error(const HeightCut& cut, double x) noexcept {
  SurfacePoint best{.error = std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < cut.teeth.size(); ++i) {
    const EdgePlace& tooth = cut.teeth[i];
    const double phi_wall = cut.side.theta + tooth.behind;
    const double first = cut.x_0 + cut.feed * phi_wall / turn;
    const double nearest = std::round((x - first) / cut.feed);
    for (int k = -turns_around; k <= turns_around; ++k) {
      const double n = nearest + k;
      double theta = 0.0;
      if (!angle_at(cut, tooth, first + n * cut.feed, x, theta)) {
        continue;
      }
      // As R + sigma R_i cos(theta), without its cancellation.
      const double s = std::sin(0.5 * (theta - cut.side.theta));
      const double rigid = cut.R - tooth.R + 2 * tooth.R * s * s;
      const double phi = theta + tooth.behind + n * turn;
      const double error = rigid + first_value(cut.deflection, phi);  // E-9
      if (error < best.error) {
        best = {error, static_cast<int>(i), phi};
      }
    }
  }
  return best;
}

}  // namespace trochoid::surface
