#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/correct/correct.h>

namespace trochoid::cli {

int correct(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::correct);
  return work_on(given, options, base::Command::correct,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   return results::answer_of(
                       run::correct(given, options.simulate_controller, progress));
                 });
}

}  // namespace trochoid::cli
