#include <trochoid/identification/prepare.h>

#include <trochoid/base/index.h>
#include <trochoid/identification/answer.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/uncertainty.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

/// Change of the force over the turn below this part of it says nothing.
constexpr double constant_force = 1e-7;
/// With fewer equations to spare a fit meets the record in several false minima, and
/// its standard errors mean nothing.
constexpr int spare_equations = 3;

bool finite(const Run& run) {
  const auto good = [](double v) { return std::isfinite(v); };
  return std::ranges::all_of(run.angle, good) &&
         std::ranges::all_of(
             run.force, [&](const auto& f) { return std::ranges::all_of(f, good); });
}

/// What can be refused before any computing; empty: nothing.
std::string refusal(const geometry::Cutter& cutter, std::span<const Run> runs) {
  if (runs.empty()) return "there is no measurement";
  for (std::size_t r = 0; r < runs.size(); ++r) {
    if (!finite(runs[r])) {
      return fmt::format("measurement {} has values that are not finite", r + 1);
    }
  }
  const auto idle = [&](const Run& run) {
    return !(run.cut.f_z * cutter.teeth() > 0.0) || !(run.cut.a_p > 0.0);
  };
  if (std::ranges::all_of(runs, idle)) {
    return "the feed or the axial depth is zero: nothing is cut, so the forces contain "
           "no information about the material";
  }
  return "";
}

bool force_is_constant(const Problem& problem) {
  double total = 0.0;
  for (const double b : measured(problem)) total += b * b;
  return rss_of_means(problem) <= constant_force * constant_force * total;
}

/// The same with the phases of the runs, scaled by the largest feed.
Unknowns unknowns_of(const force::Setup& setup, const force::Law& law,
                     std::span<const Run> runs, const Options& options) {
  Unknowns out = identification::unknowns_of(setup, law, options);
  out.length = 0.0;
  for (const Run& run : runs) out.length = std::max(out.length, run.cut.f_z);
  out.phases = options.phase ? 0 : static_cast<int>(runs.size());
  for (std::size_t q = 0; q < 3; ++q) out.rings[q] = options.resonances[q].has_value();
  return out;
}

Problem problem_of(const force::Setup& setup, const force::Law& law,
                   std::span<const Run> runs, const Options& options) {
  Problem out;
  out.setup = setup;
  out.setup.chip.model = options.chip_model;
  out.law = law;
  out.unknowns = unknowns_of(setup, law, runs, options);
  if (out.unknowns.runout == RunoutUnknowns::none) out.setup.runout = {};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    out.runs.push_back(
        fold(runs[r], options,
             r < options.response.size() ? options.response[r] : Response{}));
  }
  out.resonances = options.resonances;
  out.tolerances = options.tolerances;
  set_groups(runs, out);
  out.fixed_phase = options.phase.value_or(0.0);
  out.stop = options.stop;
  out.columns = static_cast<int>(force::form(law).columns());
  if (options.start && options.start->phase.size() == runs.size()) {
    out.start = Point{options.start->runout, law, options.start->phase};
    out.start_of_fit = options.start->of_fit;
  }
  return out;
}

/// Whether the runs of some group were all cut with the same feed.
bool has_group_of_one_feed(const Problem& problem) {
  std::vector<double> f_z(problem.groups.size(), -1.0);
  std::vector<bool> several(problem.groups.size(), false);
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const std::size_t g = problem.group_of[r];
    if (f_z[g] >= 0.0 && problem.runs[r].cut.f_z != f_z[g]) several[g] = true;
    f_z[g] = problem.runs[r].cut.f_z;
  }
  return std::ranges::any_of(several, [](bool feeds) { return !feeds; });
}

/// Too few equations for the unknowns: the sentence that says so, else empty.
std::string too_few(const Problem& problem, double equations) {
  const int unknowns = problem.linear() + problem.unknowns.count();
  if (equations >= unknowns + spare_equations) return "";
  return fmt::format("{} equations for {} unknowns: at least {} are needed", equations,
                     unknowns, unknowns + spare_equations);
}

}  // namespace

Unknowns unknowns_of(const force::Setup& setup, const force::Law& law,
                     const Options& options) {
  Unknowns out;
  out.teeth = setup.cutter.teeth();
  out.runout =
      chip::feels_runout(options.chip_model) ? options.runout : RunoutUnknowns::none;
  if (out.teeth == 1 && out.runout != RunoutUnknowns::fixed) {
    out.runout = RunoutUnknowns::none;
  }
  out.exponents = options.fit_exponents && force::form(law).power;
  return out;
}

bool means_do_not_suffice(const Problem& problem) {
  return force::form(problem.law).edge && has_group_of_one_feed(problem);
}

Prepared prepare(const force::Setup& setup, const force::Law& law,
                 std::span<const Run> runs, const Options& options) {
  Prepared out;
  out.refusal = refusal(setup.cutter, runs);
  if (!out.refusal.empty()) return out;
  out.problem = problem_of(setup, law, runs, options);
  const Problem& problem = *out.problem;
  out.refusal = too_few(problem, equations_of(problem, runs));
  if (out.refusal.empty() && means_do_not_suffice(problem) &&
      force_is_constant(problem)) {
    out.refusal =
        "the force does not change with the angle: its three means are all that the "
        "record tells, and they cannot determine six coefficients";
  }
  return out;
}

}  // namespace trochoid::identification
