#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/dynamics.h>

#include <functional>

namespace trochoid::cli {

int dynamics(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::dynamics,
                                               result_folder(options, "dynamics"));
  ProgressLine progress(options.quiet);
  const results::Answer answer = run::dynamics(given, std::ref(progress));
  return deliver(answer, options);
}

}  // namespace trochoid::cli
