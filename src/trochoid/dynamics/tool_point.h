#pragma once

#include <trochoid/dynamics/point_response.h>
#include <trochoid/dynamics/system.h>
#include <trochoid/structure/delay.h>
#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/modes_fit.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// The tool point from its measured responses, and what these can tell of it.
namespace trochoid::dynamics {

/// One measured response of the tool or of the table.
struct MeasuredResponse {
  structure::FrequencyResponse response;  ///< in the band that counts
  std::size_t motion = 0;                 ///< axis of the motion, 0: x, 1: y
  std::size_t force = 0;                  ///< axis of the force, 0: x, 1: y
  bool of_table = false;
};

/// Fewer lines are no response.
inline constexpr std::size_t fewest_lines = 8;

/// @brief A response as receptance, its lines above 0.
MeasuredReceptance receptance_of(const MeasuredResponse& measured);

/// @brief Whether the point would move against the force that pushes it, so that the
/// sensor points the wrong way: the imaginary part of a direct receptance is negative, most
/// of all at a resonance. A cross response may have either sign.
bool moves_against_force(const MeasuredReceptance& part);

/// A response to which no modes could be fitted.
struct NoModes {
  std::size_t response = 0;  ///< which
  std::string reason;
};

/// A delay that was taken out of a response.
struct FoundDelay {
  std::size_t response = 0;  ///< which
  structure::Delay delay;
};

/// What measured responses say.
struct ToolPoint {
  PointResponse response;
  std::vector<double> noise;  ///< scatter of each part of the response [m/N]
  /// Of the direct responses, those that describe them best; empty where none were
  /// looked for.
  System modes;
  System real_modes;           ///< the same, or the real ones where those are complex
  bool complex_modes = false;  ///< some of them are
  std::optional<NoModes> no_modes;  ///< the first without; nothing: all have some
  std::vector<FoundDelay> delays;   ///< the response is without them
};

/// @brief The tool point from the responses of tool and table.
///
/// A cross response that is given in one of its two directions serves for both: structures
/// without gyroscopic forces are symmetric. With one, modes lie askew (D-25) and are real.
/// Without, complex modes take the place of real ones where these do not describe the
/// response (M-30). A delay between force and response is taken out of a direct response
/// where modes are looked for (M-36).
/// @param measured   each with fewest_lines lines at least
/// @param fit_modes  look for the modes, too
ToolPoint tool_point(std::span<const MeasuredResponse> measured, bool fit_modes);

/// @brief A complex mode of one direction as the chip feels it.
///
/// @eq  D-35 Z of M-30, m = 1/|Z|, in_phase + lead s = m (Re Z + Im Z (s + zeta omega_0)/
///           omega_d)
/// @src derived: M-30 over 1/m of D-1
/// @param x  of the direction in which it moves the tool; tool modes +, table modes -
ChipMode complex_mode(const structure::FittedMode& mode, double x, double y);

/// How far modes are from a response near a frequency.
struct Misfit {
  double modes = 0.0;  ///< root mean square of modes less response, over that of it
  double noise = 0.0;  ///< the scatter of its lines, over the same
};

/// @brief Of the direct response that is farthest from its modes, its lines within a tenth
/// of a frequency.
/// @param omega  [rad/s]
Misfit misfit_near(const ToolPoint& point, const System& modes, double omega);

}  // namespace trochoid::dynamics
