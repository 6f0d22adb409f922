#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/modes_faults.h>
#include <trochoid/structure/modes_search.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr int most_modes = 12;           ///< that are chosen without being asked for
constexpr double least_explained = 0.7;  ///< of the sum of |H|^2
/// Orders without a better fit after which the search ends; more while none is sound.
constexpr int patience = 2;
constexpr int patience_at_first = 4;
/// Change of a parameter that ends the last fit, in standard errors.
constexpr double exactly = 1e-6;
/// Difference of the criterion above which evidence is very strong: odds of 150 to 1.
constexpr double very_strong = 10.0;

FrequencyResponse in_band(const FrequencyResponse& response,
                          const ModesOptions& options) {
  FrequencyResponse lines{.kind = response.kind};
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

/// Power of H: the sum of |H|^2.
double power(const FrequencyResponse& lines) {
  double sum = 0.0;
  for (const Complex& H : lines.H) {
    sum += std::norm(H);
  }
  return sum;
}

/// A fit and what speaks against it.
struct Candidate {
  ModesTrial trial;
  std::vector<std::string> left_out;  ///< of each term why it is unresolved, or empty
  std::string fault;                  ///< empty: it may be the answer
};

/// @param whole  all modes must be resolved
Candidate judged(const FrequencyResponse& lines, ModesTrial trial, bool whole) {
  Candidate out{.trial = std::move(trial)};
  std::size_t unresolved = 0;
  const std::size_t count = out.trial.solution.model.terms.size();
  for (std::size_t r = 0; r < count; ++r) {
    ModeFault fault = fault_of(lines, out.trial.solution, r);
    unresolved += fault.unresolved ? 1 : 0;
    out.left_out.push_back(fault.unresolved ? fault.why : "");
    const bool fatal =
        !fault.why.empty() && (whole || !fault.unresolved || unresolved == count);
    if (fatal && out.fault.empty()) {
      out.fault = fault.why;
    }
  }
  if (!out.trial.solution.converged && out.fault.empty()) {
    out.fault = "the fit did not converge";
  }
  out.trial.criterion += very_strong * static_cast<double>(unresolved);
  return out;
}

ModesOrder order_of(const Candidate& candidate) {
  const ModesModel& model = candidate.trial.solution.model;
  ModesOrder out{.residual_terms = model.residual_terms,
                 .criterion = candidate.trial.criterion,
                 .fault = candidate.fault};
  for (const ModeTerm& term : model.terms) {
    out.modes.push_back({term.omega, term.zeta});
  }
  std::sort(out.modes.begin(), out.modes.end());
  return out;
}

/// What the search for the number of modes has found.
struct Search {
  Candidate chosen;         ///< without terms: none is sound
  std::string first_fault;  ///< of the simplest fit
  std::vector<ModesOrder> orders;
};

/// Whether there are numbers enough: three a mode and two residual terms.
bool enough_lines(const FrequencyResponse& lines, int count) {
  return lines.omega.size() >= static_cast<std::size_t>(4 * count + 4);
}

/// Take a candidate into a search; true if it is the best so far.
bool taken(Search& search, Candidate next, bool eligible) {
  search.orders.push_back(order_of(next));
  const Candidate& chosen = search.chosen;
  const bool better = chosen.trial.solution.model.terms.empty() ||
                      next.trial.criterion < chosen.trial.criterion;
  if (!eligible || !next.fault.empty() || !better) {
    return false;
  }
  search.chosen = std::move(next);
  return true;
}

/// One mode after the other, with residual terms and without (M-16, M-17).
Search searched(const FrequencyResponse& lines, const ModesOptions& options) {
  const int first = options.count > 0 ? options.count : 1;
  const int last = options.count > 0 ? options.count : most_modes;
  Search search;
  std::array<ModesTrial, 2> before;
  int since = 0;
  for (int count = 1; count <= last && enough_lines(lines, count); ++count) {
    const bool sound = !search.chosen.trial.solution.model.terms.empty();
    const bool hopeless =
        !sound && since >= patience &&
        (since >= patience_at_first || !fault_of_kind(lines, count - 1).empty());
    if (hopeless || (sound && since >= patience)) {
      break;
    }
    since += count >= first ? 1 : 0;
    for (const bool terms : {false, true}) {
      if (options.residual_terms.value_or(terms) != terms) {
        continue;
      }
      ModesTrial& trial = before[terms ? 1 : 0];
      trial = with_one_more(lines, trial, terms);
      Candidate next = judged(lines, trial, options.count > 0);
      if (!next.fault.empty() && (search.first_fault.empty() || count <= first)) {
        search.first_fault = next.fault;
      }
      since = taken(search, std::move(next), count >= first) ? 0 : since;
    }
  }
  return search;
}

ModesFit refused(ModesFit fit, std::string reason) {
  fit.reason = std::move(reason);
  fit.modes.clear();
  fit.fitted.clear();
  return fit;
}

/// Fill in a fit from what was chosen.
void take(const FrequencyResponse& lines, const ModesTrial& trial,
          const std::vector<std::string>& left_out, ModesFit& fit) {
  const ModesSolution& solution = trial.solution;
  for (std::size_t r = 0; r < solution.model.terms.size(); ++r) {
    auto& modes = left_out[r].empty() ? fit.modes : fit.unresolved;
    modes.push_back(fitted_mode(solution, r));
    modes.back().lines_in_peak = lines_in_peak(lines, solution.model.terms[r]);
    if (!left_out[r].empty()) {
      fit.left_out.push_back(left_out[r]);
    }
  }
  std::sort(fit.modes.begin(), fit.modes.end(),
            [](const FittedMode& a, const FittedMode& b) { return a.omega < b.omega; });
  fit.residual_terms = solution.model.residual_terms;
  fit.above = solution.model.above;
  fit.below = solution.model.below;
  fit.noise = trial.noise;
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    fit.fitted.push_back(factor(lines.kind, lines.omega[i]) *
                         receptance(solution.model, lines.omega[i]));
  }
  fit.explained = 1 - solution.rss / power(lines);
  fit.rms = std::sqrt(solution.rss / static_cast<double>(lines.omega.size()));
}

/// Another number of modes that is nearly as likely.
void add_alternative(const Search& search, ModesFit& fit) {
  const double chosen = search.chosen.trial.criterion;
  const std::size_t count = search.chosen.trial.solution.model.terms.size();
  double least = chosen + very_strong;
  for (const ModesOrder& order : search.orders) {
    if (order.fault.empty() && order.modes.size() != count && order.criterion < least) {
      least = order.criterion;
      fit.alternative = static_cast<int>(order.modes.size());
      fit.alternative_odds = std::exp(0.5 * (order.criterion - chosen));
    }
  }
}

}  // namespace

ModesFit identify_modes(const FrequencyResponse& response,
                        const ModesOptions& options) {
  const FrequencyResponse lines = in_band(response, options);
  ModesFit fit{.omega = lines.omega, .H = lines.H};
  const auto needed = static_cast<std::size_t>(4 * std::max(options.count, 1) + 4);
  if (lines.omega.size() < needed) {
    return refused(
        std::move(fit),
        fmt::format("the band holds {} lines: {} need at least {}", lines.omega.size(),
                    options.count > 1 ? fmt::format("{} modes", options.count)
                                      : "one mode and its surroundings",
                    needed));
  }
  if (!(power(lines) > 0)) {
    return refused(std::move(fit), "the response is zero in the whole band");
  }
  Search search = searched(lines, options);
  const ModesTrial& rough = search.chosen.trial;
  const std::size_t count = rough.solution.model.terms.size();
  const std::string kind =
      fault_of_kind(lines, static_cast<int>(std::max<std::size_t>(count, 1)));
  if (!kind.empty()) {
    return refused(std::move(fit), kind);
  }
  if (count == 0) {
    return refused(std::move(fit), search.first_fault);
  }
  const ModesModel& model = rough.solution.model;
  const ModesTrial chosen =
      settle(lines, model, weights_of(lines, rough.noise, model), exactly);
  take(lines, chosen, search.chosen.left_out, fit);
  if (fit.explained < least_explained) {
    return refused(std::move(fit),
                   fmt::format("no modes explain this response: the best fit leaves "
                               "{:.0f} % of its power, the sum of |H|^2, unexplained",
                               100 * (1 - fit.explained)));
  }
  add_alternative(search, fit);
  fit.orders = std::move(search.orders);
  fit.ok = true;
  return fit;
}

std::complex<double> modelled(const ModesFit& fit, double omega) {
  ModesModel model{
      .residual_terms = fit.residual_terms, .above = fit.above, .below = fit.below};
  for (const auto& modes : {fit.modes, fit.unresolved}) {
    for (const FittedMode& mode : modes) {
      model.terms.push_back({mode.omega, mode.zeta, 1 / mode.mode.mass});
    }
  }
  return receptance(model, omega);
}

}  // namespace trochoid::structure
