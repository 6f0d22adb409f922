#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/measured_run.h>
#include <trochoid/run/progress.h>

#include <string>
#include <vector>

namespace trochoid::run {

/// What the channels of a record read, found from the record alone.
struct AxesChoice {
  bool ok = false;
  std::string message;    ///< when not ok, why
  Matrix3 matrix{};       ///< channels = matrix times force on the tool
  double rms = 0.0;       ///< of the low band with this choice [N]; infinite: no fit
  double next_rms = 0.0;  ///< of the best choice that is not the same data [N]
};

/// @brief Try the signed permutations of the channels.
///
/// The residual of a fit within the lowest harmonics says which channel is z and which
/// way round the others go. Readings that no residual can tell apart (on a cylinder
/// always eight) are decided by K_tc, K_rc, K_ac > 0.
AxesChoice choose_axes(const inputs::Case& given, const std::vector<MeasuredRun>& runs,
                       const Progress& progress, std::vector<base::Warning>& warnings);

/// @brief What a given reading of the channels leaves, as choose_axes compares it [N];
/// infinite where it cannot be fitted.
double reading_rms(const inputs::Case& given, const std::vector<MeasuredRun>& runs,
                   const Matrix3& M);

}  // namespace trochoid::run
