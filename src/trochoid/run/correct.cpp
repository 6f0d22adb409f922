#include <trochoid/run/correct.h>

#include <trochoid/base/units.h>
#include <trochoid/run/controlled_answer.h>
#include <trochoid/run/correction_answer.h>
#include <trochoid/run/correction_plan.h>
#include <trochoid/run/correction_tables.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

namespace trochoid::run {

results::Answer correct(const inputs::Case& given, bool controller,
                        const Progress& progress) {
  results::Answer answer{
      .command = "correct",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const auto tell = [&](const char* what) {
    if (progress) {
      progress(what);
    }
  };
  const auto fail = [&](const std::string& why) {
    answer.heading.ok = false;
    answer.heading.message = why;
    answer.result = results::Object{};
    return answer;
  };
  const inputs::Correction& wanted = *given.machine.correct;
  std::string message;
  const auto setting =
      correction_setting(given, progress, answer.heading.warnings, message);
  if (!setting) {
    return fail(message);
  }
  tell("Finding the command");
  const CorrectionPlan plan = correction_plan(*setting, wanted);
  if (!plan.ok) {
    return fail(plan.reason);
  }
  tell("Cutting before and after");
  const BeforeAfter moved = before_after(*setting, plan.command);
  if (const std::string why = chatter_in(moved); !why.empty()) {
    return fail(why);
  }
  tell("Looking at other speeds");
  const SpeedMap map = speed_map(*setting, plan, wanted);
  CorrectionFindings findings{*setting, plan, moved, map, wanted};
  fill_answer(findings, answer);
  if (controller) {
    tell("Running the controller");
    add_controlled(
        controlled_cut(*setting, plan,
                       given.machine.controller.value_or(inputs::Controller{})),
        answer);
  }
  return answer;
}

}  // namespace trochoid::run
