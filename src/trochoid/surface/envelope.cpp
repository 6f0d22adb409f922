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

/// @brief A pass of a cutter that bends along the feed by u_x: where it is at the same x.
/// @param[in,out] phi, rise  without u_x; then with it (E-44)
bool move_along(const HeightCut& cut, const Passes& passes, std::size_t tooth,
                double& phi, double& rise) noexcept {
  constexpr int most_steps = 20;
  constexpr double enough = 1e-9;  // [rad]
  const EdgePlace& place = passes.teeth[tooth];
  const double slope = passes.side.sigma > 0 ? -1.0 : 1.0;
  const double phi_wall = passes.side.theta + place.behind;
  const double turns = unit::turn * std::round((phi - phi_wall) / unit::turn);
  const double first = phi - phi_wall - turns;
  const double dx =
      passes.feed * first / unit::turn + slope * place.R * std::sin(first);
  double t = first;
  for (int i = 0; i < most_steps; ++i) {
    const double before = t;
    if (!angle_at(passes, place.R,
                  dx - first_value(cut.along, phi_wall + turns + before), t)) {
      return false;
    }
    if (std::abs(t - before) < enough) {
      break;
    }
  }
  phi = phi_wall + turns + t;
  const double s = std::sin(0.5 * t);
  rise = passes.R - place.R + 2 * place.R * s * s;
  return true;
}

/// So steep a path may be where it still makes the wall.
constexpr double steepest = 0.3;

}  // namespace

bool angle_at(const Passes& passes, double R, double dx, double& t) noexcept {
  // dx = feed t/turn + slope R sin(t), by Newton's method
  const double slope = passes.side.sigma > 0 ? -1.0 : 1.0;
  const double along = passes.feed / unit::turn;
  if (std::abs(dx) > 0.9 * R) {
    return false;
  }
  t = dx / (along + slope * R);
  t += slope * R * t * t * t / 6 / (along + slope * R * (1 - t * t / 2));
  for (int i = 0; i < 8; ++i) {
    const auto [sine, cosine] = sine_and_cosine(t);
    const double step =
        (dx - along * t - slope * R * sine) / (along + slope * R * cosine);
    t += step;
    if (std::abs(step) < 1e-9) {  // the next one would be its square
      break;
    }
  }
  return std::abs(t) < near_the_wall;
}

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
  const Passes passes{cut.side, cut.R, cut.feed, cut.x_0, cut.teeth};
  const double slack = steepest * cut.most_along;  // a moved pass may come lower
  SurfacePoint best{.error = std::numeric_limits<double>::infinity()};
  for_each_pass(
      passes, x, [&](double bound) { return bound - slack + lowest < best.error; },
      [&](std::size_t tooth, double phi, double rise) {
        if (cut.along.functions() != 0 && !move_along(cut, passes, tooth, phi, rise)) {
          return;
        }
        const double error = rise + first_value(cut.deflection, phi);  // E-9
        if (error < best.error) {
          best = {error, static_cast<int>(tooth), phi};
        }
      });
  return best;
}

}  // namespace trochoid::surface
