#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/structure/identify_shapes.h>
#include <trochoid/structure/mode.h>

#include <string>
#include <vector>

namespace trochoid::results {

/// One response among those that share their modes.
struct SharedResponse {
  std::string name;  ///< motion and force, like "xy"
  structure::Axis motion = structure::Axis::x;
  structure::Axis force = structure::Axis::x;
  structure::ResponseKind kind = structure::ResponseKind::receptance;
  std::string description;  ///< of the measurement, where its file says it
};

/// @brief What `modes` answers of several responses of one structure.
struct SharedModesResult {
  Heading heading;
  structure::ModeBody body = structure::ModeBody::tool;  ///< that was tapped
  std::vector<SharedResponse> responses;                 ///< as those of the fit
  structure::ShapesFit fit;
};

Answer answer_of(const SharedModesResult& result);

}  // namespace trochoid::results
