#include <trochoid/identification/groups.h>
#include <trochoid/identification/identify.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/numerics/least_squares.h>

#include <cmath>

namespace trochoid::identification {
std::vector<double> sweep(const force::Setup& setup, const force::Law& law,
                          std::span<const Run> runs, const Fit& fit,
                          std::span<const double> offsets) {
  const auto teeth = static_cast<std::size_t>(setup.cutter.teeth());
  if (runs.empty() || fit.phase.size() != runs.size() || teeth < 2) return {};
  Problem problem;
  problem.setup = setup;
  problem.setup.chip = fit.chip;
  problem.setup.runout = fit.runout;
  problem.law = fit.ok ? fit.law : law;
  problem.columns = static_cast<int>(force::form(law).columns());
  problem.tolerance = 1e-8;
  set_groups(runs, problem);
  double samples = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    problem.runs.push_back(fold(runs[r], fit.options));
    for (double& angle : problem.runs.back().angle) angle += fit.phase[r];
    samples += static_cast<double>(runs[r].angle.size());
  }
  // What the folded rows no longer hold: the scatter of samples at the same angle.
  double scatter = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r)
    scatter += scatter_of(runs[r], problem.runs[r]);

  std::vector<double> out;
  for (const double offset : offsets) {
    problem.setup.runout.radial_offsets.resize(teeth, 0.0);
    problem.setup.runout.radial_offsets[1] = offset;
    const Evaluation at = evaluate(problem, {});
    const double rss =
        numerics::least_squares(design(problem, at), measured(problem), 1e-8).rss;
    out.push_back(std::sqrt((rss + scatter) / samples));
  }
  return out;
}

}  // namespace trochoid::identification
