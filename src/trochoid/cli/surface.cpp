#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/wall/surface.h>

namespace trochoid::cli {

int surface(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::surface);
  return work_on(given, options, base::Command::surface,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   return results::answer_of(run::surface(given, progress));
                 });
}

}  // namespace trochoid::cli
