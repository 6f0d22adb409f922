#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::correction {

/// Forces over one or more revolutions.
struct ForceRecord {
  std::vector<double> angle;                 ///< of the tip of tooth 1 [rad]
  std::vector<std::array<double, 3>> force;  ///< on the tool [N]
};

struct StaticFitOptions {
  bool axial = true;       ///< F_z and its coefficients as well, where there is any
  bool fit_offset = true;  ///< an angle to add to the recorded ones
  double guard = 0.05;     ///< left out around entries and exits of a tip [rad]
  double thin = 0.05;      ///< and where a chip is thinner than this part of f_z
  int slices = 1;          ///< over the axial depth; helix needs many
};

/// A value and its standard error.
struct Value {
  double value = 0.0;
  double se = 0.0;
};

/// @brief The power law that a static fit starts from; none of a law that is another one.
std::optional<force::Power> power_near(const force::Law& law);

/// @brief Power law, runout and angle that explain a record with a rigid system.
struct StaticFit {
  bool ok = false;
  std::string reason;  ///< when not ok
  force::Power law;    ///< with the values found
  Value K_t1;
  Value m_t;
  Value K_r1;
  Value m_r;
  Value K_a1;  ///< 0 without F_z
  Value m_a;
  std::vector<Value> rho;   ///< [m], mean 0
  std::vector<Value> h_ro;  ///< rho_j - rho_(j-1) [m]
  Value offset;             ///< true angle minus recorded one [rad]
  double rms = 0.0;         ///< of what is left, over all samples and axes used [N]
  double explained = 0.0;   ///< part of the variance, 1: all
  std::size_t samples = 0;  ///< used
  int iterations = 0;
};

/// @brief Least squares over ln K_t1, m_t, ln K_r1, m_r, (ln K_a1, m_a), N - 1 offsets
/// and an angle.
///
/// @eq R-21 min over p of the sum over samples and axes of |F(p; phi + offset) - F|^2,
///          F = R-1 with the table at rest, the power law F-2
/// @src [diez2010] section on the identification; standard errors as I-4
/// @param setup  the cut as it was measured; its runout is where the search starts if
///               it is not empty
/// @param start  law to start from; absent: several. With law and runout, these say
///               where chips are thin; else a first fit does
/// @note Renumbering the teeth is an exact symmetry of equal pitch: the offset is
/// looked for near 0. A tooth that just enters has a force of infinite slope, and a
/// mark that takes over makes a kink: both fall where a chip is thin.
StaticFit static_fit(const force::Setup& setup, const ForceRecord& record,
                     const StaticFitOptions& options = {},
                     const std::optional<force::Power>& start = std::nullopt);

}  // namespace trochoid::correction
