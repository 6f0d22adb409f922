#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/vibration/stability.h>

namespace trochoid::cli {

int stability(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::stability);
  return work_on(given, options, base::Command::stability,
                 [&](const run::Progress& progress, base::Stop stop) {
                   return results::answer_of(run::stability(given, progress, stop));
                 });
}

}  // namespace trochoid::cli
