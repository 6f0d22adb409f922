#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/stabilisation.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// What a response of a fit is, beside its lines.
struct MeasuredResponse {
  std::string name;  ///< motion and force, like "xy"
  structure::Axis motion = structure::Axis::x;
  structure::Axis force = structure::Axis::x;
  std::string description;  ///< of the measurement, where its file says it
};

/// @brief What `modes` answers: modal parameters of measured frequency responses.
struct ModesResult {
  Heading heading;
  structure::ModeBody body = structure::ModeBody::tool;  ///< that was tapped
  /// The modes are those of M-30, and the answer tells of each response by itself; else
  /// of one response (M-6), and the answer is about that.
  bool shared = false;
  std::vector<MeasuredResponse> responses;  ///< as those of the fit
  /// Where one response was made from blows.
  std::optional<signal::TapResponse> tap;
  structure::ModesFit fit;
  std::vector<structure::TriedPole> poles;  ///< of the diagram of stabilisation
};

Answer answer_of(const ModesResult& result);

}  // namespace trochoid::results
