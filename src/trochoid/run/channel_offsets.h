#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>
#include <trochoid/signal/passes.h>
#include <trochoid/signal/record.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::run {

/// Where drift is read off.
struct DriftParts {
  std::span<const signal::Part> air;
  const signal::Part& cut;
};

/// What was taken out of the channels of a record.
struct TakenOut {
  bool offset = false;                ///< there was a place where nothing cuts
  std::array<double, 3> offset_se{};  ///< of each channel [N]
};

/// @brief Take out of the channels what they read where nothing cuts, and what drifts.
/// @param angle  [rad], one a sample
TakenOut take_drift_out(const cases::Case& given, std::span<const double> angle,
                        const DriftParts& parts, signal::Record& record,
                        std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
