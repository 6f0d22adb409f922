#include <trochoid/run/answer.h>

#include <trochoid/run/commands.h>
#include <trochoid/run/modes.h>
#include <trochoid/run/shared_modes.h>

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>

namespace trochoid::run {

namespace {

results::Answer identified(const cases::Case& given, const AnswerOptions& options,
                           const Progress& progress, base::Stop stop) {
  if (options.anyway) {
    stop.left = std::make_shared<std::atomic<std::int64_t>>(
        std::numeric_limits<std::int64_t>::max());
  }
  results::IdentifyResult result = identify(given, progress, stop);
  result.whole_curves = options.curves;
  return answer_of(result);
}

results::Answer along(const cases::Case& given, const AnswerOptions& options,
                      const Progress& progress, const base::Stop& stop) {
  results::ProgramResult result = program(given, progress, stop);
  result.all_moves = options.moves;
  return answer_of(result);
}

results::Answer planned(const cases::Case& given, const Progress& progress) {
  switch (given.plan.of.value_or(cases::PlanOf::forces)) {
    case cases::PlanOf::wall:
      return answer_of(plan_wall(given, progress));
    case cases::PlanOf::finish:
      return answer_of(plan_finish(given, progress));
    case cases::PlanOf::forces:
      break;
  }
  return answer_of(plan(given, progress));
}

}  // namespace

results::Answer answer(base::Command command, const cases::Case& given,
                       const AnswerOptions& options, const Progress& progress,
                       base::Stop stop) {
  using base::Command;
  using results::answer_of;
  switch (command) {
    case Command::simulate:
      progress("Forces over the turns");
      return options.tables ? answer_of(simulate(given))
                            : results::answer_without_tables(simulate(given, false));
    case Command::identify:
      return identified(given, options, progress, std::move(stop));
    case Command::surface:
      return answer_of(surface(given, progress));
    case Command::calibrate:
      return answer_of(calibrate(given, progress));
    case Command::stability:
      return answer_of(stability(given, progress, stop));
    case Command::modes:
      progress("Fitting the modes");
      return modes_are_shared(given) ? answer_of(shared_modes(given))
                                     : answer_of(modes(given));
    case Command::actuator:
      progress("Fitting the step");
      return answer_of(actuator(given));
    case Command::dynamics:
      return answer_of(dynamics(given, progress));
    case Command::correct:
      return answer_of(correct(given, options.simulate_controller, progress));
    case Command::program:
      return along(given, options, progress, stop);
    case Command::plan:
      return planned(given, progress);
  }
  throw std::logic_error("a command without an answer");
}

}  // namespace trochoid::run
