#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/run/correction_plan.h>

#include <string>

namespace trochoid::run {

/// All that correct found.
struct CorrectionFindings {
  const CorrectionSetting& setting;
  const CorrectionPlan& plan;
  const BeforeAfter& moved;
  const SpeedMap& map;
  const inputs::Correction& wanted;
};

/// @brief Why a motion is no steady cut; empty: it is one.
std::string chatter_in(const BeforeAfter& moved);

/// @brief (largest - smallest)/largest peak of |F_y| of the flutes.
double difference_of(const dynamics::Motion& m);

/// @brief The same of the chip areas.
double area_difference_of(const dynamics::Motion& m);

/// @brief Do the forces repeat from turn to turn?
bool periodic(const dynamics::Motion& m);

/// @brief rho_j - rho_(j-1), cyclic.
std::vector<double> chip_differences(const std::vector<double>& rho);

/// @brief How far the table is from the motion
/// wanted, at most, while it is cut upon [m].
double table_deviation(const CorrectionFindings& f);

/// @brief Result, warnings, tables and the short table.
void fill_answer(const CorrectionFindings& found, results::Answer& answer);

}  // namespace trochoid::run
