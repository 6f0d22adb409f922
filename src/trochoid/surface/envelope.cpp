#include <trochoid/surface/envelope.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

/// delta is the first of up to this many functions.
constexpr std::size_t most_functions = 8;

double first_value(const numerics::PeriodicPieces& f, double phi) noexcept {
  std::array<double, most_functions> values{};
  f.value(phi, std::span(values).first(f.functions()));
  return values[0];
}

/// Farther from the wall than this a tooth does not make it [rad].
constexpr double near_the_wall = 1.3;

/// theta - theta_s on a pass of a tooth where it is at x; none where it never is.
///
/// @param dx  x, from where this pass touches the wall squarely
bool angle_at(const HeightCut& cut, double R, double dx, double& t) noexcept {
  // dx = feed t/turn + slope R sin(t), by Newton's method
  const double slope = cut.side.sigma > 0 ? -1.0 : 1.0;
  const double along = cut.feed / unit::turn;
  if (std::abs(dx) > 0.9 * R) {
    return false;
  }
  t = dx / (along + slope * R);
  for (int i = 0; i < 8; ++i) {
    const double sine = std::sin(t);
    const double cosine = std::cos(t);
    const double step =
        (dx - along * t - slope * R * sine) / (along + slope * R * cosine);
    t += step;
    if (std::abs(step) < 1e-9) {  // the next one would be its square
      break;
    }
  }
  return std::abs(t) < near_the_wall;
}

}  // namespace

std::size_t last_entered(std::span<const EdgePlace> tips, double entry,
                         double phi) noexcept {
  constexpr double slack = 1e-9;  // [rad]: just entering counts
  std::size_t tooth = 0;
  double latest = unit::turn;
  for (std::size_t i = 0; i < tips.size(); ++i) {
    double since = std::fmod(phi - tips[i].behind - entry + slack, unit::turn);
    since += since < 0 ? unit::turn : 0.0;
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
  const double lowest = cut.deflection.lower_bound(0);
  SurfacePoint best{.error = std::numeric_limits<double>::infinity()};
  // Whether a pass so many turns after the one nearest to x may still reach lower.
  const auto reaches = [&](std::size_t i, int turns) {
    const EdgePlace& tooth = cut.teeth[i];
    const double phi_wall = cut.side.theta + tooth.behind;
    const double first = cut.x_0 + cut.feed * phi_wall / unit::turn;
    const double n = std::round((x - first) / cut.feed) + turns;
    const double dx = x - first - n * cut.feed;
    // 1 - cos(t) >= sin(t)^2/2, and |dx| <= R |sin(t)| + feed |t|/turn.
    const double sine = dx / (tooth.R + 1.35 * cut.feed / unit::turn);
    if (cut.R - tooth.R + 0.5 * tooth.R * sine * sine + lowest >= best.error) {
      return false;  // and the passes beyond stand higher still
    }
    double t = 0.0;
    if (!angle_at(cut, tooth.R, dx, t)) {
      return false;
    }
    // As R + sigma R_i cos(theta), without its cancellation.
    const double s = std::sin(0.5 * t);
    const double phi = phi_wall + t + n * unit::turn;
    const double error = cut.R - tooth.R + 2 * tooth.R * s * s +
                         first_value(cut.deflection, phi);  // E-9
    if (error < best.error) {
      best = {error, static_cast<int>(i), phi};
    }
    return true;
  };
  for (std::size_t i = 0; i < cut.teeth.size(); ++i) {
    reaches(i, 0);
  }
  for (std::size_t i = 0; i < cut.teeth.size(); ++i) {
    for (const int side : {-1, 1}) {
      for (int k = 1; reaches(i, side * k); ++k) {
      }
    }
  }
  return best;
}

}  // namespace trochoid::surface
