#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/simulate/simulate.h>

namespace trochoid::cli {

int simulate(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::simulate);
  return work_on(given, options, base::Command::simulate,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   progress("Forces over the turns");
                   return results::answer_of(run::simulate(given));
                 });
}

}  // namespace trochoid::cli
