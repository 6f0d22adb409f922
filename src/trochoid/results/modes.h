#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/stabilisation.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// @brief What `modes` answers: modal parameters of a measured frequency response.
struct ModesResult {
  Heading heading;
  structure::ResponseKind kind = structure::ResponseKind::receptance;
  std::string description;  ///< of the measurement, where its file says it
  structure::ModeBody body = structure::ModeBody::tool;  ///< that was tapped
  structure::Axis axis = structure::Axis::x;             ///< in which direction
  std::optional<signal::TapResponse> tap;  ///< where the response was made from blows
  structure::ModesFit fit;
  std::vector<structure::TriedPole> poles;  ///< of the diagram of stabilisation
};

Answer answer_of(const ModesResult& result);

}  // namespace trochoid::results
