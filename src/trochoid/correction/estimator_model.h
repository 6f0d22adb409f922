#pragma once

#include <trochoid/correction/estimator.h>
#include <trochoid/correction/setting.h>

namespace trochoid::correction {

/// @brief How waves of the command and what teeth stand out change the flutes of a cut:
/// the model that an estimator starts from.
///
/// @eq R-31 S_jk = dv_j/du_k by differences on the rigid cut, u through R-11;
///          W_ji = dv_j/drho_i
/// @src derived
/// @param around  the table's motion about which the differences are taken
/// @param setting  of at most TROCHOID_ESTIMATOR_TEETH teeth
/// @param config  its teeth, harmonics, windows, models and most_m are set
void set_estimator_model(const Setting& setting, const PeriodicMotion& around,
                         TrochoidEstimatorConfig& config);

}  // namespace trochoid::correction
