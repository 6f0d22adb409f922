#include "turn_waves.h"

#include <algorithm>
#include <cmath>

namespace trochoid::force {

namespace {

/// h cos(x), h sin(x) and h, weighted, from the harmonic k of h with factors a and b:
/// cos(x) cos(k x) = (cos((k + 1) x) + cos((k - 1) x))/2, and so on.
void add_harmonic(const TurnWeights& w, std::size_t k, double a, double b,
                  WaveRow g) noexcept {
  const double half_a = 0.5 * a;
  const double half_b = 0.5 * b;
  const Triple even = mixed(w.h_cos, half_a, w.h_sin, half_b);
  const Triple odd = mixed(w.h_cos, half_b, w.h_sin, -half_a);
  g[2 * k - 1] = plus(g[2 * k - 1], w.h_one, a);
  g[2 * k] = plus(g[2 * k], w.h_one, b);
  g[2 * k + 1] = plus(g[2 * k + 1], mixed(w.h_cos, half_a, w.h_sin, -half_b), 1.0);
  g[2 * k + 2] = plus(g[2 * k + 2], mixed(w.h_cos, half_b, w.h_sin, half_a), 1.0);
  if (k == 1) {
    g[0] = plus(g[0], even, 1.0);
  } else {
    g[2 * k - 3] = plus(g[2 * k - 3], even, 1.0);
    g[2 * k - 2] = plus(g[2 * k - 2], odd, 1.0);
  }
}

}  // namespace

Turned::Turned(double angle, int highest) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  cosine[0] = 1.0;
  sine[0] = 0.0;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(highest); ++k) {
    cosine[k] = cosine[k - 1] * c - sine[k - 1] * s;
    sine[k] = sine[k - 1] * c + cosine[k - 1] * s;
  }
}

void integrand(const numerics::TrigPolynomial* h, const TurnWeights& weights,
               double edge_factor, WaveRow g) noexcept {
  std::fill(g.begin(), g.end(), Triple{});
  g[0] = scaled(weights.e_one, edge_factor);
  g[1] = scaled(weights.e_cos, edge_factor);
  g[2] = scaled(weights.e_sin, edge_factor);
  if (h == nullptr) {
    return;
  }
  g[0] = plus(g[0], weights.h_one, h->a[0]);
  g[1] = plus(g[1], weights.h_cos, h->a[0]);
  g[2] = plus(g[2], weights.h_sin, h->a[0]);
  for (std::size_t k = 1; k <= static_cast<std::size_t>(h->highest); ++k) {
    add_harmonic(weights, k, h->a[k], h->b[k], g);
  }
}

void integrate(ConstWaveRow g, double factor, WaveRow G) noexcept {
  G[0] = scaled(g[0], factor);
  for (std::size_t i = 1; i + 1 < g.size(); i += 2) {
    const std::size_t k = (i + 1) / 2;
    const double f = factor / static_cast<double>(k);
    G[i] = scaled(g[i + 1], -f);  // F-10
    G[i + 1] = scaled(g[i], f);
  }
}

void shift_back(ConstWaveRow p, const Turned& by, double factor, WaveRow out) noexcept {
  out[0] = scaled(p[0], factor);
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    const double c = factor * by.cosine[(i + 1) / 2];
    const double s = factor * by.sine[(i + 1) / 2];
    out[i] = mixed(p[i], c, p[i + 1], -s);
    out[i + 1] = mixed(p[i + 1], c, p[i], s);
  }
}

void add(ConstWaveRow p, double factor, WaveRow sum) noexcept {
  for (std::size_t i = 0; i < p.size(); ++i) {
    Triple next;  // read before anything is written, this becomes whole vectors
    for (std::size_t q = 0; q < next.size(); ++q) {
      next[q] = sum[i][q] + factor * p[i][q];
    }
    sum[i] = next;
  }
}

Triple waves_at(ConstWaveRow p, const Turned& x) noexcept {
  Triple out{};
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    out = plus(out, p[i], x.cosine[(i + 1) / 2]);
    out = plus(out, p[i + 1], x.sine[(i + 1) / 2]);
  }
  return out;
}

Triple wave_slope_at(ConstWaveRow p, const Turned& x) noexcept {
  Triple out{};
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    const std::size_t k = (i + 1) / 2;
    out = plus(out, p[i], -static_cast<double>(k) * x.sine[k]);
    out = plus(out, p[i + 1], static_cast<double>(k) * x.cosine[k]);
  }
  return out;
}

}  // namespace trochoid::force
