#pragma once

#include <trochoid/base/table.h>
#include <trochoid/run/correction_plan.h>

#include <string>
#include <vector>

namespace trochoid::run {

/// Points of a command over one turn, in command.csv and command.h.
inline constexpr int command_points = 720;

/// @brief What the actuator is told [m] at equally spaced spindle angles from 0, the
/// middle of the stroke added.
std::vector<double> command_values(const CorrectionPlan& plan);

/// angle_deg, command_um, and the motion wanted.
base::Table command_table(const CorrectionPlan& plan);
/// Forces, table and actuator over the last turn, before and after.
base::Table before_after_table(const CorrectionSetting& setting,
                               const BeforeAfter& moved);
/// Differences over the spindle speed.
base::Table map_table(const SpeedMap& map);

/// @brief The command for a program in C: command.h.
std::string command_header(const CorrectionSetting& setting, const CorrectionPlan& plan,
                           const std::string& title);

}  // namespace trochoid::run
