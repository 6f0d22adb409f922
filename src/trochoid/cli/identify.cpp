#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/identify/identify.h>

#include <limits>

namespace trochoid::cli {

int identify(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::identify);
  return work_on(given, options, base::Command::identify,
                 [&](const run::Progress& progress, base::Stop stop) {
                   if (options.anyway) {
                     stop.left = std::make_shared<std::atomic<std::int64_t>>(
                         std::numeric_limits<std::int64_t>::max());
                   }
                   results::IdentifyResult result =
                       run::identify(given, progress, stop);
                   result.whole_curves = options.curves;
                   return results::answer_of(result);
                 });
}

}  // namespace trochoid::cli
