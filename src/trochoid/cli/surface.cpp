#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/run/wall/surface.h>

#include <functional>

namespace trochoid::cli {

int surface(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::surface);
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    return results::answer_of(run::surface(given, std::ref(progress)));
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
