#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/run/simulate/simulate.h>

namespace trochoid::cli {

int simulate(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::simulate);
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    progress("Forces over the turns");
    return results::answer_of(run::simulate(given));
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
