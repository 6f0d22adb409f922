#pragma once

#include <trochoid/structure/modes_faults.h>
#include <trochoid/structure/shapes_search.h>

#include <cstddef>
#include <vector>

namespace trochoid::structure {

/// @brief What a term of a fit of all responses is.
TermVerdict verdict_on(Responses all, const ShapesSolution& solution, std::size_t r);

/// @brief A mode of a fit with its standard errors.
///
/// @eq  M-33  m = 1/sum |phi_j|^2, k = m omega_r^2, c = 2 m zeta_r omega_r, the angle of
///            atan2(Re phi_y, Re phi_x), the fraction |Im phi|/|phi|; their errors by
///            their derivatives and the covariance of M-31
/// @src derived
ShapeMode shape_mode(Responses all, const ShapesSolution& solution, std::size_t r);

/// @brief Covariance of natural frequency [rad/s], damping ratio, mass [kg] and, of more
/// than one direction, angle [rad] of some terms, those of one behind those of another.
/// @return row-major, square; empty as that of the solution
std::vector<double> shape_covariance(const ShapesSolution& solution,
                                     const std::vector<std::size_t>& terms);

/// @brief One response with the fit through it.
/// @param answers  terms that are modes, in the order of the answer
FittedResponse fitted_response(Responses all, const ShapesTrial& trial,
                               std::size_t which,
                               const std::vector<std::size_t>& answers);

}  // namespace trochoid::structure
