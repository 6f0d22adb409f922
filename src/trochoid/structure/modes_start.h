#pragma once

#include <trochoid/structure/modes_problem.h>

#include <complex>
#include <span>
#include <vector>

namespace trochoid::structure {

/// @brief The symmetric matrix of rank one near the residues of a mode, as its factor.
///
/// @eq  M-32  phi_j phi_k ~ Z_jk: with the direction j of the largest Re Z_jj,
///            phi_j = sqrt(Z_jj), phi_k = Z_jk/phi_j, or sqrt(Z_kk) without a cross response
/// @src derived: exact where the residues are those of one mode
/// @param Z  of each response
std::vector<std::complex<double>> rank_one(Responses all,
                                           std::span<const std::complex<double>> Z,
                                           std::size_t directions);

/// @brief Starts for a fit with one mode more than a model.
///
/// @eq  M-17  gain of a mode more = (g^T r)^2/(g^T g) over frequencies and dampings, r
///            the weighted residual, g what a mode there would add to it
/// @src derived: the change of the sum of squares by one linear parameter
///
/// All modes anew by M-5, those found with one more where M-17 is largest, and those
/// found with one split in two.
/// @param weightings  by each of which places are sought; residues are by the first
std::vector<ModesModel> starts_with_one_more(Responses all,
                                             std::span<const AllWeights> weightings,
                                             const ModesModel& known);

}  // namespace trochoid::structure
