#include <trochoid/base/units.h>
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/modes_answer.h>
#include <trochoid/structure/modes_order.h>
#include <trochoid/structure/thinned.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::structure {

namespace {

FrequencyResponse in_band(const FrequencyResponse& response,
                          const ModesOptions& options) {
  FrequencyResponse lines{.kind = response.kind,
                          .noise_bandwidth = response.noise_bandwidth};
  const double to =
      options.to > 0 ? options.to : std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    const double w = response.omega[i];
    if (w > 0 && w >= options.from && w <= to) {
      lines.omega.push_back(w);
      lines.H.push_back(response.H[i]);
    }
  }
  return lines;
}

ModesFit refused(ModesFit fit, std::string reason) {
  fit.reason = std::move(reason);
  fit.modes.clear();
  fit.responses.front().fitted.clear();
  return fit;
}

/// What cannot be answered whatever the fit; empty: nothing.
/// @param few  the lines thinned
std::string refusal(const FrequencyResponse& lines, const FrequencyResponse& few,
                    int count) {
  const std::size_t needed = lines_needed(std::max(count, 1));
  if (lines.omega.size() < needed) {
    return fmt::format(
        "the band has {} lines: {} need at least {}", lines.omega.size(),
        count > 1 ? fmt::format("{} modes", count) : "one mode and its surroundings",
        needed);
  }
  if (!(power(lines) > 0)) {
    return "the response is zero in the whole band";
  }
  const std::string lone = fault_of_a_line(lines);
  return lone.empty() ? fault_before_search(few) : lone;
}

/// Fill in a fit from what was chosen.
void take(Responses all, const Candidate& chosen, double window_decay, ModesFit& fit) {
  const FrequencyResponse& lines = all.front().response;
  const ModesSolution& solution = chosen.trial.solution;
  std::vector<std::pair<double, std::size_t>> answers;  // natural frequency, term
  for (std::size_t r = 0; r < chosen.terms.size(); ++r) {
    FittedMode mode = fitted_mode(solution, r, window_decay);
    mode.lines_in_peak = lines_in_peak(lines, solution.model.terms[r]);
    if (chosen.terms[r].role == TermRole::mode) {
      fit.modes.push_back(mode);
      answers.emplace_back(mode.omega.value, r);
    } else if (chosen.terms[r].role == TermRole::outside) {
      fit.outside.push_back(mode);
    } else {
      fit.unresolved.push_back(mode);
      fit.left_out.push_back(chosen.terms[r].why);
    }
  }
  std::sort(fit.modes.begin(), fit.modes.end(),
            [](const FittedMode& a, const FittedMode& b) {
              return a.omega.value < b.omega.value;
            });
  std::sort(answers.begin(), answers.end());
  std::vector<std::size_t> order;
  for (const auto& [omega, term] : answers) {
    order.push_back(term);
  }
  fit.covariance = mode_covariance(solution, order, window_decay);
  fit.real_modes = fit.modes;
  fit.residual_terms = solution.model.residual_terms;
  fit.responses = {fitted_response(all, chosen.trial, 0)};
  fit.responses.front().decay = window_decay;
}

/// Which mode has less damping than the exponential window adds; empty: none.
std::string without_damping(const ModesFit& fit) {
  for (const FittedMode& mode : fit.modes) {
    if (!(mode.damping.value > 0)) {
      return fmt::format(
          "the damping of the mode at {:.5g} Hz cannot be separated from the "
          "damping of the exponential window: take longer blocks, or a weaker window",
          mode.omega.value / unit::Hz);
    }
  }
  return {};
}

}  // namespace

ModesFit identify_modes(const FrequencyResponse& response,
                        const ModesOptions& options) {
  const std::vector<DirectedResponse> only = {
      {.response = in_band(response, options), .name = {}}};
  const Responses all = only;
  const std::vector<DirectedResponse> few = thinned(all, for_a_search);
  const std::vector<DirectedResponse> many = thinned(all, for_a_fit);
  const FrequencyResponse& lines = few.front().response;
  ModesFit fit;
  fit.responses = {measured_response(only.front())};
  fit.responses.front().decay = options.window_decay;
  const std::string why = refusal(only.front().response, lines, options.count);
  if (!why.empty()) {
    return refused(std::move(fit), why);
  }
  OrderSearch search;
  search_orders({few, many, all}, options, ModeForm::residue, search);
  Candidate& chosen = search.best.front();
  const std::size_t count = chosen.trial.solution.model.terms.size();
  const std::string kind =
      fault_of_kind(lines, static_cast<int>(std::max<std::size_t>(count, 1)));
  if (!kind.empty()) {
    return refused(std::move(fit), kind);
  }
  if (!chosen.found()) {
    return refused(std::move(fit), search.first_fault);
  }
  const double criterion = chosen.trial.criterion;
  chosen.trial = settle_exactly(many, chosen.trial.solution.model, chosen.trial);
  take(all, chosen, options.window_decay, fit);
  const std::string undamped = without_damping(fit);
  if (!undamped.empty()) {
    return refused(std::move(fit), undamped);
  }
  if (fit.responses.front().explained < least_explained) {
    const std::string other = fault_of_kind(lines, 1);
    if (!other.empty()) {
      return refused(std::move(fit), other);
    }
    return refused(std::move(fit),
                   fmt::format("no modes explain this response: the best fit leaves "
                               "{:.0f} % of its power, the sum of |H|^2, unexplained",
                               100 * (1 - fit.responses.front().explained)));
  }
  const Alternative other = alternative_to(chosen, criterion, search.orders);
  fit.criterion = criterion;
  fit.alternative = other.count;
  fit.alternative_odds = other.odds;
  fit.orders = std::move(search.orders);
  fit.ok = true;
  return fit;
}

std::complex<double> modelled(const ModesFit& fit, double omega) {
  ModesModel model{.residual_terms = fit.residual_terms,
                   .residual = {fit.responses.front().residual},
                   .terms = {}};
  for (const auto& modes : {fit.modes, fit.outside, fit.unresolved}) {
    for (const FittedMode& mode : modes) {
      model.terms.push_back({mode.omega.value, mode.zeta.value, {1 / mode.mass.value}});
    }
  }
  return receptance(model, {}, 0, {0.0, omega});
}

}  // namespace trochoid::structure
