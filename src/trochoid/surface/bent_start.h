#pragma once

#include <trochoid/surface/joint_model.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief Runouts from which a fit with feedback may begin: feedback evens out the teeth,
/// so that what fits best without it can lie far off.
///
/// The pattern over a turn is compared, height by height, for runouts all around.
/// @param rows   readings or their means
/// @param about  coefficients to try with
/// @param size   of the runout to try with [m]
/// @return best first
std::vector<JointState> bent_starts(const Setting& setting,
                                    std::span<const Reading> rows, Feedback feedback,
                                    const JointState& about, double size);

}  // namespace trochoid::surface
