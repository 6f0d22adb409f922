#pragma once

#include <trochoid/correction/estimator.h>
#include <trochoid/correction/setting.h>

#include <optional>

namespace trochoid::correction {

/// @brief How waves of the command and what teeth stand out change the flutes of a cut:
/// the model that an estimator starts from, the other settings their defaults.
///
/// @eq R-31 S_jk = dv_j/du_k by differences on the rigid cut, u through R-11;
///          W_ji = dv_j/drho_i
/// @src derived
/// @param around  the table's motion about which the differences are taken
/// @return none of more than TROCHOID_ESTIMATOR_TEETH teeth
std::optional<TrochoidEstimatorConfig> estimator_for(const Setting& setting,
                                                     const PeriodicMotion& around);

}  // namespace trochoid::correction
