#include <trochoid/structure/shapes_search.h>

#include <trochoid/structure/shapes_start.h>

#include <algorithm>
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
constexpr double most_damping = 0.5;

/// Whether all modes inside the band could be resonances, and there is one.
bool plausible(Responses all, const ShapesModel& model) {
  bool any = false;
  for (const ShapeTerm& t : model.terms) {
    for (const DirectedResponse& one : all) {
      if (t.omega > one.response.omega.front() && t.omega < one.response.omega.back()) {
        any = true;
        if (t.zeta >= most_damping) {
          return false;
        }
      }
    }
  }
  return any;
}

/// The best of some starts after a few steps: plausible ones first.
ShapesModel scouted(Responses all, const AllWeights& weights,
                    const std::vector<ShapesModel>& starts) {
  ShapesModel best;
  std::pair<bool, double> rank{true, std::numeric_limits<double>::infinity()};
  for (const ShapesModel& start : starts) {
    ShapesSolution found = fit_shapes(all, weights, start, scout_iterations);
    const std::pair<bool, double> own{!plausible(all, found.model), found.cost};
    if (own < rank || best.terms.empty()) {
      rank = own;
      best = std::move(found.model);
    }
  }
  return best;
}

/// Largest change of a pole or a shape between two models, in standard errors.
double moved(const ShapesSolution& from, const ShapesSolution& to) {
  const std::size_t n = to.model.size();
  double most = 0.0;
  for (std::size_t r = 0; r < to.model.terms.size() && !to.covariance.empty(); ++r) {
    const ShapeTerm& a = from.model.terms[r];
    const ShapeTerm& b = to.model.terms[r];
    std::size_t k = r * to.model.term_size();
    const auto change = [&](double by) {
      most = std::max(most, std::abs(by) / std::sqrt(to.covariance[k * n + k]));
      ++k;
    };
    change(b.omega - a.omega);
    change(b.zeta - a.zeta);
    for (std::size_t m = 0; m < b.phi.size(); ++m) {
      change(b.phi[m].real() - a.phi[m].real());
    }
    for (std::size_t m = 0; to.model.complex_shapes && m < b.phi.size(); ++m) {
      change(b.phi[m].imag() - a.phi[m].imag());
    }
  }
  return most;
}

}  // namespace

AllWeights weights_of(Responses all, const ShapesTrial& trial) {
  AllWeights out;
  for (std::size_t q = 0; q < all.size(); ++q) {
    out.push_back(
        weights_of(modelled(trial.solution.model, all[q], q), trial.noise[q]));
    // Lines that share their noise count for fewer (M-23).
    const double share = std::sqrt(all[q].response.noise_bandwidth);
    for (std::size_t i = 0; i < out.back().along.size(); ++i) {
      out.back().along[i] /= share;
      out.back().across[i] /= share;
    }
  }
  return out;
}

ShapesTrial settle(Responses all, const ShapesModel& start, AllWeights weights,
                   double tolerance) {
  ShapesTrial out;
  ShapesModel model = start;
  double deviance = 0.0;
  double n = 0.0;
  int noise_parameters = 0;
  for (int round = 0; round < most_rounds; ++round) {
    ShapesSolution next = fit_shapes(all, weights, model, fit_iterations);
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

ShapesTrial with_one_more(Responses all, const ShapesTrial& before, ShapesForm form,
                          std::size_t directions) {
  ShapesModel known = before.solution.model;
  known.directions = directions;
  known.residual.resize(all.size());
  std::vector<AllWeights> weightings = {even_weights(all)};
  if (!known.terms.empty()) {
    weightings.push_back(weights_of(all, before));
  }
  ShapesTrial best;
  for (const AllWeights& weights : weightings) {
    const std::vector<ShapesModel> starts =
        starts_with_one_more(all, weights, known, form);
    ShapesTrial trial = settle(all, scouted(all, weights, starts), weights, roughly);
    const bool first = best.solution.model.terms.empty();
    if (first || std::pair{!plausible(all, trial.solution.model), trial.criterion} <
                     std::pair{!plausible(all, best.solution.model), best.criterion}) {
      best = std::move(trial);
    }
  }
  return best;
}

}  // namespace trochoid::structure
