#include <trochoid/cli/given_case.h>
#include <trochoid/cli/work_on.h>
#include <trochoid/run/identify/plan.h>
#include <trochoid/run/wall/plan.h>

namespace trochoid::cli {

int plan(const Options& options) {
  const inputs::Case given = given_case(options, base::Command::plan);
  return work_on(given, options, base::Command::plan,
                 [&](const run::Progress& progress, base::Stop /*stop*/) {
                   return given.plan.of == inputs::PlanOf::wall
                              ? results::answer_of(run::plan_wall(given, progress))
                              : results::answer_of(run::plan(given, progress));
                 });
}

}  // namespace trochoid::cli
