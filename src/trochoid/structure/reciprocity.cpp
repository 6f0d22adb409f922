#include <trochoid/structure/reciprocity.h>

#include <trochoid/numerics/least_squares.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

/// Transposed responses that correlate less than this are hardly one and the same.
constexpr double opposite = -0.5;

/// H of one response at a frequency between the lines of another.
Complex interpolated(const FrequencyResponse& lines, double omega) {
  const auto above = std::upper_bound(lines.omega.begin(), lines.omega.end(), omega);
  const auto i = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(above - lines.omega.begin() - 1, 0,
                                 static_cast<std::ptrdiff_t>(lines.omega.size()) - 2));
  const double t = (omega - lines.omega[i]) / (lines.omega[i + 1] - lines.omega[i]);
  const auto receptance = [&](std::size_t k) {
    return lines.H[k] / factor(lines.kind, lines.omega[k]);
  };
  return (1 - t) * receptance(i) + t * receptance(i + 1);
}

/// Correlation of two responses over the band of both, -1 to 1.
double correlation(const FrequencyResponse& a, const FrequencyResponse& b) {
  double ab = 0.0;
  double aa = 0.0;
  double bb = 0.0;
  for (std::size_t i = 0; i < a.omega.size(); ++i) {
    const double omega = a.omega[i];
    if (omega >= b.omega.front() && omega <= b.omega.back()) {
      // As accelerance: what an accelerometer adds below the modes counts for little.
      const double weight = std::pow(omega, 4);
      const Complex A = a.H[i] / factor(a.kind, omega);
      const Complex B = interpolated(b, omega);
      ab += weight * (std::conj(A) * B).real();
      aa += weight * std::norm(A);
      bb += weight * std::norm(B);
    }
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0.0;
}

/// By which factor of the modes M, beside residual terms of its own, a response is
/// fitted best (M-34).
Known gain_of(const DirectedResponse& one, const LineWeights& weights,
              std::span<const Complex> M, bool residual_terms) {
  const std::size_t n = residual_terms ? 3 : 1;
  std::vector<double> A;
  std::vector<double> b;
  for (std::size_t i = 0; i < M.size(); ++i) {
    const Complex s = laplace(one, one.response.omega[i]);
    const Complex f = factor(one.response.kind, one.response.omega[i]);
    const std::array<Complex, 3> row = {M[i], f, f / (s * s)};
    for (std::size_t k = 0; k < n; ++k) {
      A.push_back((row[k] * weights.turn[i]).real() * weights.along[i]);
    }
    b.push_back((one.response.H[i] * weights.turn[i]).real() * weights.along[i]);
    for (std::size_t k = 0; k < n; ++k) {
      A.push_back((row[k] * weights.turn[i]).imag() * weights.across[i]);
    }
    b.push_back((one.response.H[i] * weights.turn[i]).imag() * weights.across[i]);
  }
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, 1e-12);
  return {fit.x.front(),
          fit.inverse_gram.empty() ? 0.0 : std::sqrt(fit.inverse_gram.front())};
}

template <class Visit>
void each_transposed(Responses all, const Visit& visit) {
  for (std::size_t a = 0; a < all.size(); ++a) {
    for (std::size_t b = a + 1; b < all.size(); ++b) {
      if (!all[a].direct() && all[a].motion == all[b].force &&
          all[a].force == all[b].motion) {
        visit(a, b);
      }
    }
  }
}

}  // namespace

std::vector<Reciprocity> reciprocity_of(Responses all, const ModesTrial& trial) {
  const AllWeights weights = weights_of(all, trial);
  ModesModel modes = trial.solution.model;
  modes.residual_terms = false;
  const auto gain = [&](std::size_t q) {
    return gain_of(all[q], weights[q], modelled(modes, all[q], q),
                   trial.solution.model.residual_terms);
  };
  std::vector<Reciprocity> out;
  each_transposed(all, [&](std::size_t a, std::size_t b) {
    const Known one = gain(a);
    const Known other = gain(b);
    out.push_back({.one = a,
                   .other = b,
                   .gain = {other.value / one.value, std::hypot(one.se, other.se)}});
  });
  return out;
}

std::string opposite_signs(Responses all) {
  std::string found;
  each_transposed(all, [&](std::size_t a, std::size_t b) {
    if (found.empty() && correlation(all[a].response, all[b].response) < opposite) {
      found = fmt::format(
          "the responses {} and {} have opposite signs, and reciprocity makes them one: in "
          "one of them the sensor or the hammer pointed the other way. Change the sign of "
          "that one",
          all[a].name, all[b].name);
    }
  });
  return found;
}

}  // namespace trochoid::structure
