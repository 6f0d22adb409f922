#include <trochoid/base/command.h>
#include <trochoid/base/names.h>
#include <trochoid/inputs/case.h>
#include <trochoid/python/bindings.h>
#include <trochoid/run/correct/correct.h>
#include <trochoid/run/identify/identify.h>
#include <trochoid/run/identify/plan.h>
#include <trochoid/run/simulate/simulate.h>
#include <trochoid/run/vibration/actuator.h>
#include <trochoid/run/vibration/dynamics.h>
#include <trochoid/run/vibration/modes.h>
#include <trochoid/run/vibration/stability.h>
#include <trochoid/run/wall/calibrate.h>
#include <trochoid/run/wall/plan.h>
#include <trochoid/run/wall/surface.h>

#include <pybind11/pybind11.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace py = pybind11;

namespace trochoid::python {

namespace {

using base::Command;
using results::answer_of;

/// What a command is told besides its case.
struct RunOptions {
  bool curves = false;               ///< of identify: every sample
  bool simulate_controller = false;  ///< of correct
};

/// Nobody is told of the progress yet.
void silent(const run::Step&) {}

results::Answer identified(const inputs::Case& given, bool curves) {
  results::IdentifyResult result = run::identify(given, silent);
  result.whole_curves = curves;
  return answer_of(result);
}

results::Answer answer(Command command, const inputs::Case& given,
                       const RunOptions& options) {
  switch (command) {
    case Command::simulate:
      return answer_of(run::simulate(given));
    case Command::identify:
      return identified(given, options.curves);
    case Command::surface:
      return answer_of(run::surface(given, silent));
    case Command::calibrate:
      return answer_of(run::calibrate(given, silent));
    case Command::stability:
      return answer_of(run::stability(given, silent));
    case Command::modes:
      return answer_of(run::modes(given));
    case Command::actuator:
      return answer_of(run::actuator(given));
    case Command::dynamics:
      return answer_of(run::dynamics(given, silent));
    case Command::correct:
      return answer_of(run::correct(given, options.simulate_controller, silent));
    case Command::plan:
      return given.plan.of == inputs::PlanOf::wall
                 ? answer_of(run::plan_wall(given, silent))
                 : answer_of(run::plan(given, silent));
  }
  throw std::logic_error("a command without an answer");
}

}  // namespace

void bind_run(py::module_& m) {
  m.def(
      "run",
      [](const std::string& command, const std::shared_ptr<inputs::Case>& given,
         bool curves, bool simulate_controller) {
        const auto wanted = base::named<Command>(command);
        const py::gil_scoped_release release;
        return std::make_shared<results::Answer>(
            answer(wanted.value(), *given, {curves, simulate_controller}));
      },
      py::arg("command"), py::arg("case"), py::kw_only(), py::arg("curves") = false,
      py::arg("simulate_controller") = false);
}

}  // namespace trochoid::python
