#include <trochoid/run/identify/plan.h>
#include <trochoid/run/shared/heading.h>

#include <trochoid/base/units.h>
#include <trochoid/identification/groups.h>
#include <trochoid/identification/plan.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/student.h>
#include <trochoid/run/identify/fit_options.h>
#include <trochoid/run/identify/identify.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>

namespace trochoid::run {

namespace {

using identification::Fit;
using identification::Information;
using identification::RunoutUnknowns;
using identification::Trial;
using results::PlannedCut;
using results::PlannedQuantity;
using results::PlanResult;

/// Of the peak force of [cut], where nothing else tells the noise.
constexpr double assumed_noise = 0.02;
/// Of the peak force, while cuts are compared.
constexpr double force_tolerance = 1e-6;

/// A quantity as a combination of parameters.
struct Combination {
  std::vector<std::size_t> parameters;
  std::vector<double> gradient;
};

/// What one cut comes to: a place among the answers, or why it has none.
struct Outcome {
  PlannedCut cut;
  std::string left_out;
};

double peak_in_plane(const Trial& trial) {
  std::vector<double> phi;
  for (int i = 0; i < trial.samples_per_turn; ++i) {
    phi.push_back(unit::turn * (i + 0.5) / trial.samples_per_turn);
  }
  double peak = 0.0;
  for (const force::Vector3& F :
       force::forces(trial.setup, trial.law, phi, force_tolerance)) {
    peak = std::max(peak, std::hypot(F[0], F[1]));
  }
  return peak;
}

std::vector<geometry::Engagement> engagements(const inputs::Plan& plan) {
  std::vector<geometry::Engagement> out;
  for (const inputs::PlannedEngagement kind : plan.engagements) {
    if (kind == inputs::PlannedEngagement::slot) {
      out.emplace_back(geometry::Slot{});
      continue;
    }
    for (const double a_e : plan.radial_depths) {
      if (kind == inputs::PlannedEngagement::up) {
        out.emplace_back(geometry::UpMilling{a_e});
      } else {
        out.emplace_back(geometry::DownMilling{a_e});
      }
    }
  }
  return out;
}

/// Every combination that is to be looked at.
std::vector<geometry::Cut> all_cuts(const inputs::Case& given) {
  std::vector<geometry::Cut> out;
  for (const geometry::Engagement& engagement : engagements(given.plan)) {
    for (const double a_p : given.plan.axial_depths) {
      for (const double f_z : given.plan.feeds) {
        out.push_back({engagement, a_p, f_z, given.setup.cut.Omega});
      }
    }
  }
  return out;
}

/// The work on one case.
struct Planning {
  const inputs::Case& given;
  const Progress& progress;
  PlanResult r = {};
  Trial trial = {};                      ///< what all cuts have in common
  Information known = {};                ///< so far; empty: nothing
  double freedom = 0.0;                  ///< of what is known, its unknowns taken off
  std::size_t unknowns = 0;              ///< but for phases and channels
  std::vector<std::size_t> wanted = {};  ///< parameters of the determinant
  std::vector<Combination> combinations = {};
  std::vector<std::string> untold = {};  ///< coefficients that no cut can tell

  PlanResult failed(const std::string& why) {
    r.heading.ok = false;
    r.heading.message = why;
    return std::move(r);
  }

  /// The next cut is measured as those before: what a missing channel does not tell of
  /// them it does not tell of any.
  void leave_out_untold() {
    if (std::ranges::all_of(trial.measured, std::identity())) return;
    const auto names = force::coefficient_quantities(trial.law);
    for (std::size_t c = 0; c < names.size(); ++c) {
      if (known.matrix[c * known.size + c] == 0.0) untold.emplace_back(names[c].key);
    }
    if (untold.empty()) return;
    r.heading.warnings.push_back(
        {"not_planned",
         fmt::format(
             "Without a channel that was not measured no cut tells {}: they are "
             "left out.",
             fmt::join(untold, ", "))});
  }

  /// What the measurements tell.
  /// @return why nothing can be planned from them; empty: it can
  std::string learn_from_records() {
    const results::IdentifyResult found = identify(given, progress);
    r.heading.warnings = found.heading.warnings;
    if (!found.chosen) {
      return "the measurements so far have no answer to start from: " +
             found.heading.message;
    }
    if (!found.reasons_against.empty()) {
      return "the measurements so far give no numbers to plan with. " +
             identification::do_not_use(found.reasons_against);
    }
    const Fit& fit = found.fits[*found.chosen];
    const std::size_t last = fit.groups.size() - 1;  // the tool as it is now
    known =
        identification::information_of(given.setup, given.law, found.runs, fit, last);
    freedom = fit.freedom;
    if (last > 0) r.group = identification::label_of_group(fit.groups[last].name);
    trial.setup.chip = fit.chip;
    trial.setup.runout = fit.runout;
    trial.law = fit.groups[last].law;
    trial.options = fit.options;
    trial.options.start.reset();
    trial.options.response.clear();  // of the runs measured
    trial.noise = identification::effective_noise(fit, found.runs);
    trial.measured = fit.measured;
    leave_out_untold();
    r.noise_from = "records";
    for (const results::RecordSummary& record : found.records) {
      r.files.push_back(record.file);
    }
    r.factor_before = fit.interval_factor;
    return "";
  }

  void start_from_coefficients() {
    trial.law = given.law;
    trial.options = fit_options(given, given.setup.chip.model);
    trial.noise = assumed_noise * peak_in_plane(trial);
    r.noise_from = "assumed";
    r.heading.warnings.push_back(
        {"nothing_measured",
         "The case has no measurement: cuts are compared as if each were the first, "
         "about the coefficients and the runout of the case."});
  }

  void add_coefficient(std::size_t i, const force::Quantity& of, double value) {
    const std::string key(of.key);
    wanted.push_back(i);
    combinations.push_back({{i}, {1.0}});
    r.quantities.push_back({.key = key,
                            .words = key.substr(0, key.find('_', key.find('_') + 1)),
                            .unit = of.unit,
                            .relative = value != 0.0,
                            .value = value});
  }

  void add_offsets(std::size_t first) {
    const auto& s = trial.setup.runout.radial_offsets;
    for (int k = 1; k < trial.setup.cutter.teeth(); ++k) {
      const auto tooth = static_cast<std::size_t>(k);
      wanted.push_back(first + tooth - 1);
      combinations.push_back({{wanted.back()}, {1.0}});
      r.quantities.push_back({.key = fmt::format("radial_offset_{}_mm", k + 1),
                              .words = fmt::format("offset of tooth {}", k + 1),
                              .unit = unit::mm,
                              .relative = false,
                              .value = s.empty() ? 0.0 : s[tooth] - s[0]});
    }
  }

  void add_eccentricity(std::size_t first) {
    wanted.push_back(first);
    wanted.push_back(first + 1);
    const geometry::Runout& e = trial.setup.runout;
    combinations.push_back(
        {{first, first + 1}, {std::cos(e.angle), std::sin(e.angle)}});
    r.quantities.push_back({.key = "eccentricity_mm",
                            .words = "eccentricity",
                            .unit = unit::mm,
                            .relative = false,
                            .value = e.eccentricity});
  }

  /// The parameters behind the names of [plan] quantities, each once, in their order.
  void choose_quantities() {
    const std::vector<std::string> names =
        identification::parameter_names(trial.setup, trial.law, trial.options);
    const std::vector<force::Quantity> all = force::coefficient_quantities(trial.law);
    const std::vector<force::Quantity> m = force::exponent_quantities(trial.law);
    const std::vector<double> K = force::coefficients(trial.law);
    const auto asked = [&](std::string_view name) {
      const auto& list = given.plan.quantities;
      return std::find(list.begin(), list.end(), name) != list.end();
    };
    for (std::size_t c = 0; c < all.size(); ++c) {
      const std::string key(all[c].key);
      const std::string plain = key.substr(0, key.find('_', key.find('_') + 1));
      if (std::ranges::find(untold, key) != untold.end()) continue;
      if (asked("coefficients") || asked(plain)) {
        add_coefficient(c, all[c], K[c]);
      }
    }
    const bool runout = asked("runout") && chip::feels_runout(trial.options.chip_model);
    const auto teeth = static_cast<std::size_t>(trial.setup.cutter.teeth());
    const RunoutUnknowns form = trial.options.runout;
    if (runout && identification::finds_offsets(form)) add_offsets(all.size());
    if (runout && identification::finds_eccentricity(form) && teeth > 1) {
      const bool after_offsets = identification::finds_offsets(form);
      add_eccentricity(all.size() + (after_offsets ? teeth - 1 : 0));
    }
    const std::size_t first = names.size() - m.size();
    for (std::size_t q = 0; q < m.size() && trial.options.fit_exponents; ++q) {
      if (asked(m[q].key)) {
        add_coefficient(first + q, m[q], force::form(trial.law).m[q]);
      }
    }
    r.parameters = wanted.size();
    unknowns = names.size();
  }

  [[nodiscard]] Outcome outcome_of(const geometry::Cut& cut) const {
    Outcome out{.cut = {.cut = cut}};
    Trial one = trial;
    one.setup.cut = cut;
    try {
      out.cut.peak_force = peak_in_plane(one);
      if (!(out.cut.peak_force > 0.0)) {
        out.left_out = "nothing is cut";
        return out;
      }
      if (given.plan.max_force && out.cut.peak_force > *given.plan.max_force) {
        out.left_out = fmt::format("above max_force_N = {:g} N", *given.plan.max_force);
        return out;
      }
      const Information then = sum(known, identification::information_of(one));
      const auto determinant = identification::log_determinant(then, wanted);
      bool told = determinant.has_value();
      for (const Combination& c : combinations) {
        const auto se = identification::standard_error(then, c.parameters, c.gradient);
        told = told && se.has_value();
        out.cut.se.push_back(se.value_or(0.0));
      }
      out.cut.log_determinant = determinant.value_or(0.0);
      if (!told) out.left_out = "it would still not tell the quantities apart";
    } catch (const std::invalid_argument&) {
      out.left_out = "no such cut with this cutter";
    }
    return out;
  }

  void compare(const std::vector<geometry::Cut>& cuts) {
    std::vector<Outcome> outcomes(cuts.size());
    numerics::for_each_index(cuts.size(),
                             [&](std::size_t i) { outcomes[i] = outcome_of(cuts[i]); });
    std::map<std::string, std::size_t> reasons;
    for (Outcome& one : outcomes) {
      if (one.left_out.empty()) {
        r.cuts.push_back(std::move(one.cut));
      } else {
        ++reasons[one.left_out];
      }
    }
    for (const auto& [reason, count] : reasons) {
      r.left_out.push_back({reason, count});
    }
    std::stable_sort(r.cuts.begin(), r.cuts.end(),
                     [](const PlannedCut& a, const PlannedCut& b) {
                       return a.log_determinant < b.log_determinant;
                     });
  }

  void warn_of_limits() {
    if (given.plan.max_force) {
      return;
    }
    r.heading.warnings.push_back(
        {"no_force_limit",
         "[plan] has no max_force_N: heavier cuts tell more as a rule, so that the best "
         "one is among the heaviest."});
  }

  /// Equations less unknowns once the cut has been measured: it has a phase of its own.
  [[nodiscard]] double freedom_after() const {
    const auto forces = static_cast<double>(std::ranges::count(trial.measured, true));
    const double equations = forces * r.samples_per_rev * r.turns;
    const double more = known.size > 0 ? 1.0 : 1.0 + static_cast<double>(unknowns);
    return std::max(1.0, freedom + equations - more);
  }

  PlanResult answer() {
    r.heading = heading_of(given);
    r.turns = given.plan.turns;
    r.samples_per_rev = given.plan.samples_per_rev;
    r.diameter = given.setup.cutter.profile.D;
    trial.setup = given.setup;
    trial.samples_per_turn = given.plan.samples_per_rev;
    trial.turns = given.plan.turns;
    if (given.measurements.empty()) {
      start_from_coefficients();
    } else if (const std::string why = learn_from_records(); !why.empty()) {
      return failed(why);
    }
    if (given.plan.noise) {
      trial.noise = *given.plan.noise;
      r.noise_from = "given";
    }
    r.noise = trial.noise;
    if (!(trial.noise > 0.0)) {
      return failed(
          "there is neither force nor noise to compare cuts by: give noise_N");
    }
    choose_quantities();
    if (wanted.empty()) {
      return failed("none of the quantities of [plan] is looked for by the fit");
    }
    r.log_determinant = identification::log_determinant(known, wanted);
    for (std::size_t q = 0; q < combinations.size(); ++q) {
      r.quantities[q].se = identification::standard_error(
          known, combinations[q].parameters, combinations[q].gradient);
    }
    r.factor_after = numerics::student_t(0.975, freedom_after());
    progress("comparing cuts");
    const std::vector<geometry::Cut> cuts = all_cuts(given);
    r.looked_at = cuts.size();
    compare(cuts);
    if (r.cuts.empty()) {
      return failed(fmt::format("none of the {} cuts of [plan] can be recommended: {}",
                                cuts.size(), r.left_out.front().reason));
    }
    warn_of_limits();
    r.heading.message = results::next_cut_sentence(r);
    return std::move(r);
  }
};

}  // namespace

results::PlanResult plan(const inputs::Case& given, const Progress& progress) {
  return Planning{given, progress}.answer();
}

}  // namespace trochoid::run
