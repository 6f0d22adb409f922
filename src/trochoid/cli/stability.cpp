#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/stability.h>

#include <functional>

namespace trochoid::cli {

int stability(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::stability,
                                               result_folder(options, "stability"));
  ProgressLine progress(options.quiet);
  const results::Answer answer = run::stability(given, std::ref(progress));
  return deliver(answer, options);
}

}  // namespace trochoid::cli
