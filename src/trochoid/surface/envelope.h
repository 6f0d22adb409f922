#pragma once

#include <trochoid/base/units.h>
#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/pass.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What stays of a wall at one place, and who made it.
struct SurfacePoint {
  double error = 0.0;  ///< positive: material left [m]
  int tooth = 0;       ///< 0-based
  double phi = 0.0;    ///< spindle angle when it was made [rad]
};

/// @brief How the wall at one height comes into being.
struct HeightCut {
  Side side;
  double R = 0.0;                       ///< nominal radius of the cutter [m]
  double feed = 0.0;                    ///< of the tool per turn [m]
  double x_0 = 0.0;                     ///< of the axis at phi = 0 [m]
  std::vector<EdgePlace> teeth;         ///< at this height
  numerics::PeriodicPieces deflection;  ///< delta(phi), the first function [m]
  numerics::PeriodicPieces along = {};  ///< u_x(phi); without functions: none [m]
  double most_along = 0.0;              ///< no |u_x| is larger [m]
};

/// @brief The tooth whose tip entered the stock last, 0-based.
/// @param tips   the teeth at the tip
/// @param entry  theta at which an edge enters the stock [rad]
std::size_t last_entered(std::span<const EdgePlace> tips, double entry,
                         double phi) noexcept;

/// @brief Surface error of [wang2015]: what the cutter leaves at a spindle angle as if
/// it touched there, which is a pulse of force and no surface.
///
/// @eq E-7 e(phi, h) = delta(phi, h) - (R_i(h) - R), i: whose tip entered last
/// @src [wang2015] eq. 10
/// @param tooth  last_entered at phi
SurfacePoint quasi_static_error(const HeightCut& cut, std::size_t tooth,
                                double phi) noexcept;

/// @brief Error of the wall where each tooth touches it squarely.
/// @eq E-8 e_i(h) = delta(phi_i, h) - (R_i(h) - R), phi_i = theta_s + psi_i + lag(h)
/// @src [wang2015] section 4; derived
/// @return shape (teeth)
std::vector<SurfacePoint> imprint_errors(const HeightCut& cut);

/// @brief The wall that all passes of all teeth leave: nothing stands above any path.
/// @eq E-9 e(x, h) = min over passes of R + sigma R_i cos(theta) + delta(phi, h),
///         x = x_0 + f phi / 2 pi + R_i sin(theta)
/// @eq E-44 the same with x = x_0 + f phi / 2 pi + R_i sin(theta) + u_x(phi, h)
/// @src derived; one-sided form of the swept envelope
/// @param x  along the feed [m]
SurfacePoint envelope_error(const HeightCut& cut, double x) noexcept;

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

/// sin(t) and cos(t) to rounding; near the wall without libm's range reduction.
inline std::array<double, 2> sine_and_cosine(double t) noexcept {
  if (std::abs(t) > 0.5) {
    return {std::sin(t), std::cos(t)};
  }
  const double u = t * t;
  const double s = 1 - u / 42 * (1 - u / 72 * (1 - u / 110 * (1 - u / 156)));
  const double c = 1 - u / 30 * (1 - u / 56 * (1 - u / 90 * (1 - u / 132)));
  return {t * (1 - u / 6 * (1 - u / 20 * s)), 1 - u / 2 * (1 - u / 12 * c)};
}

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
    const double s = sine_and_cosine(0.5 * t)[0];
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
