#include <trochoid/structure/identify_shapes.h>

#include <trochoid/structure/reciprocity.h>
#include <trochoid/structure/shapes_answer.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace trochoid::structure {

namespace {

constexpr int most_modes = 12;
constexpr int most_outside = 2;
constexpr double least_explained = 0.7;
constexpr int patience = 2;
constexpr int patience_at_first = 4;
constexpr double exactly = 1e-6;
/// Difference of the criterion above which evidence is very strong: odds of 150 to 1.
constexpr double very_strong = 10.0;
/// What one pole explains where there is one mode and no doubt.
constexpr double certain = 0.9;

/// A fit and what speaks against it.
struct Candidate {
  ShapesTrial trial;
  std::vector<TermVerdict> terms;
  std::string fault;  ///< empty: it may be the answer
};

Candidate judged(Responses all, ShapesTrial trial, const ShapesOptions& options) {
  Candidate out{.trial = std::move(trial)};
  for (std::size_t r = 0; r < out.trial.solution.model.terms.size(); ++r) {
    out.terms.push_back(verdict_on(all, out.trial.solution, r));
  }
  out.fault = fault_of(out.terms, options.count, options.residual_terms,
                       out.trial.solution.converged);
  out.trial.criterion +=
      very_strong * static_cast<double>(count_of(out.terms, TermRole::unresolved));
  return out;
}

ShapesOrder order_of(const Candidate& candidate) {
  const ShapesModel& model = candidate.trial.solution.model;
  ShapesOrder out{.order = {.count = count_of(candidate.terms, TermRole::mode),
                            .residual_terms = model.residual_terms,
                            .criterion = candidate.trial.criterion,
                            .fault = candidate.fault},
                  .complex_shapes = model.complex_shapes};
  for (const ShapeTerm& term : model.terms) {
    out.order.modes.emplace_back(term.omega, term.zeta);
  }
  std::sort(out.order.modes.begin(), out.order.modes.end());
  return out;
}

/// What the search has found: the best with real shapes, and with complex ones.
struct Search {
  std::array<Candidate, 2> best;  ///< without terms: none is sound
  std::string first_fault;        ///< of the simplest fit
  std::vector<ShapesOrder> orders;
};

bool found(const Candidate& candidate) {
  return !candidate.trial.solution.model.terms.empty();
}

std::size_t directions_of(Responses all) {
  std::size_t n = 0;
  for (const DirectedResponse& one : all) {
    n = std::max({n, one.motion + 1, one.force + 1});
  }
  return n;
}

/// Whether there are lines enough in each response for so many modes.
bool enough_lines(Responses all, int count) {
  return std::all_of(all.begin(), all.end(), [&](const DirectedResponse& one) {
    return one.response.omega.size() >= static_cast<std::size_t>(4 * count + 4);
  });
}

/// One mode after the other with shapes of one form, residual terms or none.
void search(Responses all, const ShapesOptions& options, bool complex_shapes,
            Search& out) {
  Candidate& best = out.best[complex_shapes ? 1 : 0];
  const int more = options.residual_terms.value_or(true) ? most_outside : 0;
  const int last = options.count > 0 ? options.count + more : most_modes;
  std::array<ShapesTrial, 2> before;
  int since = 0;
  for (int count = 1; count <= last && enough_lines(all, count); ++count) {
    if (since >= (found(best) ? patience : patience_at_first)) {
      break;
    }
    since += count >= options.count ? 1 : 0;
    for (const bool terms : {false, true}) {
      if (options.residual_terms.value_or(terms) != terms) {
        continue;
      }
      ShapesTrial& trial = before[terms ? 1 : 0];
      trial = with_one_more(all, trial, {terms, complex_shapes}, directions_of(all));
      Candidate next = judged(all, trial, options);
      out.orders.push_back(order_of(next));
      if (!next.fault.empty() &&
          (out.first_fault.empty() || count <= std::max(options.count, 1))) {
        out.first_fault = next.fault;
      }
      const std::size_t modes = count_of(next.terms, TermRole::mode);
      const bool right =
          options.count == 0 || modes == static_cast<std::size_t>(options.count);
      if (right && next.fault.empty() &&
          (!found(best) || next.trial.criterion < best.trial.criterion)) {
        best = std::move(next);
        since = 0;
      }
    }
  }
}

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
ShapesTrial as_real(Responses all, const ShapesTrial& trial) {
  ShapesModel model = trial.solution.model;
  model.complex_shapes = false;
  for (ShapeTerm& term : model.terms) {
    for (auto& phi : term.phi) {
      phi = phi.real();
    }
  }
  return settle(all, model, weights_of(all, trial), exactly);
}

/// Terms that are answers, by frequency.
std::vector<std::size_t> answers_of(const Candidate& chosen) {
  std::vector<std::size_t> out;
  for (std::size_t r = 0; r < chosen.terms.size(); ++r) {
    if (chosen.terms[r].role == TermRole::mode) {
      out.push_back(r);
    }
  }
  const auto& terms = chosen.trial.solution.model.terms;
  std::sort(out.begin(), out.end(), [&](std::size_t a, std::size_t b) {
    return terms[a].omega < terms[b].omega;
  });
  return out;
}

/// Fill in a fit from what was chosen.
void take(Responses all, const Candidate& chosen, ShapesFit& fit) {
  const ShapesModel& model = chosen.trial.solution.model;
  const std::vector<std::size_t> answers = answers_of(chosen);
  for (const std::size_t r : answers) {
    fit.modes.push_back(shape_mode(all, chosen.trial.solution, r));
  }
  fit.real_modes = fit.modes;
  fit.covariance = shape_covariance(chosen.trial.solution, answers);
  if (model.complex_shapes) {
    const ShapesTrial real = as_real(all, chosen.trial);
    fit.real_modes.clear();
    for (const std::size_t r : answers) {
      fit.real_modes.push_back(shape_mode(all, real.solution, r));
    }
    fit.covariance = shape_covariance(real.solution, answers);
  }
  for (std::size_t r = 0; r < chosen.terms.size(); ++r) {
    if (chosen.terms[r].role == TermRole::outside) {
      fit.outside.push_back(model.terms[r].omega);
    } else if (chosen.terms[r].role == TermRole::unresolved) {
      fit.left_out.push_back(chosen.terms[r].why);
    }
  }
  fit.complex_shapes = model.complex_shapes;
  fit.residual_terms = model.residual_terms;
  for (std::size_t q = 0; q < all.size(); ++q) {
    fit.responses.push_back(fitted_response(all, chosen.trial, q, answers));
  }
  fit.reciprocity = reciprocity_of(all, chosen.trial);
}

/// Another number of modes of the same form that is nearly as likely.
void add_alternative(const Search& search, double chosen, ShapesFit& fit) {
  double least = chosen + very_strong;
  for (const ShapesOrder& tried : search.orders) {
    const ModesOrder& order = tried.order;
    if (order.fault.empty() && order.count != fit.modes.size() &&
        tried.complex_shapes == fit.complex_shapes && order.criterion < least) {
      least = order.criterion;
      fit.alternative = static_cast<int>(order.count);
      fit.alternative_odds = std::exp(0.5 * (least - chosen));
    }
  }
}

ShapesFit refused(Responses all, std::string reason) {
  ShapesFit fit{.reason = std::move(reason)};
  for (const DirectedResponse& one : all) {
    fit.responses.push_back({.omega = one.response.omega, .H = one.response.H});
  }
  return fit;
}

/// What cannot be answered whatever the fit; empty: nothing.
std::string refusal(Responses all, const ShapesOptions& options) {
  for (const DirectedResponse& one : all) {
    const auto needed = static_cast<std::size_t>(4 * std::max(options.count, 1) + 4);
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

ShapesFit identify_shapes(const std::vector<DirectedResponse>& responses,
                          const ShapesOptions& options) {
  const Responses all = responses;
  const std::string why = refusal(all, options);
  if (!why.empty()) {
    return refused(all, why);
  }
  Search tried;
  for (const bool complex_shapes : {false, true}) {
    if (options.complex_shapes.value_or(complex_shapes) == complex_shapes) {
      search(all, options, complex_shapes, tried);
    }
  }
  const auto& [real, complex] = tried.best;
  const bool both = found(real) && found(complex);
  const double evidence = both ? real.trial.criterion - complex.trial.criterion : 0.0;
  Candidate chosen =
      !found(real) || (found(complex) && evidence > very_strong) ? complex : real;
  if (!found(chosen)) {
    const std::string other = fault_of_direct(all, 1, least_explained);
    return refused(all, other.empty() ? tried.first_fault : other);
  }
  const double criterion = chosen.trial.criterion;
  chosen.trial =
      settle(all, chosen.trial.solution.model, weights_of(all, chosen.trial), exactly);
  ShapesFit fit;
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
  add_alternative(tried, criterion, fit);
  fit.orders = std::move(tried.orders);
  fit.ok = true;
  return fit;
}

}  // namespace trochoid::structure
