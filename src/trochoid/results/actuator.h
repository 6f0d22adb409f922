#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/structure/identify_actuator.h>

#include <vector>

namespace trochoid::results {

/// @brief What `actuator` answers: the transfer function of an actuator, from a step.
struct ActuatorResult {
  Heading heading;
  structure::StepRecord record;
  std::vector<double> command;  ///< as recorded [m]; empty: not recorded
  structure::ActuatorFit fit;
};

Answer answer_of(const ActuatorResult& result);

}  // namespace trochoid::results
