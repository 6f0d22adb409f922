#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/dynamics/steady_state.h>
#include <trochoid/dynamics/tool_point.h>
#include <trochoid/results/modes.h>
#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/delay.h>
#include <trochoid/structure/identify_actuator.h>
#include <trochoid/structure/identify_modes.h>

#include <optional>
#include <string>
#include <vector>

/// Measured tool points, and what an engineer should know about the answers on vibration.
namespace trochoid::run {

/// @brief The responses of [[measured_frf]].
/// @param[out] warnings  what a reader of the answer should know of the measurement
/// @throws base::InputError for files that cannot be read, too few lines, and a sensor
///         that points against the force
std::vector<dynamics::MeasuredResponse> tool_responses(
    const cases::Case& given, std::vector<base::Warning>& warnings);

/// @brief What a measured response cannot say about a chatter frequency.
/// @param chatter  [rad/s]
/// @param step     from one harmonic to the next [rad/s]
void warn_of_response(const dynamics::ToolPoint& point, double chatter, double step,
                      std::vector<base::Warning>& warnings);

/// @brief That modes along one axis leave the tool rigid along the other.
void warn_one_direction(const cases::Case& given, std::vector<base::Warning>& warnings);

std::vector<base::Warning> stability_warnings(const cases::Case& given,
                                              const dynamics::StabilityOptions& options,
                                              const dynamics::Stability& stability);

std::vector<base::Warning> motion_warnings(const cases::Case& given,
                                           const dynamics::SteadyState& steady,
                                           const std::optional<double>& linear_growth);

/// @brief What a motion that does not grow comes to.
std::string motion_message(const dynamics::SteadyState& steady);

/// @brief What grows, and how that ended.
/// @param steady         with the verdict Growing
/// @param linear_growth  of the linearised cut in a turn, where it is known
std::string growth_message(const dynamics::SteadyState& steady,
                           const std::optional<double>& linear_growth);

void add_tap_warnings(const signal::TapResponse& tap,
                      std::vector<base::Warning>& warnings);

/// @brief That a delay was taken out of a response.
/// @param of  which response, for example " in xx"; empty: there is one
void add_delay_warning(const structure::Delay& delay, std::string_view of,
                       std::vector<base::Warning>& warnings);

/// @brief That real modes do not describe a response, if so.
void add_complex_warning(const structure::ComplexCheck& check,
                         std::vector<base::Warning>& warnings);

void add_modes_warnings(const results::ModesResult& r,
                        std::vector<base::Warning>& warnings);

void add_actuator_warnings(const structure::StepRecord& record,
                           const structure::ActuatorFit& fit,
                           std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
