#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/vibration/stability.h>

#include <functional>

namespace trochoid::cli {

int stability(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::stability,
                                               result_folder(options, "stability"));
  ProgressLine progress(options.quiet);
  return deliver(results::answer_of(run::stability(given, std::ref(progress))),
                 options);
}

}  // namespace trochoid::cli
