#pragma once

#include <trochoid/structure/shapes_search.h>

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
std::vector<ShapesModel> starts_with_one_more(Responses all, const AllWeights& weights,
                                              const ShapesModel& known,
                                              ShapesForm form);

}  // namespace trochoid::structure
