#pragma once

#include <trochoid/structure/modes_fit.h>
#include <trochoid/structure/modes_search.h>

#include <string>
#include <vector>

namespace trochoid::structure {

/// @brief How far transposed responses agree.
///
/// @eq  M-34  H_q ~ g_q M + U + L/s^2, least squares over g, U, L with the weights of
///            M-31, M the modes that both share;  gain = g_kj/g_jk
/// @src derived: reciprocity of a linear structure without gyroscopic forces
std::vector<Reciprocity> reciprocity_of(Responses all, const ModesTrial& trial);

/// @brief Which transposed responses have opposite signs, in words; empty: none.
std::string opposite_signs(Responses all);

}  // namespace trochoid::structure
