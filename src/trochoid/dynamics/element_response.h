#pragma once

#include <trochoid/dynamics/period_elements.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/numerics/dense.h>

#include <array>
#include <vector>

namespace trochoid::dynamics {

/// @brief What the modes do over an element of a length and degree, whatever cuts in it.
///
/// @eq  D-4, over all modes: the parts of D-11 that do not depend on the cut
/// @src elementary
struct ElementResponse {
  int degree = 0;
  double duration = 0.0;  ///< [s]
  numerics::Matrix free;  ///< q at the nodes from the states at the start
  numerics::Matrix over;  ///< the states at the end from those at the start
  numerics::Matrix ends;  ///< the states at the end from the forces at the nodes
  /// Blocks of G of D-11 from one component to another; empty: zero.
  std::array<numerics::Matrix, 4> compliance;
};

/// @param degree    0: nothing but `over`, for free flight that nothing looks at
/// @param duration  of the element [s]
ElementResponse element_response(const std::vector<ChipMode>& modes,
                                 const Components& components, int degree,
                                 double duration);

}  // namespace trochoid::dynamics
