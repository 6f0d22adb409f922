#include <trochoid/structure/identify_modes.h>

#include <trochoid/structure/modes_answer.h>
#include <trochoid/structure/modes_order.h>
#include <trochoid/structure/reciprocity.h>
#include <trochoid/structure/thinned.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::structure {

namespace {

/// The first fault of a direct response that a check finds; empty: none.
template <class Check>
std::string fault_of_direct(Responses all, const Check& check) {
  for (const DirectedResponse& one : all) {
    const std::string fault = one.direct() ? check(one.response) : std::string();
    if (!fault.empty()) {
      return fmt::format("response {}: {}", one.name, fault);
    }
  }
  return {};
}

/// Real shapes nearest to complex ones, fitted to all responses.
ModesTrial as_real(Responses all, const ModesTrial& trial) {
  ModesModel model = trial.solution.model;
  model.form = ModeForm::real_shapes;
  for (ModeTerm& term : model.terms) {
    for (auto& phi : term.phi) {
      phi = phi.real();
    }
  }
  return settle_exactly(all, model, trial);
}

/// Fill in a fit from what was chosen.
/// @param many  the lines it was fitted to
void take(Responses all, Responses many, const Candidate& chosen, ModesFit& fit) {
  const ModesModel& model = chosen.trial.solution.model;
  const std::vector<std::size_t> answers = answers_of(chosen);
  for (const std::size_t r : answers) {
    fit.modes.push_back(shape_mode(all, chosen.trial.solution, r));
  }
  fit.real_modes = fit.modes;
  fit.covariance = shape_covariance(chosen.trial.solution, answers);
  if (model.complex_shapes()) {
    const ModesTrial real = as_real(many, chosen.trial);
    fit.real_modes.clear();
    for (const std::size_t r : answers) {
      fit.real_modes.push_back(shape_mode(all, real.solution, r));
    }
    fit.covariance = shape_covariance(real.solution, answers);
  }
  for (std::size_t r = 0; r < chosen.terms.size(); ++r) {
    if (chosen.terms[r].role == TermRole::outside) {
      fit.outside.push_back(shape_mode(all, chosen.trial.solution, r));
    } else if (chosen.terms[r].role == TermRole::unresolved) {
      fit.unresolved.push_back(shape_mode(all, chosen.trial.solution, r));
      fit.left_out.push_back(chosen.terms[r].why);
    }
  }
  fit.complex_shapes = model.complex_shapes();
  fit.residual_terms = model.residual_terms;
  for (std::size_t q = 0; q < all.size(); ++q) {
    fit.responses.push_back(fitted_response(all, chosen.trial, q));
    fit.responses.back().residues = residues_of(chosen.trial.solution, all[q], answers);
  }
  fit.reciprocity = reciprocity_of(many, chosen.trial);
}

ModesFit refused(Responses all, std::string reason) {
  ModesFit fit;
  fit.reason = std::move(reason);
  for (const DirectedResponse& one : all) {
    fit.responses.push_back(measured_response(one));
  }
  return fit;
}

/// What cannot be answered whatever the fit; empty: nothing.
/// @param few  the lines thinned
std::string refusal(Responses all, Responses few, const ModesOptions& options) {
  for (const DirectedResponse& one : all) {
    const std::size_t needed = lines_needed(std::max(options.count, 1));
    if (one.response.omega.size() < needed) {
      return fmt::format(
          "the band of the response {} has {} lines: at least {} are "
          "needed",
          one.name, one.response.omega.size(), needed);
    }
    if (std::all_of(one.response.H.begin(), one.response.H.end(),
                    [](const auto& H) { return std::abs(H) == 0; })) {
      return fmt::format("the response {} is zero in the whole band", one.name);
    }
  }
  const std::string lone = fault_of_direct(all, fault_of_a_line);
  if (!lone.empty()) {
    return lone;
  }
  const std::string turned = fault_of_direct(few, fault_before_search);
  return turned.empty() ? opposite_signs(all) : turned;
}

}  // namespace

ModesFit identify_shapes(const std::vector<DirectedResponse>& responses,
                         const ModesOptions& options) {
  const Responses all = responses;
  const std::vector<DirectedResponse> few = thinned(all, for_a_search);
  const std::vector<DirectedResponse> many = thinned(all, for_a_fit);
  const std::string why = refusal(all, few, options);
  if (!why.empty()) {
    return refused(all, why);
  }
  OrderSearch tried;
  for (const bool complex_shapes : {false, true}) {
    if (options.complex_shapes.value_or(complex_shapes) == complex_shapes) {
      search_orders({few, many, all}, options,
                    complex_shapes ? ModeForm::complex_shapes : ModeForm::real_shapes,
                    tried);
    }
  }
  const auto& [real, complex] = tried.best;
  const bool both = real.found() && complex.found();
  const double evidence = both ? real.trial.criterion - complex.trial.criterion : 0.0;
  Candidate chosen =
      !real.found() || (complex.found() && evidence > very_strong) ? complex : real;
  if (!chosen.found()) {
    const std::string other = fault_of_direct(few, [](const auto& lines) {
      return fault_of_kind(lines, 1, least_explained);
    });
    return refused(all, other.empty() ? tried.first_fault : other);
  }
  const double criterion = chosen.trial.criterion;
  chosen.trial = settle_exactly(many, chosen.trial.solution.model, chosen.trial);
  ModesFit fit;
  take(all, many, chosen, fit);
  for (std::size_t q = 0; q < all.size(); ++q) {
    if (all[q].direct() && fit.responses[q].explained < least_explained) {
      return refused(
          all,
          fmt::format("no common modes explain the response {}: the best fit leaves "
                      "{:.0f} % of its power, the sum of |H|^2, unexplained",
                      all[q].name, 100 * (1 - fit.responses[q].explained)));
    }
  }
  if (both) {
    fit.complex_evidence = evidence;
  }
  const Alternative other = alternative_to(chosen, criterion, tried.orders);
  fit.criterion = criterion;
  fit.alternative = other.count;
  fit.alternative_odds = other.odds;
  fit.orders = std::move(tried.orders);
  fit.ok = true;
  return fit;
}

namespace {

/// Modes this many half-power widths from their neighbours do not stand for another.
constexpr double well_apart = 3.0;
constexpr double most_damping_of_one = 0.2;
/// Change of a parameter that ends the fits of a check, in standard errors.
constexpr double nearly = 0.03;

/// Whether each mode stands for itself. A turned residue is fitted by two real modes near
/// each other, by a broad one, or by what lies outside of the band.
bool stand_for_themselves(const ModesFit& fit) {
  if (!fit.ok || !fit.outside.empty() || !fit.unresolved.empty()) return false;
  for (std::size_t r = 0; r < fit.modes.size(); ++r) {
    const FittedMode& a = fit.modes[r];
    if (a.zeta.value > most_damping_of_one) return false;
    if (r + 1 == fit.modes.size()) break;
    const FittedMode& b = fit.modes[r + 1];
    const double width = a.zeta.value * a.omega.value + b.zeta.value * b.omega.value;
    if (b.omega.value - a.omega.value < well_apart * width) return false;
  }
  return true;
}

/// By how much the criterion falls where the same modes may be complex.
double gain_of_turning(Responses all, const ModesFit& fit) {
  ModesModel real{.form = ModeForm::real_shapes,
                  .residual_terms = fit.residual_terms,
                  .residual = {fit.responses.front().residual},
                  .terms = {}};
  for (const FittedMode& mode : fit.modes) {
    real.terms.push_back(
        {mode.omega.value, mode.zeta.value, {std::sqrt(1 / mode.mass.value)}});
  }
  const ModesTrial as_real = settle(all, real, even_weights(all, real.form), nearly);
  ModesModel turned = as_real.solution.model;
  turned.form = ModeForm::complex_shapes;
  return as_real.criterion -
         settle(all, turned, weights_of(all, as_real), nearly).criterion;
}

}  // namespace

std::optional<ComplexCheck> complex_check(const ModesFit& fit) {
  const FittedResponse& only = fit.responses.front();
  const std::vector<DirectedResponse> all = {
      {.response = {.kind = only.kind,
                    .omega = only.omega,
                    .H = only.H,
                    .noise_bandwidth = only.noise_bandwidth},
       .decay = only.decay,
       .name = {}}};
  if (stand_for_themselves(fit) &&
      gain_of_turning(thinned(all, for_a_search), fit) < very_strong) {
    return std::nullopt;
  }
  ComplexCheck out{.fit = identify_shapes(all, {.complex_shapes = true})};
  if (!out.fit.ok) {
    return std::nullopt;
  }
  out.evidence = fit.ok ? fit.criterion - out.fit.criterion
                        : std::numeric_limits<double>::infinity();
  for (const FittedMode& mode : out.fit.modes) {
    if (mode.imaginary.value >= out.imaginary) {
      out.imaginary = mode.imaginary.value;
      out.omega = mode.omega.value;
    }
  }
  return out;
}

}  // namespace trochoid::structure
