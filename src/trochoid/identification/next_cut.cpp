#include <trochoid/identification/next_cut.h>

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/student.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string_view>

namespace trochoid::identification {

namespace {

/// Of the peak force, while cuts are compared.
constexpr double force_tolerance = 1e-6;

/// A quantity as a combination of parameters.
struct LinearQuantity {
  std::vector<std::size_t> parameters;
  std::vector<double> gradient;
};

/// The quantities that are asked for, and the parameters behind them.
struct Asked {
  std::vector<std::size_t> parameters;       ///< of the determinant
  std::vector<LinearQuantity> combinations;  ///< one a quantity
  std::vector<PlannedQuantity> quantities;
  std::size_t unknowns = 0;  ///< of the fit, but for phases and channels
};

/// What one cut comes to: a place among the answers, or why it has none.
struct Outcome {
  PlannedCut cut;
  std::string left_out;
};

/// `K_tc` of `K_tc_MPa`.
std::string without_unit(const std::string& key) {
  return key.substr(0, key.find('_', key.find('_') + 1));
}

void add_coefficient(std::size_t i, const force::Quantity& of, double value,
                     Asked& out) {
  const std::string key(of.key);
  out.parameters.push_back(i);
  out.combinations.push_back({{i}, {1.0}});
  out.quantities.push_back({.key = key,
                            .words = without_unit(key),
                            .unit = of.unit,
                            .relative = value != 0.0,
                            .value = value});
}

/// Of every tooth against the first.
void add_offsets(const force::Setup& setup, std::size_t first, Asked& out) {
  const auto& s = setup.runout.radial_offsets;
  for (int k = 1; k < setup.cutter.teeth(); ++k) {
    const auto tooth = static_cast<std::size_t>(k);
    out.parameters.push_back(first + tooth - 1);
    out.combinations.push_back({{out.parameters.back()}, {1.0}});
    out.quantities.push_back({.key = fmt::format("radial_offset_{}_mm", k + 1),
                              .words = fmt::format("offset of tooth {}", k + 1),
                              .unit = unit::mm,
                              .relative = false,
                              .value = s.empty() ? 0.0 : s[tooth] - s[0]});
  }
}

/// Its amount alone is a quantity; both components count in the determinant.
void add_eccentricity(const geometry::Runout& e, std::size_t first, Asked& out) {
  out.parameters.push_back(first);
  out.parameters.push_back(first + 1);
  out.combinations.push_back(
      {{first, first + 1}, {std::cos(e.angle), std::sin(e.angle)}});
  out.quantities.push_back({.key = "eccentricity_mm",
                            .words = "eccentricity",
                            .unit = unit::mm,
                            .relative = false,
                            .value = e.eccentricity});
}

/// The parameters behind the names, each once, in the order of parameter_names.
Asked asked_of(const Knowledge& known, const std::vector<std::string>& wanted) {
  const Trial& trial = known.trial;
  const auto names = parameter_names(trial.setup, trial.law, trial.options);
  const std::vector<force::Quantity> all = force::coefficient_quantities(trial.law);
  const std::vector<force::Quantity> m = force::exponent_quantities(trial.law);
  const std::vector<double> K = force::coefficients(trial.law);
  const std::vector<std::string> untold = untold_coefficients(known);
  const auto asked = [&](std::string_view name) {
    return std::ranges::find(wanted, name) != wanted.end();
  };
  Asked out;
  out.unknowns = names.size();
  for (std::size_t c = 0; c < all.size(); ++c) {
    const std::string key(all[c].key);
    if (std::ranges::find(untold, key) != untold.end()) continue;
    if (asked("coefficients") || asked(without_unit(key))) {
      add_coefficient(c, all[c], K[c], out);
    }
  }
  const bool runout = asked("runout") && chip::feels_runout(trial.options.chip_model);
  const auto teeth = static_cast<std::size_t>(trial.setup.cutter.teeth());
  const RunoutUnknowns form = trial.options.runout;
  if (runout && finds_offsets(form)) add_offsets(trial.setup, all.size(), out);
  if (runout && finds_eccentricity(form) && teeth > 1) {
    add_eccentricity(trial.setup.runout,
                     all.size() + (finds_offsets(form) ? teeth - 1 : 0), out);
  }
  const std::size_t first = names.size() - m.size();
  for (std::size_t q = 0; q < m.size() && trial.options.fit_exponents; ++q) {
    if (asked(m[q].key)) {
      add_coefficient(first + q, m[q], force::form(trial.law).m[q], out);
    }
  }
  return out;
}

Outcome outcome_of(const Knowledge& known, const Asked& asked,
                   const std::optional<double>& max_force, const geometry::Cut& cut) {
  Outcome out{.cut = {.cut = cut}};
  Trial one = known.trial;
  one.setup.cut = cut;
  try {
    out.cut.peak_force = peak_in_plane(one);
    if (!(out.cut.peak_force > 0.0)) {
      out.left_out = "nothing is cut";
      return out;
    }
    if (max_force && out.cut.peak_force > *max_force) {
      out.left_out = fmt::format("above max_force_N = {:g} N", *max_force);
      return out;
    }
    const Information then = sum(known.information, information_of(one));
    const auto determinant = log_determinant(then, asked.parameters);
    bool told = determinant.has_value();
    for (const LinearQuantity& c : asked.combinations) {
      const auto se = standard_error(then, c.parameters, c.gradient);
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

void compare(const Knowledge& known, const Asked& asked, const CutRequest& request,
             CutPlan& plan) {
  std::vector<Outcome> outcomes(request.cuts.size());
  numerics::for_each_index(request.cuts.size(), [&](std::size_t i) {
    outcomes[i] = outcome_of(known, asked, request.max_force, request.cuts[i]);
  });
  std::map<std::string, std::size_t> reasons;
  std::multimap<double, const PlannedCut*>
      best_first;  // equal ones as they were asked for
  for (const Outcome& one : outcomes) {
    if (one.left_out.empty()) {
      best_first.emplace(one.cut.log_determinant, &one.cut);
    } else {
      ++reasons[one.left_out];
    }
  }
  for (const auto& [reason, count] : reasons) {
    plan.left_out.push_back({reason, count});
  }
  for (const auto& [determinant, cut] : best_first) plan.cuts.push_back(*cut);
}

/// Equations less unknowns once the cut has been measured: it has a phase of its own.
double freedom_after(const Knowledge& known, std::size_t unknowns) {
  const Trial& trial = known.trial;
  if (trial.means) {
    return known.freedom + static_cast<double>(trial.means->sd.size());
  }
  const auto forces = static_cast<double>(std::ranges::count(trial.measured, true));
  const double equations = forces * trial.samples_per_turn * trial.turns;
  const double more =
      known.information.size > 0 ? 1.0 : 1.0 + static_cast<double>(unknowns);
  return std::max(1.0, known.freedom + equations - more);
}

}  // namespace

Knowledge knowledge_of(const force::Setup& setup, const force::Law& law,
                       std::span<const Run> runs, const Fit& fit) {
  const std::size_t last = fit.groups.size() - 1;
  Knowledge known;
  known.information = information_of(setup, law, runs, fit, last);
  known.freedom = fit.freedom;
  Trial& trial = known.trial;
  trial.setup = setup;
  trial.law = fit.groups[last].law;
  trial.setup.chip = fit.chip;
  trial.setup.runout = fit.runout;
  trial.options = fit.options;
  trial.options.start.reset();
  trial.options.response.clear();  // of the runs measured
  trial.options.resonances = {};
  trial.noise = effective_noise(fit, runs);
  trial.measured = fit.measured;
  return known;
}

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

std::vector<std::string> untold_coefficients(const Knowledge& known) {
  std::vector<std::string> untold;
  const bool all_measured = std::ranges::all_of(known.trial.measured, std::identity());
  // A prior tells of coefficients that no mean of these channels does.
  const Information told =
      known.trial.means ? information_of(known.trial) : known.information;
  if (!known.trial.means && (all_measured || told.size == 0)) return untold;
  const auto names = force::coefficient_quantities(known.trial.law);
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (told.matrix[c * told.size + c] == 0.0) untold.emplace_back(names[c].key);
  }
  return untold;
}

CutPlan next_cut(const Knowledge& known, const CutRequest& request) {
  CutPlan plan;
  Asked asked = asked_of(known, request.quantities);
  if (asked.parameters.empty()) return plan;
  plan.parameters = asked.parameters.size();
  plan.log_determinant = log_determinant(known.information, asked.parameters);
  for (std::size_t q = 0; q < asked.quantities.size(); ++q) {
    const LinearQuantity& c = asked.combinations[q];
    asked.quantities[q].se =
        standard_error(known.information, c.parameters, c.gradient);
  }
  plan.factor = numerics::student_t(0.975, freedom_after(known, asked.unknowns));
  compare(known, asked, request, plan);
  plan.quantities = std::move(asked.quantities);
  return plan;
}

}  // namespace trochoid::identification
