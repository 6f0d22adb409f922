#pragma once

#include <trochoid/identification/identify.h>

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// What no interval holds: a dynamometer or a cut that is not what the case says.
namespace trochoid::identification {

enum class SystematicKind {
  gain,          ///< of one reading [1]
  cross_talk,    ///< part of one force in the reading of another [1]
  delay,         ///< of one reading behind the others [s]
  all_gains,     ///< of all readings alike [1]
  turn,          ///< of the dynamometer about z [rad]
  axial_depth,   ///< [m]
  radial_depth,  ///< [m]
  feed           ///< per tooth [m]
};

/// @brief One way in which things may not be as stated.
struct Systematic {
  SystematicKind kind = SystematicKind::all_gains;
  std::size_t reading = 0;  ///< axis of the tool whose reading is wrong, from 0
  std::size_t force = 0;    ///< of which it holds a part
};

/// @brief By how much each coefficient of the first group is found too large for one unit of
/// it that was not told.
struct SystematicEffect {
  Systematic systematic;
  std::vector<double> on_coefficients;  ///< [SI a unit]
};

/// @brief A dynamometer that is not what it says, as the record tells it.
struct SensorFault {
  Systematic systematic;
  double value = 0.0;                ///< part of the reading, or delay [s]
  double se = 0.0;                   ///< its standard error
  double size = 1.0;                 ///< part of the force that one unit changes
  double explained = 0.0;            ///< in what one unknown explains by chance
  double part = 0.0;                 ///< of what repeats turn by turn, from 0 to 1
  std::vector<double> coefficients;  ///< of the first group, with it told
};

/// What is known of systematic errors beside a fit.
struct Systematics {
  /// Turn, gains, depths and feed, of which no record tells; those that apply.
  std::vector<SystematicEffect> untold;
  /// Gains and delays of single channels and cross talk that the record tells: what
  /// explains most, and what explains nearly as much; empty: nothing explains clearly.
  std::vector<SensorFault> faults;
};

/// @brief How the coefficients would come out if the case were wrong, linear about the fit.
///
/// @eq I-24 K + (J^T J)^-1 J^T c s for a systematic s whose column is c; where the record
///          tells it, s = c'^T d/c'^T c', c' = c less what the columns of J hold of it. That
///          counts where it explains 25 times what one unknown does by chance
/// @param fit  of the same setup, law and runs; empty where it has no answer
Systematics systematics(const force::Setup& setup, const force::Law& law,
                        std::span<const Run> runs, const Fit& fit);

}  // namespace trochoid::identification
