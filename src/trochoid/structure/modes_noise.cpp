#include <trochoid/numerics/least_squares.h>
#include <trochoid/structure/modes_noise.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

/// Below this fraction of the largest |H| nothing is noise, but least_noise.
constexpr double least_noise = 1e-12;
/// A line with more leverage says nothing of the noise.
constexpr double most_leverage = 0.9;
constexpr int most_scorings = 200;
constexpr double settled = 1e-11;
constexpr double infinity = std::numeric_limits<double>::infinity();

/// Squared residuals along and across the model, with what their variances are made of.
struct Squares {
  std::vector<double> along, across;  ///< r^2/(1 - h), over the largest |H|^2
  std::vector<double> along_raw, across_raw;
  std::vector<double> power;  ///< |H|^2 of the model, over its largest
  double scale = 1.0;         ///< largest |H|^2
};

/// A unit vector along H, conjugate; 1 where H is zero.
Complex turn_of(Complex H) {
  const double size = std::abs(H);
  return size > 0 ? std::conj(H) / size : Complex(1.0);
}

Squares squares_of(const FrequencyResponse& lines, std::span<const Complex> left,
                   std::span<const double> leverage) {
  Squares s;
  double largest = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Complex H = lines.H[i] - left[i];
    s.power.push_back(std::norm(H));
    largest = std::max(largest, std::norm(lines.H[i]));
  }
  s.scale = largest > 0 ? largest : 1.0;
  const auto kept = [&](std::size_t row) {
    return leverage.empty() ? 1.0 : 1 - std::min(leverage[row], most_leverage);
  };
  for (std::size_t i = 0; i < left.size(); ++i) {
    const Complex turned = left[i] * turn_of(lines.H[i] - left[i]);
    s.power[i] /= s.scale;
    const double calmer = lines.calmer(i);  // all in the noise of one line
    const double scale = s.scale / (calmer * calmer);
    s.along_raw.push_back(turned.real() * turned.real() / scale);
    s.across_raw.push_back(turned.imag() * turned.imag() / scale);
    s.along.push_back(s.along_raw.back() / kept(2 * i));
    s.across.push_back(s.across_raw.back() / kept(2 * i + 1));
  }
  return s;
}

/// Variances a^2, b^2, c^2 in the scale of the squares.
using Variances = std::array<double, 3>;

double variance(const Variances& v, double power, std::size_t part) {
  return std::max(v[0] + v[1 + part] * power, least_noise * least_noise);
}

/// The normal equations of r^2 over a^2, b^2, c^2 with the weights 1/variance^2.
struct Normal {
  std::array<double, 9> G{};
  std::array<double, 3> g{};
};

Normal normal_of(const Squares& s, const Variances& v, bool alike) {
  Normal n;
  for (std::size_t i = 0; i < s.power.size(); ++i) {
    for (std::size_t part = 0; part < 2; ++part) {
      const std::size_t own = alike ? 1 : 1 + part;
      const double r2 = part == 0 ? s.along[i] : s.across[i];
      const double sigma2 = variance(v, s.power[i], part);
      const double w = 1 / (sigma2 * sigma2);
      n.G[0] += w;
      n.G[own] += w * s.power[i];
      n.G[3 * own] += w * s.power[i];
      n.G[4 * own] += w * s.power[i] * s.power[i];
      n.g[0] += w * r2;
      n.g[own] += w * r2 * s.power[i];
    }
  }
  return n;
}

/// The best non-negative solution: of the few that leave some variances at zero.
Variances solved(const Normal& n, bool alike) {
  const unsigned all = alike ? 3 : 7;
  Variances best{};
  double gain = -infinity;
  for (unsigned chosen = 1; chosen <= all; ++chosen) {
    std::vector<std::size_t> at;
    for (std::size_t k = 0; k < 3; ++k) {
      if ((chosen >> k & 1U) != 0) at.push_back(k);
    }
    std::vector<double> G;
    std::vector<double> g;
    std::vector<double> x(at.size());
    for (const std::size_t a : at) {
      const double unit_a = std::sqrt(n.G[4 * a]);
      for (const std::size_t b : at) {
        G.push_back(n.G[3 * a + b] / (unit_a * std::sqrt(n.G[4 * b])));
      }
      g.push_back(n.g[a] / unit_a);
    }
    const double value = numerics::solve_normal(G, g, x);
    const bool sound = std::all_of(x.begin(), x.end(), [](double q) { return q >= 0; });
    if (sound && value > gain) {
      gain = value;
      best = {};
      for (std::size_t k = 0; k < at.size(); ++k) {
        best[at[k]] = x[k] / std::sqrt(n.G[4 * at[k]]);
      }
    }
  }
  return best;
}

/// Fisher scoring from a start, half a step at a time: full ones may swing.
Variances scored(const Squares& s, Variances v, bool alike) {
  for (int round = 0; round < most_scorings; ++round) {
    Variances next = solved(normal_of(s, v, alike), alike);
    if (alike) {
      next[2] = next[1];
    }
    double change = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      next[k] = 0.5 * (next[k] + v[k]);
      change = std::max(change, std::abs(next[k] - v[k]));
    }
    v = next;
    if (change <= settled * (v[0] + v[1] + v[2])) {
      break;
    }
  }
  // What half steps only come near to.
  const Variances last = solved(normal_of(s, v, alike), alike);
  for (std::size_t k = 0; k < 3; ++k) {
    v[k] = last[alike ? std::min<std::size_t>(k, 1) : k] > 0 ? v[k] : 0.0;
  }
  return v;
}

double deviance_of(const Squares& s, const Variances& v) {
  double sum = 0.0;
  for (std::size_t i = 0; i < s.power.size(); ++i) {
    for (std::size_t part = 0; part < 2; ++part) {
      const double sigma2 = variance(v, s.power[i], part);
      sum += std::log(sigma2) + (part == 0 ? s.along_raw[i] : s.across_raw[i]) / sigma2;
    }
  }
  return sum;
}

}  // namespace

NoiseEstimate estimate_noise(const FrequencyResponse& lines,
                             std::span<const Complex> left,
                             std::span<const double> leverage) {
  const Squares s = squares_of(lines, left, leverage);
  const auto n = static_cast<double>(2 * s.power.size());
  Variances even{};
  Variances part{};
  for (std::size_t i = 0; i < s.power.size(); ++i) {
    const double power = std::max(s.power[i], 1e-6);
    even[0] += (s.along[i] + s.across[i]) / n;
    part[1] += s.along[i] / power / n;
    part[2] += s.across[i] / power / n;
  }
  const double mean = part[1] + part[2];
  const Variances alike = scored(s, {even[0] / 2, mean, mean}, true);
  const Variances apart = scored(s, {even[0] / 2, part[1], part[2]}, false);
  NoiseEstimate best{.deviance = infinity};
  for (const auto& [v, parameters] :
       {std::pair{even, 1}, std::pair{alike, 2}, std::pair{apart, 3}}) {  // M-15
    const double deviance = deviance_of(s, v);
    if (deviance + parameters * std::log(n) <
        best.deviance + best.parameters * std::log(n)) {
      best = {.noise = {.floor = std::sqrt(v[0] * s.scale),
                        .magnitude = std::sqrt(v[1]),
                        .phase = std::sqrt(v[2])},
              .parameters = parameters,
              .deviance = deviance};
    }
  }
  best.noise.floor = std::max(best.noise.floor, least_noise * std::sqrt(s.scale));
  return best;
}

LineWeights weights_of(std::span<const Complex> modelled, const ResponseNoise& noise) {
  LineWeights out;
  for (const Complex& H : modelled) {
    const double size = std::abs(H);
    out.turn.push_back(turn_of(H));
    out.along.push_back(1 / std::hypot(noise.floor, noise.magnitude * size));
    out.across.push_back(1 / std::hypot(noise.floor, noise.phase * size));
  }
  return out;
}

}  // namespace trochoid::structure
