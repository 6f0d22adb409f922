#include <trochoid/structure/modes_order.h>

#include <trochoid/numerics/parallel.h>
#include <trochoid/structure/thinned.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::structure {

namespace {

/// Modes outside of the band beside those that were asked for.
constexpr int most_outside = 2;
constexpr int most_modes = 12;  ///< that are chosen without being asked for
/// Orders without a better fit after which the search ends; more while none is sound.
constexpr int patience = 2;
constexpr int patience_at_first = 4;
/// Fraction of the power of a response below which nothing is left to explain.
constexpr double rounding = 1e-20;
/// Change of a parameter that ends the last fit, in standard errors; where lines were
/// thinned no digit hangs on more.
constexpr double exactly = 1e-6;
constexpr double closely = 1e-3;

Candidate judged(Responses all, ModesTrial trial, const ModesOptions& options) {
  Candidate out{.trial = std::move(trial), .terms = {}, .fault = {}};
  for (std::size_t r = 0; r < out.trial.solution.model.terms.size(); ++r) {
    out.terms.push_back(verdict_on(all, out.trial.solution, r));
  }
  out.fault = fault_of(out.terms, options.count, options.residual_terms,
                       out.trial.solution.converged);
  out.trial.criterion +=
      very_strong * static_cast<double>(count_of(out.terms, TermRole::unresolved));
  return out;
}

ModesOrder order_of(const Candidate& candidate) {
  const ModesModel& model = candidate.trial.solution.model;
  ModesOrder out{.modes = {},
                 .count = count_of(candidate.terms, TermRole::mode),
                 .residual_terms = model.residual_terms,
                 .criterion = candidate.trial.criterion,
                 .fault = candidate.fault,
                 .complex_shapes = model.complex_shapes()};
  for (const ModeTerm& term : model.terms) {
    out.modes.emplace_back(term.omega, term.zeta);
  }
  std::sort(out.modes.begin(), out.modes.end());
  return out;
}

std::size_t directions_of(Responses all) {
  std::size_t n = 0;
  for (const DirectedResponse& one : all) {
    n = std::max({n, one.motion + 1, one.force + 1});
  }
  return n;
}

bool enough_lines(Responses all, int count) {
  return std::all_of(all.begin(), all.end(), [&](const DirectedResponse& one) {
    return one.response.omega.size() >= lines_needed(count);
  });
}

/// Whether one mode more, after some that bettered nothing, is not worth a try.
/// @param since  orders without a better fit
bool given_up(Responses all, ModeForm form, const Candidate& best, int since,
              int count) {
  const ModesModel& model = best.trial.solution.model;
  const DirectedResponse& first = all.front();
  if (form == ModeForm::residue && best.found() &&
      left_over(model, first, 0) < rounding * power(first.response)) {
    return true;
  }
  if (since < patience) {
    return false;
  }
  // A single response that is not of its kind is fitted ever worse: that is said soon.
  return best.found() || since >= patience_at_first ||
         (form == ModeForm::residue &&
          !fault_of_kind(first.response, count - 1).empty());
}

/// Take a candidate into a search; true if it is the best so far.
/// @param wanted  number of modes; 0: any
bool taken(Candidate& best, Candidate next, int wanted) {
  const bool right = wanted == 0 || count_of(next.terms, TermRole::mode) ==
                                        static_cast<std::size_t>(wanted);
  if (!right || !next.fault.empty() ||
      (best.found() && !(next.trial.criterion < best.trial.criterion))) {
    return false;
  }
  best = std::move(next);
  return true;
}

/// A candidate without a fault, and its place among the orders.
struct Sound {
  std::size_t order = 0;
  Candidate candidate;
};

/// Orders whose criterion is above the least by more are not judged again.
constexpr double near_the_best = 40.0;

/// The best of those that are near it in few lines, by many.
/// @param[in,out] best    becomes that of many lines
/// @param[in,out] orders  get the criterion of many; far ones keep their distance
void judge_in_many(const SearchLines& lines, const ModesOptions& options,
                   const std::vector<Sound>& sound, Candidate& best,
                   std::vector<ModesOrder>& orders) {
  const double least = best.trial.criterion;
  const bool complex_shapes = best.trial.solution.model.complex_shapes();
  std::vector<const Sound*> near;
  std::vector<std::size_t> again;
  for (const Sound& one : sound) {
    if (one.candidate.trial.criterion - least <= near_the_best) {
      near.push_back(&one);
      again.push_back(one.order);
    }
  }
  std::vector<Candidate> anew(near.size());
  numerics::for_each_index(
      near.size(),
      [&](std::size_t i) {
        const ModesTrial& rough = near[i]->candidate.trial;
        anew[i] =
            judged(lines.all, settle_exactly(lines.many, rough.solution.model, rough),
                   options);
      },
      1);
  Candidate found;
  double shift = 0.0;
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (near[i]->candidate.trial.criterion <= least) {
      shift = anew[i].trial.criterion - least;
    }
    orders[near[i]->order] = order_of(anew[i]);
    taken(found, std::move(anew[i]), options.count);
  }
  for (std::size_t i = 0; i < orders.size(); ++i) {
    const bool done = std::ranges::find(again, i) != again.end();
    if (!done && orders[i].complex_shapes == complex_shapes) {
      orders[i].criterion += shift;
    }
  }
  if (found.found()) best = std::move(found);
}

/// A model without modes, from which a search begins.
ModesTrial empty(Responses all, ModeForm form, bool residual_terms) {
  ModesTrial out;
  ModesModel& model = out.solution.model;
  model.form = form;
  model.residual_terms = residual_terms;
  model.directions = directions_of(all);
  model.residual.resize(all.size());
  return out;
}

}  // namespace

std::size_t lines_needed(int count) noexcept {
  return static_cast<std::size_t>(4 * count + 4);
}

void search_orders(const SearchLines& lines, const ModesOptions& options, ModeForm form,
                   OrderSearch& out) {
  const Responses few = lines.few;
  Candidate& best = out.best[form == ModeForm::complex_shapes ? 1 : 0];
  const int more = options.residual_terms.value_or(true) ? most_outside : 0;
  const int last = options.count > 0 ? options.count + more : most_modes;
  std::array<ModesTrial, 2> before = {empty(few, form, false), empty(few, form, true)};
  std::vector<Sound> sound;
  int since = 0;
  for (int count = 1; count <= last && enough_lines(few, count); ++count) {
    if (given_up(few, form, best, since, count)) {
      break;
    }
    since += count >= options.count ? 1 : 0;
    std::array<Candidate, 2> tried;
    numerics::for_each_index(
        2,
        [&](std::size_t terms) {
          if (options.residual_terms.value_or(terms == 1) == (terms == 1)) {
            before[terms] = with_one_more(few, before[terms]);
            tried[terms] = judged(lines.all, before[terms], options);
          }
        },
        1);
    for (Candidate& next : tried) {
      if (!next.found()) {
        continue;
      }
      out.orders.push_back(order_of(next));
      if (!next.fault.empty() &&
          (out.first_fault.empty() || count <= std::max(options.count, 1))) {
        out.first_fault = next.fault;
      }
      if (next.fault.empty()) sound.push_back({out.orders.size() - 1, next});
      since = taken(best, std::move(next), options.count) ? 0 : since;
    }
  }
  if (is_thinned(few) && best.found()) {
    judge_in_many(lines, options, sound, best, out.orders);
  }
}

ModesTrial settle_exactly(Responses all, const ModesModel& start,
                          const ModesTrial& rough) {
  return settle(all, start, weights_of(all, rough),
                is_thinned(all) ? closely : exactly);
}

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

Alternative alternative_to(const Candidate& chosen, double criterion,
                           const std::vector<ModesOrder>& orders) {
  const std::size_t count = count_of(chosen.terms, TermRole::mode);
  const bool complex_shapes = chosen.trial.solution.model.complex_shapes();
  Alternative out;
  double least = criterion + very_strong;
  for (const ModesOrder& order : orders) {
    if (order.fault.empty() && order.count != count &&
        order.complex_shapes == complex_shapes && order.criterion < least) {
      least = order.criterion;
      out = {.count = static_cast<int>(order.count),
             .odds = std::exp(0.5 * (order.criterion - criterion))};
    }
  }
  return out;
}

}  // namespace trochoid::structure
