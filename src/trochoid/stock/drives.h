#pragma once

#include <trochoid/stock/path.h>

#include <array>
#include <limits>
#include <vector>

namespace trochoid::stock {

/// What the axes of a machine can do.
struct Drives {
  std::array<double, 3> acceleration{};  ///< of x, y, z [m/s^2], above 0
  std::array<double, 3> feed{std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::infinity()};  ///< [m/s]
  double corner_tolerance = 0.0;  ///< by which a corner may be cut [m]; 0: a full stop
};

/// @brief How fast the tip really goes along a piece: up, level, down.
///
/// @eq N-12  v^2 = min(v_max^2, v_0^2 + 2 a s, v_1^2 + 2 a (l - s))
/// @src derived
struct Speed {
  double first = 0.0;         ///< v_0, where the piece begins [m/s]
  double last = 0.0;          ///< v_1, where it ends [m/s]
  double most = 0.0;          ///< v_max, of its feed and axes [m/s]
  double acceleration = 0.0;  ///< a along it [m/s^2]; infinite: at once
};

/// @brief Speed at a place of a piece [m/s].
/// @param length  of the piece [m]
/// @param s       from its start [m]
double speed_at(const Speed& speed, double length, double s) noexcept;

/// @brief Time from the start of a piece to a place on it [s].
double time_to(const Speed& speed, double length, double s) noexcept;

/// @brief Speeds of the pieces of a path that a machine with these drives keeps to; its
/// times and turns of the spindle are made those of the machine.
///
/// The machine stands where the path is interrupted, and at kinks above 1 degree without a
/// tolerance.
/// @eq N-13  v^2 <= a rho on arcs; v^2 <= a d cos(t/2)/(1 - cos(t/2)) at a kink by t with
///           the tolerance d
/// @src derived; a kink: circle that touches both sides and comes within d of the corner
/// @return shape (pieces)
std::vector<Speed> speeds(Path& path, double rapid_feed, const Drives& drives);

/// @brief The same for a machine that has every feed at once.
std::vector<Speed> speeds(const Path& path, double rapid_feed);

/// @brief The largest acceleration along a direction [m/s^2]: a = min a_i/|u_i|.
double acceleration_along(const Drives& drives, const Point& direction) noexcept;

/// @brief The largest feed along a direction [m/s].
double feed_along(const Drives& drives, const Point& direction) noexcept;

}  // namespace trochoid::stock
