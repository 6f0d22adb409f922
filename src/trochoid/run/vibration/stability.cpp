#include <trochoid/run/vibration/stability.h>

#include <trochoid/run/vibration/problem.h>
#include <trochoid/run/vibration/warnings.h>

#include <fmt/core.h>

namespace trochoid::run {

results::StabilityResult stability(const inputs::Case& given,
                                   const Progress& progress) {
  results::StabilityResult r{.heading = {.title = given.title,
                                         .warnings = given.notes,
                                         .case_toml = given.as_understood},
                             .problem = stability_problem(given)};
  r.stability = dynamics::stability(r.problem, [&](const char* what, double done) {
    if (progress) {
      progress({what, done});
    }
  });
  base::add(r.heading.warnings,
            stability_warnings(given, r.problem.options, r.stability));
  r.heading.message =
      fmt::format("The cut is {}.", dynamics::name_of(r.stability.verdict));
  return r;
}

}  // namespace trochoid::run
