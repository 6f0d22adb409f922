#pragma once

#include <trochoid/base/units.h>
#include <trochoid/surface/pass.h>

#include <cmath>
#include <cstddef>
#include <span>

namespace trochoid::surface {

/// @brief How the teeth pass a wall at one height, whatever bends.
struct Passes {
  Side side;
  double R = 0.0;                    ///< nominal radius of the cutter [m]
  double feed = 0.0;                 ///< of the tool per turn [m]
  double x_0 = 0.0;                  ///< of the axis at phi = 0 [m]
  std::span<const EdgePlace> teeth;  ///< at this height
};

/// @brief theta - theta_s on a pass of a tooth where it is at x; false where it never is.
/// @param R   of the tooth [m]
/// @param dx  x, from where this pass touches the wall squarely [m]
bool angle_at(const Passes& passes, double R, double dx, double& t) noexcept;

/// @brief Passes of all teeth at x, the nearest of each first, then those farther off.
///
/// @param worth  worth(bound): may a pass count that leaves bound or more [m], before
///               any deflection? Those beyond one that may not leave more still.
/// @param visit  visit(tooth, phi, rise): R + sigma R_i cos(theta) of E-9 is rise [m]
template <class Worth, class Visit>
void for_each_pass(const Passes& passes, double x, const Worth& worth,
                   const Visit& visit) noexcept {
  const auto reaches = [&](std::size_t i, int turns) {
    const EdgePlace& tooth = passes.teeth[i];
    const double phi_wall = passes.side.theta + tooth.behind;
    const double first = passes.x_0 + passes.feed * phi_wall / unit::turn;
    const double n = std::round((x - first) / passes.feed) + turns;
    const double dx = x - first - n * passes.feed;
    // 1 - cos(t) >= sin(t)^2/2, and |dx| <= R |sin(t)| + feed |t|/turn.
    const double sine = dx / (tooth.R + 1.35 * passes.feed / unit::turn);
    double t = 0.0;
    if (!worth(passes.R - tooth.R + 0.5 * tooth.R * sine * sine) ||
        !angle_at(passes, tooth.R, dx, t)) {
      return false;
    }
    // As R + sigma R_i cos(theta), without its cancellation.
    const double s = std::sin(0.5 * t);
    visit(i, phi_wall + t + n * unit::turn, passes.R - tooth.R + 2 * tooth.R * s * s);
    return true;
  };
  for (std::size_t i = 0; i < passes.teeth.size(); ++i) {
    reaches(i, 0);
  }
  for (std::size_t i = 0; i < passes.teeth.size(); ++i) {
    for (const int side : {-1, 1}) {
      for (int k = 1; reaches(i, side * k); ++k) {
      }
    }
  }
}

}  // namespace trochoid::surface
