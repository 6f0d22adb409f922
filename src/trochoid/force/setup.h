#pragma once

#include <trochoid/chip/model.h>
#include <trochoid/force/law.h>
#include <trochoid/geometry/cut.h>
#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/runout.h>

namespace trochoid::force {

/// @brief Everything that makes a cut except its force coefficients.
struct Setup {
  geometry::Cutter cutter;
  geometry::Runout runout;
  geometry::Cut cut;
  chip::ChipModel chip;
  EdgeLength edge_length = EdgeLength::true_length;
};

}  // namespace trochoid::force
