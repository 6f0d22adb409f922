#include <trochoid/base/units.h>
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

/// Modes outside of the band beside those that were asked for.
constexpr int most_outside = 2;
constexpr int most_modes = 12;           ///< that are chosen without being asked for
constexpr double least_explained = 0.7;  ///< of the sum of |H|^2
/// Orders without a better fit after which the search ends; more while none is sound.
constexpr int patience = 2;
constexpr int patience_at_first = 4;
/// Change of a parameter that ends the last fit, in standard errors.
constexpr double exactly = 1e-6;
/// Difference of the criterion above which evidence is very strong: odds of 150 to 1.
constexpr double very_strong = 10.0;
/// What one pole explains where there is one mode and no doubt.
constexpr double certain = 0.9;
/// Fraction of the power of a response below which nothing is left to explain.
constexpr double rounding = 1e-20;

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
  std::vector<TermVerdict> terms;
  std::string fault;  ///< empty: it may be the answer
};

Candidate judged(const FrequencyResponse& lines, ModesTrial trial,
                 const ModesOptions& options) {
  Candidate out{.trial = std::move(trial)};
  for (std::size_t r = 0; r < out.trial.solution.model.terms.size(); ++r) {
    out.terms.push_back(verdict_on(lines, out.trial.solution, r));
  }
  out.fault = fault_of(out.terms, options.count, options.residual_terms,
                       out.trial.solution.converged);
  out.trial.criterion +=
      very_strong * static_cast<double>(count_of(out.terms, TermRole::unresolved));
  return out;
}

ModesOrder order_of(const Candidate& candidate) {
  const ModesModel& model = candidate.trial.solution.model;
  ModesOrder out{.count = count_of(candidate.terms, TermRole::mode),
                 .residual_terms = model.residual_terms,
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
/// @param wanted  number of modes; 0: any
bool taken(Search& search, Candidate next, int wanted) {
  search.orders.push_back(order_of(next));
  const Candidate& chosen = search.chosen;
  const bool better = chosen.trial.solution.model.terms.empty() ||
                      next.trial.criterion < chosen.trial.criterion;
  const bool right = wanted == 0 || count_of(next.terms, TermRole::mode) ==
                                        static_cast<std::size_t>(wanted);
  if (!right || !next.fault.empty() || !better) {
    return false;
  }
  search.chosen = std::move(next);
  return true;
}

/// Whether one mode more, after some that bettered nothing, is not worth a try.
bool given_up(const FrequencyResponse& lines, const Search& search, int since,
              int count) {
  const ModesSolution& chosen = search.chosen.trial.solution;
  const bool sound = !chosen.model.terms.empty();
  if (sound && chosen.rss < rounding * power(lines)) {
    return true;
  }
  if (since < patience) {
    return false;
  }
  return sound || since >= patience_at_first ||
         !fault_of_kind(lines, count - 1).empty();
}

/// One mode after the other, with residual terms and without (M-16, M-17).
Search searched(const FrequencyResponse& lines, const ModesOptions& options) {
  const int more = options.residual_terms.value_or(true) ? most_outside : 0;
  const int last = options.count > 0 ? options.count + more : most_modes;
  Search search;
  std::array<ModesTrial, 2> before;
  int since = 0;
  for (int count = 1; count <= last && enough_lines(lines, count); ++count) {
    if (given_up(lines, search, since, count)) {
      break;
    }
    since += count >= options.count ? 1 : 0;
    for (const bool terms : {false, true}) {
      if (options.residual_terms.value_or(terms) != terms) {
        continue;
      }
      ModesTrial& trial = before[terms ? 1 : 0];
      trial = with_one_more(lines, trial, terms);
      Candidate next = judged(lines, trial, options);
      if (!next.fault.empty() &&
          (search.first_fault.empty() || count <= std::max(options.count, 1))) {
        search.first_fault = next.fault;
      }
      since = taken(search, std::move(next), options.count) ? 0 : since;
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
          const std::vector<TermVerdict>& terms, double window_decay, ModesFit& fit) {
  const ModesSolution& solution = trial.solution;
  std::vector<std::pair<double, std::size_t>> answers;  // natural frequency, term
  for (std::size_t r = 0; r < terms.size(); ++r) {
    FittedMode mode = fitted_mode(solution, r, window_decay);
    mode.lines_in_peak = lines_in_peak(lines, solution.model.terms[r]);
    if (terms[r].role == TermRole::mode) {
      fit.modes.push_back(mode);
      answers.emplace_back(mode.omega, r);
    } else if (terms[r].role == TermRole::outside) {
      fit.outside.push_back(mode);
    } else {
      fit.unresolved.push_back(mode);
      fit.left_out.push_back(terms[r].why);
    }
  }
  std::sort(fit.modes.begin(), fit.modes.end(),
            [](const FittedMode& a, const FittedMode& b) { return a.omega < b.omega; });
  std::sort(answers.begin(), answers.end());
  std::vector<std::size_t> order;
  for (const auto& [omega, term] : answers) {
    order.push_back(term);
  }
  fit.covariance = mode_covariance(solution, order, window_decay);
  fit.residual_terms = solution.model.residual_terms;
  fit.residual = solution.model.residual;
  fit.noise = trial.noise;
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    fit.fitted.push_back(factor(lines.kind, lines.omega[i]) *
                         receptance(solution.model, lines.omega[i]));
  }
  fit.explained = 1 - solution.rss / power(lines);
  fit.rms = std::sqrt(solution.rss / static_cast<double>(lines.omega.size()));
}

/// Which mode has less damping than the exponential window adds; empty: none.
std::string without_damping(const ModesFit& fit) {
  for (const FittedMode& mode : fit.modes) {
    if (!(mode.mode.damping > 0)) {
      return fmt::format(
          "the damping of the mode at {:.5g} Hz cannot be told from that of the "
          "exponential window: take longer blocks, or a weaker window",
          mode.omega / unit::Hz);
    }
  }
  return {};
}

/// Another number of modes that is nearly as likely.
void add_alternative(const Search& search, ModesFit& fit) {
  const double chosen = search.chosen.trial.criterion;
  const std::size_t count = fit.modes.size();
  double least = chosen + very_strong;
  for (const ModesOrder& order : search.orders) {
    if (order.fault.empty() && order.count != count && order.criterion < least) {
      least = order.criterion;
      fit.alternative = static_cast<int>(order.count);
      fit.alternative_odds = std::exp(0.5 * (order.criterion - chosen));
    }
  }
}

}  // namespace

ModesFit identify_modes(const FrequencyResponse& response,
                        const ModesOptions& options) {
  const FrequencyResponse lines = in_band(response, options);
  ModesFit fit{.omega = lines.omega,
               .H = lines.H,
               .window_decay = options.window_decay,
               .noise_bandwidth = lines.noise_bandwidth};
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
  const std::string turned = fault_of_kind(lines, 1, certain);
  if (!turned.empty()) {
    return refused(std::move(fit), turned);
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
  take(lines, chosen, search.chosen.terms, options.window_decay, fit);
  const std::string undamped = without_damping(fit);
  if (!undamped.empty()) {
    return refused(std::move(fit), undamped);
  }
  if (fit.explained < least_explained) {
    const std::string other = fault_of_kind(lines, 1);
    if (!other.empty()) {
      return refused(std::move(fit), other);
    }
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
  ModesModel model{.residual_terms = fit.residual_terms, .residual = fit.residual};
  for (const auto& modes : {fit.modes, fit.outside, fit.unresolved}) {
    for (const FittedMode& mode : modes) {
      model.terms.push_back({mode.omega, mode.zeta, 1 / mode.mode.mass});
    }
  }
  return receptance(model, omega);
}

}  // namespace trochoid::structure
