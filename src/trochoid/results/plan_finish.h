#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/surface/plan_finish.h>

#include <optional>
#include <string>

namespace trochoid::results {

/// @brief What `plan` of a finish answers: which feed keeps Ra below a limit.
struct PlanFinishResult {
  Heading heading;
  surface::FinishPlan asked;
  surface::PlannedFinish plan;
};

/// @brief `Ra stays within 1.6 um up to 0.12 mm per tooth ...`
std::string finish_plan_sentence(const PlanFinishResult& result);

Answer answer_of(const PlanFinishResult& result);

}  // namespace trochoid::results
