#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>
#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/feedback.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief A turn with feedback at equal steps of the spindle angle.
struct StepwiseTurn {
  std::size_t steps = 0;
  std::vector<double> moments;   ///< shape (steps, basis points + 2): m_q, F_x, F_y
  std::vector<double> straight;  ///< the same of a cutter that does not bend
  bool converged = false;
};

/// @brief The steady state (E-10) step by step: fast, and good to some parts in a
/// thousand, where steady_state is slow and as good as asked.
///
/// The edges of a cylinder enter and leave where its lag says; the chip is taken at Gauss
/// points between. Tooth by tooth the past is what was found a pitch ago.
/// @param K      wall_coefficients of the law
/// @param start  of another cut close to this one, or none
StepwiseTurn stepwise_steady_state(const force::Setup& setup, const force::Law& law,
                                   std::span<const double, columns> K,
                                   const Compliance& compliance, Feedback feedback,
                                   const StepwiseTurn* start = nullptr);

/// @brief The steady state as a table over the turn: what feedback changes, a cubic
/// between the steps, on top of what it changes.
/// @param straight  moments of a cutter that does not bend, of with_coefficients
numerics::PeriodicPieces with_feedback(const numerics::PeriodicPieces& straight,
                                       const StepwiseTurn& turn);

}  // namespace trochoid::surface
