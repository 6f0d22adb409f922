#pragma once

#include <trochoid/dynamics/period_elements.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/numerics/padded.h>

#include <span>
#include <vector>

namespace trochoid::dynamics {

/// @brief What the modes do over an element of a length and degree, whatever cuts in it.
///
/// @eq  D-4, over all modes: the parts of D-11 that do not depend on the cut
/// @src elementary
struct ElementResponse {
  int degree = 0;
  double duration = 0.0;  ///< [s]
  /// q at the nodes from the forces there (G of D-11) and the states at the start.
  numerics::PaddedMatrix motion;
  /// The states at the end from the same.
  numerics::PaddedMatrix end;
};

/// @param degree    0: nothing but the states, for free flight that nothing looks at
/// @param duration  of the element [s]
ElementResponse element_response(const std::vector<ChipMode>& modes,
                                 const Components& components, int degree,
                                 double duration);

/// @brief The same for motion along normals and forces along given directions.
///
/// @eq  D-15 n . (motion of a force along u)
/// @src elementary
ElementResponse response_along_normals(const ElementResponse& response,
                                       const PeriodElement& element);

/// Room for one elimination after another.
struct Elimination {
  numerics::PaddedMatrix system;
  std::vector<double> room;
};

/// @brief What an element answers while it cuts, whatever the delayed forces and the
/// states at its start are.
///
/// @eq D-11 (I - G A_0)^-1 [G, sum over modes of (x, y) Phi]
/// @src elementary
/// @param[in]  given     `motion` of the response
/// @param[in]  matrices  A_0, shape (components, components, nodes) [N/m]
/// @param[in]  force     times these
/// @param[out] motion    of the shape of `given`
void answer_cut(const numerics::PaddedMatrix& given, std::span<const double> matrices,
                double force, Elimination& work, numerics::PaddedMatrix& motion);

/// @brief The same with process damping: A_0 + D d/dphi in place of A_0.
///
/// @param[in] whole  of force_on_nodes
void answer_damped_cut(const numerics::PaddedMatrix& given,
                       const numerics::PaddedMatrix& whole, double force,
                       Elimination& work, numerics::PaddedMatrix& motion);

/// @brief The forces at the nodes of an element from q there: A_0 + D d/dphi.
///
/// @eq D-32 the slope of q at the nodes
/// @return shape (components nodes, components nodes) [N/m]; empty without damping
numerics::PaddedMatrix force_on_nodes(const PeriodElement& element);

}  // namespace trochoid::dynamics
