#pragma once

#include <trochoid/geometry/arcs.h>

#include <limits>
#include <variant>

namespace trochoid::geometry {

struct Slot {};
struct UpMilling {
  double a_e = 0.0;  ///< radial depth [m], in (0, D]
};
struct DownMilling {
  double a_e = 0.0;  ///< radial depth [m], in (0, D]
};
/// Stock between two y, infinite ahead of the tool in x.
struct Band {
  double y_lo = -std::numeric_limits<double>::infinity();  ///< [m]
  double y_hi = std::numeric_limits<double>::infinity();   ///< [m]
};
/// The last one says by height where on its circle a cutter meets stock.
using Engagement = std::variant<Slot, UpMilling, DownMilling, Band, Arcs>;

/// @brief The cut, in the workpiece frame: feed along +x, z up from the tool tip.
struct Cut {
  Engagement engagement;
  double a_p = 0.0;    ///< axial depth [m]
  double f_z = 0.0;    ///< feed per tooth [m], at least 0; feed per turn = teeth f_z
  double Omega = 0.0;  ///< spindle speed [rad/s]
};

/// @brief Stock of an engagement as a band in y; that of arcs is everywhere, as they are
/// not a band.
/// @eq G-11 up: y >= D/2 - a_e; down: y <= -(D/2 - a_e); band: y_lo <= y <= y_hi
/// @param D  nominal diameter [m], to which radial depths refer
Band stock_band(const Engagement& engagement, double D);

}  // namespace trochoid::geometry
