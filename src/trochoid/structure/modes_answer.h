#pragma once

#include <trochoid/structure/modes_fit.h>
#include <trochoid/structure/modes_search.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::structure {

/// @brief Lines between the half-power points of a term.
int lines_in_peak(const FrequencyResponse& lines, const ModeTerm& term);

/// @brief A fitted residue as a mode, an exponential window taken out (M-22).
/// @param window_decay  [1/s]; may be more than the mode decays by: then its damping is
///                      not positive
FittedMode fitted_mode(const ModesSolution& solution, std::size_t r,
                       double window_decay);

/// @brief Covariance of natural frequency [rad/s], damping ratio and mass [kg] of some
/// terms, as fitted_mode gives them, those of one term behind those of another.
/// @return row-major, shape (3 terms, 3 terms); empty as that of the solution
std::vector<double> mode_covariance(const ModesSolution& solution,
                                    std::span<const std::size_t> terms,
                                    double window_decay);

/// @brief A fitted shape as a mode with its standard errors.
///
/// @eq  M-33  m = 1/sum |phi_j|^2, k = m omega_r^2, c = 2 m zeta_r omega_r, the angle of
///            atan2(Re phi_y, Re phi_x), the fraction |Im phi|/|phi|; their errors by
///            their derivatives and the covariance of M-31
/// @src derived
FittedMode shape_mode(Responses all, const ModesSolution& solution, std::size_t r);

/// @brief Covariance of natural frequency [rad/s], damping ratio, mass [kg] and, of more
/// than one direction, angle [rad] of some terms, those of one behind those of another.
/// @return row-major, square; empty as that of the solution
std::vector<double> shape_covariance(const ModesSolution& solution,
                                     std::span<const std::size_t> terms);

/// @brief One response as it was measured, without a fit.
FittedResponse measured_response(const DirectedResponse& one);

/// @brief One response with the fit through it, without its residues.
FittedResponse fitted_response(Responses all, const ModesTrial& trial,
                               std::size_t which);

/// @brief What some terms give to one response, with standard errors.
std::vector<ShapeResidue> residues_of(const ModesSolution& solution,
                                      const DirectedResponse& one,
                                      std::span<const std::size_t> terms);

}  // namespace trochoid::structure
