#include <trochoid/structure/identify_modes.h>

#include <trochoid/structure/modes_answer.h>
#include <trochoid/structure/modes_order.h>
#include <trochoid/structure/reciprocity.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::structure {

namespace {

/// A direct response that is not of its kind, or against the force; empty: none.
std::string fault_of_direct(Responses all, int count, double explained) {
  for (const DirectedResponse& one : all) {
    const std::string fault =
        one.direct() ? fault_of_kind(one.response, count, explained) : std::string();
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
void take(Responses all, const Candidate& chosen, ModesFit& fit) {
  const ModesModel& model = chosen.trial.solution.model;
  const std::vector<std::size_t> answers = answers_of(chosen);
  for (const std::size_t r : answers) {
    fit.modes.push_back(shape_mode(all, chosen.trial.solution, r));
  }
  fit.real_modes = fit.modes;
  fit.covariance = shape_covariance(chosen.trial.solution, answers);
  if (model.complex_shapes()) {
    const ModesTrial real = as_real(all, chosen.trial);
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
  fit.reciprocity = reciprocity_of(all, chosen.trial);
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
std::string refusal(Responses all, const ModesOptions& options) {
  for (const DirectedResponse& one : all) {
    const std::size_t needed = lines_needed(std::max(options.count, 1));
    if (one.response.omega.size() < needed) {
      return fmt::format(
          "the band of the response {} holds {} lines: at least {} are "
          "needed",
          one.name, one.response.omega.size(), needed);
    }
    if (std::all_of(one.response.H.begin(), one.response.H.end(),
                    [](const auto& H) { return std::abs(H) == 0; })) {
      return fmt::format("the response {} is zero in the whole band", one.name);
    }
  }
  const std::string turned = fault_of_direct(all, 1, certain);
  return turned.empty() ? opposite_signs(all) : turned;
}

}  // namespace

ModesFit identify_shapes(const std::vector<DirectedResponse>& responses,
                         const ModesOptions& options) {
  const Responses all = responses;
  const std::string why = refusal(all, options);
  if (!why.empty()) {
    return refused(all, why);
  }
  OrderSearch tried;
  for (const bool complex_shapes : {false, true}) {
    if (options.complex_shapes.value_or(complex_shapes) == complex_shapes) {
      search_orders(all, options,
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
    const std::string other = fault_of_direct(all, 1, least_explained);
    return refused(all, other.empty() ? tried.first_fault : other);
  }
  const double criterion = chosen.trial.criterion;
  chosen.trial = settle_exactly(all, chosen.trial.solution.model, chosen.trial);
  ModesFit fit;
  take(all, chosen, fit);
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

std::optional<ComplexCheck> complex_check(const ModesFit& fit) {
  const FittedResponse& only = fit.responses.front();
  const std::vector<DirectedResponse> all = {
      {.response = {.kind = only.kind,
                    .omega = only.omega,
                    .H = only.H,
                    .noise_bandwidth = only.noise_bandwidth},
       .decay = only.decay,
       .name = {}}};
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
