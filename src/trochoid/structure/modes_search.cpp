#include <trochoid/structure/modes_search.h>

#include <trochoid/structure/modes_start.h>
#include <trochoid/structure/pole_search.h>
#include <trochoid/structure/thinned.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

constexpr int first_iterations = 4;  ///< of every start
constexpr int scout_iterations = 12;
constexpr std::size_t starts_followed = 3;  ///< the best after the first iterations
constexpr int fit_iterations = 60;
constexpr int most_rounds = 60;
/// Thinned lines need no digit that more rounds would settle.
constexpr int most_rounds_of_thinned = 12;
constexpr double roughly = 0.03;  ///< of a standard error, while modes are sought

/// Whether all modes inside the band could be resonances, and there is one.
bool plausible(Responses all, const ModesModel& model) {
  bool any = false;
  for (const ModeTerm& t : model.terms) {
    for (const DirectedResponse& one : all) {
      if (t.omega > one.response.omega.front() && t.omega < one.response.omega.back()) {
        any = true;
        if (t.zeta >= most_damping ||
            (model.is_residue() && t.phi.front().real() <= 0)) {
          return false;
        }
      }
    }
  }
  return any;
}

/// The linear parameters for the poles of a start. A shape is no linear parameter: it
/// comes with its start.
void fit_linear(Responses all, const AllWeights& weights, ModesModel& start) {
  if (!start.is_residue()) {
    return;
  }
  const Residues found = fit_residues(all.front(), weights.front(), start);
  for (std::size_t r = 0; r < start.terms.size(); ++r) {
    start.terms[r].phi = {found.Z[r]};
  }
  start.residual = {found.residual};
}

/// A start after some steps.
struct Scout {
  ModesModel model;
  std::pair<bool, double> rank;  ///< plausible ones first
};

Scout scout(Responses all, const AllWeights& weights, const ModesModel& start,
            int iterations) {
  ModesSolution found = fit_modes(all, weights, start, iterations);
  const bool sound = plausible(all, found.model);
  return {std::move(found.model), {!sound, found.cost}};
}

/// The best of some starts after a few steps; the best after fewer steps take more.
ModesModel scouted(Responses all, const AllWeights& weights,
                   const std::vector<ModesModel>& starts) {
  std::vector<Scout> first;
  for (ModesModel start : starts) {
    fit_linear(all, weights, start);
    first.push_back(scout(all, weights, start, first_iterations));
  }
  std::ranges::stable_sort(first, {}, &Scout::rank);
  first.resize(std::min(first.size(), starts_followed));
  for (Scout& one : first) {
    one = scout(all, weights, one.model, scout_iterations - first_iterations);
  }
  return std::move(std::ranges::min_element(first, {}, &Scout::rank)->model);
}

/// Largest change of a pole, a residue or a shape between two models, in standard errors.
double moved(const ModesSolution& from, const ModesSolution& to) {
  double most = 0.0;
  for (std::size_t r = 0; r < to.model.terms.size() && !to.covariance.empty(); ++r) {
    const ModeTerm& a = from.model.terms[r];
    const ModeTerm& b = to.model.terms[r];
    std::size_t k = r * to.model.term_size();
    const auto change = [&](double by) {
      most = std::max(most, std::abs(by) / std::sqrt(to.variance(k)));
      ++k;
    };
    change(b.omega - a.omega);
    change(b.zeta - a.zeta);
    for (std::size_t m = 0; m < b.phi.size(); ++m) {
      change(b.phi[m].real() - a.phi[m].real());
    }
    for (std::size_t m = 0; to.model.complex_shapes() && m < b.phi.size(); ++m) {
      change(b.phi[m].imag() - a.phi[m].imag());
    }
  }
  return most;
}

}  // namespace

AllWeights weights_of(Responses all, const ModesTrial& trial) {
  const ModesModel& model = trial.solution.model;
  AllWeights out;
  for (std::size_t q = 0; q < all.size(); ++q) {
    out.push_back(weights_of(modelled(model, all[q], q), trial.noise[q]));
    // Lines that share their noise count for fewer (M-23); one response alone has the
    // same share everywhere, and its covariance takes it.
    const FrequencyResponse& lines = all[q].response;
    const double share = model.is_residue() ? 1.0 : std::sqrt(lines.noise_bandwidth);
    for (std::size_t i = 0; i < out.back().along.size(); ++i) {
      out.back().along[i] *= lines.calmer(i) / share;
      out.back().across[i] *= lines.calmer(i) / share;
    }
  }
  return out;
}

ModesTrial settle(Responses all, const ModesModel& start, AllWeights weights,
                  double tolerance) {
  ModesTrial out;
  ModesModel model = start;
  double deviance = 0.0;
  double n = 0.0;
  int noise_parameters = 0;
  const int rounds = is_thinned(all) ? most_rounds_of_thinned : most_rounds;
  for (int round = 0; round < rounds; ++round) {
    ModesSolution next = fit_modes(all, weights, model, fit_iterations);
    describe(all, weights, next);
    const bool stands = round > 1 && moved(out.solution, next) < tolerance;
    out.solution = std::move(next);
    if (stands) {
      break;
    }
    model = out.solution.model;
    out.noise.clear();
    deviance = n = 0.0;
    noise_parameters = 0;
    for (std::size_t q = 0; q < all.size(); ++q) {
      const std::vector<double> unknown;
      const bool known = !out.solution.leverage.empty();
      const FrequencyResponse& lines = all[q].response;
      const NoiseEstimate noise = estimate_noise(
          lines, gaps(model, all[q], q), known ? out.solution.leverage[q] : unknown);
      out.noise.push_back(noise.noise);
      noise_parameters += noise.parameters;
      deviance += noise.deviance / lines.noise_bandwidth;
      n += static_cast<double>(2 * lines.omega.size()) / lines.noise_bandwidth;
    }
    weights = weights_of(all, out);
  }
  out.criterion = deviance + (static_cast<double>(model.size()) + noise_parameters) *
                                 std::log(n);  // M-31
  return out;
}

ModesTrial with_one_more(Responses all, const ModesTrial& before) {
  const ModesModel& known = before.solution.model;
  std::vector<AllWeights> weightings = {even_weights(all, known.form)};
  if (before.found()) {
    weightings.push_back(weights_of(all, before));
  }
  const std::span<const AllWeights> both = weightings;
  // The residues of a start are fitted anew with each of the weights, so one set of
  // starts serves both; a shape stays as its start has it.
  std::vector<ModesModel> starts;
  ModesTrial best;
  for (std::size_t k = 0; k < both.size(); ++k) {
    if (!known.is_residue()) {
      starts = starts_with_one_more(all, both.subspan(k, 1), known);
    } else if (k == 0) {
      starts = starts_with_one_more(all, both, known);
    }
    ModesTrial trial = settle(all, scouted(all, both[k], starts), both[k], roughly);
    if (!best.found() ||
        std::pair{!plausible(all, trial.solution.model), trial.criterion} <
            std::pair{!plausible(all, best.solution.model), best.criterion}) {
      best = std::move(trial);
    }
  }
  return best;
}

}  // namespace trochoid::structure
