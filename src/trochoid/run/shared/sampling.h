#pragma once

#include <trochoid/inputs/case.h>

#include <vector>

namespace trochoid::run {

/// @brief Spindle angles that a [sampling] asks for [rad].
std::vector<double> sampled_angles(const inputs::Sampling& sampling);

}  // namespace trochoid::run
