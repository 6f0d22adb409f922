#pragma once

#include <vector>

/// Motion of the tool against the work while it cuts.
namespace trochoid::dynamics {

/// @brief A mode of vibration as the chip feels it: it moves the tool along a direction
/// relative to the work.
///
/// @eq D-1 m eta'' + c eta' + k eta = (x, y) . F, F the force on the tool
/// @src [diez2010] eq. 8 to 13 in the axes of docs/notation.md
struct ChipMode {
  double mass = 0.0;       ///< [kg], positive
  double damping = 0.0;    ///< [N s/m], not negative
  double stiffness = 0.0;  ///< [N/m], positive
  double x = 1.0;          ///< unit direction; tool modes +, table modes -
  double y = 0.0;
  bool of_table = false;  ///< the work moves, against its direction in q
  // Of a complex mode, whose residue is turned; of a real one 1 and 0.
  double in_phase = 1.0;  ///< of D-35
  double lead = 0.0;      ///< [s]
};

/// @eq D-2  q = sum over modes of (x, y) eta: tool minus work
/// @eq D-35 of complex modes q = sum of (x, y) (in_phase eta + lead eta')
struct System {
  std::vector<ChipMode> modes;
};

}  // namespace trochoid::dynamics
