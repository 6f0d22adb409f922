#include <trochoid/sweep/answer.h>

#include <trochoid/run/correct/correct.h>
#include <trochoid/run/identify/identify.h>
#include <trochoid/run/identify/plan.h>
#include <trochoid/run/simulate/simulate.h>
#include <trochoid/run/vibration/actuator.h>
#include <trochoid/run/vibration/dynamics.h>
#include <trochoid/run/vibration/modes.h>
#include <trochoid/run/vibration/shared_modes.h>
#include <trochoid/run/vibration/stability.h>
#include <trochoid/run/wall/calibrate.h>
#include <trochoid/run/wall/plan.h>
#include <trochoid/run/wall/surface.h>

#include <atomic>
#include <cstdint>
#include <limits>
#include <memory>
#include <stdexcept>

namespace trochoid::sweep {

results::Answer answer(base::Command command, const inputs::Case& given,
                       const AnswerOptions& options, const run::Progress& progress) {
  using base::Command;
  using results::answer_of;
  switch (command) {
    case Command::simulate:
      return options.tables ? answer_of(run::simulate(given))
                            : results::answer_without_tables(run::simulate(given));
    case Command::identify: {
      base::Stop stop;
      if (options.anyway) {
        stop.left = std::make_shared<std::atomic<std::int64_t>>(
            std::numeric_limits<std::int64_t>::max());
      }
      results::IdentifyResult result = run::identify(given, progress, stop);
      result.whole_curves = options.curves;
      return answer_of(result);
    }
    case Command::surface:
      return answer_of(run::surface(given, progress));
    case Command::calibrate:
      return answer_of(run::calibrate(given, progress));
    case Command::stability:
      return answer_of(run::stability(given, progress));
    case Command::modes:
      return run::modes_are_shared(given) ? answer_of(run::shared_modes(given))
                                          : answer_of(run::modes(given));
    case Command::actuator:
      return answer_of(run::actuator(given));
    case Command::dynamics:
      return answer_of(run::dynamics(given, progress));
    case Command::correct:
      return answer_of(run::correct(given, options.simulate_controller, progress));
    case Command::plan:
      return given.plan.of == inputs::PlanOf::wall
                 ? answer_of(run::plan_wall(given, progress))
                 : answer_of(run::plan(given, progress));
  }
  throw std::logic_error("a command without an answer");
}

}  // namespace trochoid::sweep
