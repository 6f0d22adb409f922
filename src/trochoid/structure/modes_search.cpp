#include <trochoid/structure/modes_search.h>
#include <trochoid/structure/pole_search.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr int scout_iterations = 12;
constexpr int fit_iterations = 60;
constexpr int most_rounds = 60;
constexpr double roughly = 0.03;  ///< of a standard error, while modes are sought
constexpr std::size_t places_of_power = 60;
constexpr std::size_t places_everywhere = 60;
constexpr std::size_t neighbours = 3;
constexpr std::size_t places_tried = 2;
constexpr std::array dampings = {0.003, 0.01, 0.03, 0.1};
constexpr double most_damping = 0.5;

/// A place for one mode more, and what it would gain.
struct Place {
  ModeTerm term;
  double gain = 0.0;
};

/// A line as the search for places sees it.
struct WeighedLine {
  double omega = 0.0;
  Complex f;                         ///< M-4, turned, its parts still to be weighted
  double along = 0.0, across = 0.0;  ///< weights
  double r_along = 0.0, r_across = 0.0;  ///< weighted residual
};

std::vector<WeighedLine> weighed(const FrequencyResponse& lines,
                                 const LineWeights& weights,
                                 const std::vector<Complex>& left) {
  std::vector<WeighedLine> out;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Complex r = left[i] * weights.turn[i];
    out.push_back({.omega = lines.omega[i],
                   .f = factor(lines.kind, lines.omega[i]) * weights.turn[i],
                   .along = weights.along[i],
                   .across = weights.across[i],
                   .r_along = r.real() * weights.along[i],
                   .r_across = r.imag() * weights.across[i]});
  }
  return out;
}

/// What a mode alone would take of the residual (M-17).
Place place_at(const std::vector<WeighedLine>& lines, double omega, double zeta) {
  double gr = 0.0;
  double gg = 0.0;
  for (const WeighedLine& line : lines) {
    const double re = omega * omega - line.omega * line.omega;
    const double im = -2 * zeta * omega * line.omega;
    const double norm = 1 / (re * re + im * im);
    const double along = (re * line.f.real() - im * line.f.imag()) * norm * line.along;
    const double across =
        (re * line.f.imag() + im * line.f.real()) * norm * line.across;
    gr += along * line.r_along + across * line.r_across;
    gg += along * along + across * across;
  }
  const double A = gr / gg;
  return {.term = {omega, zeta, A}, .gain = A > 0 ? gr * A : 0.0};
}

/// Lines worth a look: those around which most is left, and some everywhere.
std::vector<std::size_t> lines_to_try(const std::vector<WeighedLine>& lines) {
  const std::size_t n = lines.size();
  std::vector<double> sum(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    sum[i + 1] = sum[i] + lines[i].r_along * lines[i].r_along +
                 lines[i].r_across * lines[i].r_across;
  }
  const auto around = [&](std::size_t i) {
    return sum[std::min(i + neighbours + 1, n)] - sum[i - std::min(i, neighbours)];
  };
  std::vector<std::size_t> order(n);
  for (std::size_t i = 0; i < n; ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return around(a) > around(b); });
  order.resize(std::min(n, places_of_power));
  const std::size_t step = 1 + (n - 1) / places_everywhere;
  for (std::size_t i = 0; i < n; i += step) order.push_back(i);
  return order;
}

/// Where one mode more would gain most, places apart from one another.
std::vector<ModeTerm> places(const FrequencyResponse& response,
                             const LineWeights& weights,
                             const std::vector<Complex>& left) {
  const std::vector<WeighedLine> lines = weighed(response, weights, left);
  std::vector<Place> all;
  for (const std::size_t i : lines_to_try(lines)) {
    for (const double zeta : dampings) {
      all.push_back(place_at(lines, lines[i].omega, zeta));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Place& a, const Place& b) { return a.gain > b.gain; });
  std::vector<ModeTerm> out;
  for (const Place& p : all) {
    const bool near = std::any_of(out.begin(), out.end(), [&](const ModeTerm& t) {
      return std::abs(p.term.omega - t.omega) < 0.05 * t.omega;
    });
    if (!near && p.gain > 0) {
      out.push_back(p.term);
    }
    if (out.size() == places_tried) {
      break;
    }
  }
  return out;
}

/// All modes anew, by vector fitting.
ModesModel from_poles(const FrequencyResponse& lines, std::size_t count,
                      bool residual_terms) {
  ModesModel model{.residual_terms = residual_terms};
  const Poles poles = find_poles(lines, static_cast<int>(count), residual_terms);
  for (const Pole& pole : poles.pairs) {
    const double omega = std::abs(pole.p);
    model.terms.push_back(
        {.omega = omega,
         .zeta = std::clamp(std::abs(pole.p.real()) / omega, 1e-5, 0.9)});
  }
  return model;
}

/// One mode of a model as two beside one another.
ModesModel split(ModesModel model, std::size_t r) {
  ModeTerm& t = model.terms[r];
  const double apart = std::min(t.zeta, 0.2);
  ModeTerm other = t;
  t.omega *= 1 - 0.7 * apart;
  other.omega *= 1 + 0.7 * apart;
  t.zeta *= 0.6;
  other.zeta *= 0.6;
  t.A *= 0.5;
  other.A *= 0.5;
  model.terms.push_back(other);
  return model;
}

/// Whether all modes inside the band could be resonances, and there is one.
bool plausible(const FrequencyResponse& lines, const ModesModel& model) {
  bool any = false;
  for (const ModeTerm& t : model.terms) {
    if (t.omega > lines.omega.front() && t.omega < lines.omega.back()) {
      any = true;
      if (t.A <= 0 || t.zeta >= most_damping) return false;
    }
  }
  return any;
}

/// The best of some starts after a few steps: plausible ones first.
ModesModel scouted(const FrequencyResponse& lines, const LineWeights& weights,
                   const std::vector<ModesModel>& starts) {
  ModesModel best;
  std::pair<bool, double> rank{true, std::numeric_limits<double>::infinity()};
  for (ModesModel start : starts) {
    fit_linear(lines, weights, start);
    ModesSolution found = fit_modes(lines, weights, start, scout_iterations);
    const std::pair<bool, double> own{!plausible(lines, found.model), found.cost};
    if (own < rank || best.terms.empty()) {
      rank = own;
      best = std::move(found.model);
    }
  }
  return best;
}

/// Largest change of frequency, damping and A between two models, in standard errors.
double moved(const ModesSolution& from, const ModesSolution& to) {
  double most = 0.0;
  for (std::size_t r = 0; r < to.model.terms.size(); ++r) {
    const ModeTerm& a = from.model.terms[r];
    const ModeTerm& b = to.model.terms[r];
    const std::array change = {b.omega - a.omega, b.zeta - a.zeta, b.A - a.A};
    for (std::size_t k = 0; k < 3 && !to.variance.empty(); ++k) {
      most = std::max(most, std::abs(change[k]) / std::sqrt(to.variance[3 * r + k]));
    }
  }
  return most;
}

std::size_t lines_of(const FrequencyResponse& lines) {
  return lines.omega.size();
}

}  // namespace

ModesTrial settle(const FrequencyResponse& lines, const ModesModel& start,
                  LineWeights weights, double tolerance) {
  ModesTrial out;
  ModesModel model = start;
  NoiseEstimate noise;
  for (int round = 0; round < most_rounds; ++round) {
    ModesSolution next = fit_modes(lines, weights, model, fit_iterations);
    describe(lines, weights, next);
    const bool stands = round > 1 && moved(out.solution, next) < tolerance;
    out.solution = std::move(next);
    if (stands) {
      break;
    }
    noise = estimate_noise(lines, out.solution);
    model = out.solution.model;
    weights = weights_of(lines, noise.noise, model);
  }
  out.noise = noise.noise;
  // Lines that share their noise count for fewer (M-23).
  const double n = static_cast<double>(2 * lines_of(lines)) / lines.noise_bandwidth;
  const auto p = static_cast<double>(model.size()) + noise.parameters;
  out.criterion = noise.deviance / lines.noise_bandwidth + p * std::log(n);
  return out;
}

ModesTrial with_one_more(const FrequencyResponse& lines, const ModesTrial& before,
                         bool residual_terms) {
  const ModesModel& known = before.solution.model;
  const LineWeights even = even_weights(lines_of(lines));
  std::vector<LineWeights> weightings = {even};
  if (!known.terms.empty()) {
    weightings.push_back(weights_of(lines, before.noise, known));
  }
  const std::vector<Complex> left = gaps(lines, known);
  std::vector<ModesModel> starts = {
      from_poles(lines, known.terms.size() + 1, residual_terms)};
  for (const LineWeights& weights : weightings) {
    for (const ModeTerm& term : places(lines, weights, left)) {
      starts.push_back(known);
      starts.back().terms.push_back(term);
    }
  }
  for (std::size_t r = 0; r < known.terms.size(); ++r) {
    starts.push_back(split(known, r));
  }
  for (const double outside : {0.5 * lines.omega.front(), 1.5 * lines.omega.back()}) {
    starts.push_back(known);
    starts.back().terms.push_back({.omega = outside, .zeta = 0.03});
  }
  for (ModesModel& start : starts) {
    start.residual_terms = residual_terms;
  }
  ModesTrial best;
  for (const LineWeights& weights : weightings) {
    const ModesModel scout = scouted(lines, weights, starts);
    ModesTrial trial = settle(lines, scout, weights, roughly);
    const bool first = best.solution.model.terms.empty();
    if (first ||
        std::pair{!plausible(lines, trial.solution.model), trial.criterion} <
            std::pair{!plausible(lines, best.solution.model), best.criterion}) {
      best = std::move(trial);
    }
  }
  return best;
}

}  // namespace trochoid::structure
