#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/wall/calibrate.h>

namespace trochoid::cli {

int calibrate(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::calibrate);
  return work_on(given, options, base::Command::calibrate,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   return results::answer_of(run::calibrate(given, progress));
                 });
}

}  // namespace trochoid::cli
