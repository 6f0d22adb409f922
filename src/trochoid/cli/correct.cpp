#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/run/correct/correct.h>

#include <functional>

namespace trochoid::cli {

int correct(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::correct);
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    return results::answer_of(
        run::correct(given, options.simulate_controller, std::ref(progress)));
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
