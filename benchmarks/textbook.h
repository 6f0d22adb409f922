#pragma once

#include <trochoid/force/forces.h>

#include <span>
#include <vector>

namespace trochoid::benchmarks {

/// @brief The loop of the textbooks, as the thing to compare with: equal slices with
/// their mid-point, and in each of them five Newton steps against every earlier tooth.
///
/// For cylinders of constant lead with radial offsets, in a slot.
std::vector<force::Vector3> textbook_forces(const force::Setup& setup,
                                            const force::LinearEdge& K,
                                            std::span<const double> phi, int slices);

}  // namespace trochoid::benchmarks
