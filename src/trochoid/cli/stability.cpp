#include <trochoid/cli/deliver.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/vibration/stability.h>

#include <functional>

namespace trochoid::cli {

int stability(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::stability,
                                               result_folder(options, "stability"));
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    return results::answer_of(run::stability(given, std::ref(progress)));
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
