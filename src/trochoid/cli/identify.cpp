#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/run/identify/identify.h>

#include <functional>

namespace trochoid::cli {

int identify(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::identify);
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    results::IdentifyResult result = run::identify(given, std::ref(progress));
    result.whole_curves = options.curves;
    return results::answer_of(result);
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
