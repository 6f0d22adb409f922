#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/correct.h>

#include <functional>

namespace trochoid::cli {

int correct(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::correct,
                                               result_folder(options, "correct"));
  ProgressLine progress(options.quiet);
  const results::Answer answer =
      run::correct(given, options.simulate_controller, std::ref(progress));
  return deliver(answer, options);
}

}  // namespace trochoid::cli
