#pragma once

#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>

#include <array>
#include <optional>
#include <vector>

namespace trochoid::identification {

/// @brief A record beside forces that are known but for the angle at which it begins.
struct PhaseMatch {
  double phase = 0.0;                    ///< true angle minus recorded angle [rad]
  std::vector<force::Vector3> computed;  ///< [N], shape of the record
  force::Vector3 rms_axis{};             ///< of the difference [N]
  double rms = 0.0;                      ///< [N], I-5
  double measured_rms = 0.0;             ///< [N]
};

/// @brief Compute the forces of a record, coefficients and runout as given.
/// @param phase      [rad]; absent: the one with the smallest difference
/// @param tolerance  of the force, relative to its peak
PhaseMatch match_phase(const force::Setup& setup, const force::Law& law, const Run& run,
                       const std::optional<double>& phase, double tolerance);

}  // namespace trochoid::identification
