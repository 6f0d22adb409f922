#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/identification/identify.h>
#include <trochoid/inputs/case.h>
#include <trochoid/signal/record.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::run {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// One measurement, read and laid over the spindle angle.
struct MeasuredRun {
  signal::Record record;  ///< channels with their idle drift taken out
  geometry::Cut cut;
  std::vector<double> angle;  ///< [rad], increasing or falling, unwrapped
  double Omega = 0.0;         ///< found in the record, else as stated [rad/s]
  double Omega_se = 0.0;      ///< [rad/s]; 0: not estimated
};

/// @brief Read all measurements of a case.
/// @param[out] warnings  what was found out about the records
/// @throws base::InputError with the problems of all files
/// @return none, with the reason in `message`, where a record has no usable angle
std::vector<MeasuredRun> measured_runs(const inputs::Case& given,
                                       std::vector<base::Warning>& warnings,
                                       std::string& message);

/// @brief Force on the tool of every run, channels = M force.
std::vector<identification::Run> on_tool(const std::vector<MeasuredRun>& runs,
                                         const Matrix3& M);

}  // namespace trochoid::run
