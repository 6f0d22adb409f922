#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/bodies.h>
#include <trochoid/surface/choices.h>
#include <trochoid/surface/edge_moments.h>

#include <array>
#include <span>
#include <string>

namespace trochoid::surface {

/// @brief Forces over a turn that repeats, deflection included.
struct SteadyState {
  numerics::PeriodicPieces moments;  ///< as of with_coefficients
  bool converged = false;
  bool found = true;    ///< false: at some angle no deflection agrees with its chip
  int turns = 0;        ///< passes over the turn until it repeated
  double change = 0.0;  ///< of the deflection in the last pass, relative to its peak
};

/// @brief The steady state, in which deflection and chip agree.
///
/// @eq E-10 u(phi, h) = sum_q G_q(h) m_q(phi; u): the stock is met at y + u, and the
///          chip over the mark of the m-th tooth before grows by
///          cos(theta) (u(phi) - u(phi - phi_m))
/// @src [wang2015] section 5 in words; derived. Without runout the chip term cancels.
/// @param K          wall_coefficients of the law
/// @param tolerance  relative, of force and deflection
SteadyState steady_state(const EdgeMoments& edges, std::span<const double, columns> K,
                         const Compliance& compliance, Feedback feedback,
                         double tolerance);

}  // namespace trochoid::surface
