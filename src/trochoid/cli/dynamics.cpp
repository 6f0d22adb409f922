#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/vibration/dynamics.h>

namespace trochoid::cli {

int dynamics(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::dynamics);
  return work_on(given, options, base::Command::dynamics,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   return results::answer_of(run::dynamics(given, progress));
                 });
}

}  // namespace trochoid::cli
