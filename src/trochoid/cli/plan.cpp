#include <trochoid/cli/deliver.h>
#include <trochoid/cli/given_case.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/run/identify/plan.h>
#include <trochoid/run/wall/plan.h>

#include <functional>

namespace trochoid::cli {

int plan(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::plan);
  const auto answer = [&] {
    ProgressLine progress(options.quiet);
    return given.plan.of == inputs::PlanOf::wall
               ? results::answer_of(run::plan_wall(given, std::ref(progress)))
               : results::answer_of(run::plan(given, std::ref(progress)));
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
