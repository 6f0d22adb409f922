#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/correct/correct.h>

#include <functional>

namespace trochoid::cli {

int correct(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::correct,
                                               result_folder(options, "correct"));
  ProgressLine progress(options.quiet);
  return deliver(results::answer_of(run::correct(given, options.simulate_controller,
                                                 std::ref(progress))),
                 options);
}

}  // namespace trochoid::cli
