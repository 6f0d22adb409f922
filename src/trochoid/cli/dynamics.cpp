#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/vibration/dynamics.h>

#include <functional>

namespace trochoid::cli {

int dynamics(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::dynamics,
                                               result_folder(options, "dynamics"));
  ProgressLine progress(options.quiet);
  return deliver(results::answer_of(run::dynamics(given, std::ref(progress))), options);
}

}  // namespace trochoid::cli
