#include "turn_waves.h"

#include <algorithm>
#include <cmath>

namespace trochoid::force {

namespace {

constexpr std::size_t wide = std::tuple_size_v<Triple>;

/// out += p x.
void add(const Triple& p, double x, Triple& out) noexcept {
  for (std::size_t q = 0; q < wide; ++q) {
    out[q] += p[q] * x;
  }
}

/// h cos(x), h sin(x) and h, weighted, from the harmonic k of h with factors a and b:
/// cos(x) cos(k x) = (cos((k + 1) x) + cos((k - 1) x))/2, and so on.
void add_harmonic(const TurnWeights& w, std::size_t k, double a, double b,
                  WaveRow g) noexcept {
  Triple& higher_cos = g[2 * k + 1];
  Triple& higher_sin = g[2 * k + 2];
  const double half_a = 0.5 * a;
  const double half_b = 0.5 * b;
  Triple& lower_cos = k == 1 ? g[0] : g[2 * k - 3];
  for (std::size_t q = 0; q < wide; ++q) {
    higher_cos[q] += w.h_cos[q] * half_a - w.h_sin[q] * half_b;
    higher_sin[q] += w.h_cos[q] * half_b + w.h_sin[q] * half_a;
    g[2 * k - 1][q] += w.h_one[q] * a;
    g[2 * k][q] += w.h_one[q] * b;
    lower_cos[q] += w.h_cos[q] * half_a + w.h_sin[q] * half_b;
  }
  if (k > 1) {
    for (std::size_t q = 0; q < wide; ++q) {
      g[2 * k - 2][q] += w.h_cos[q] * half_b - w.h_sin[q] * half_a;
    }
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
  add(weights.e_one, edge_factor, g[0]);
  add(weights.e_cos, edge_factor, g[1]);
  add(weights.e_sin, edge_factor, g[2]);
  if (h == nullptr) {
    return;
  }
  add(weights.h_one, h->a[0], g[0]);
  add(weights.h_cos, h->a[0], g[1]);
  add(weights.h_sin, h->a[0], g[2]);
  for (std::size_t k = 1; k <= static_cast<std::size_t>(h->highest); ++k) {
    add_harmonic(weights, k, h->a[k], h->b[k], g);
  }
}

void integrate(ConstWaveRow g, double factor, WaveRow G) noexcept {
  for (std::size_t q = 0; q < wide; ++q) {
    G[0][q] = factor * g[0][q];
  }
  for (std::size_t i = 1; i + 1 < g.size(); i += 2) {
    const double f = factor / static_cast<double>((i + 1) / 2);
    for (std::size_t q = 0; q < wide; ++q) {  // F-10
      G[i][q] = -f * g[i + 1][q];
      G[i + 1][q] = f * g[i][q];
    }
  }
}

void shift_back(ConstWaveRow p, const Turned& by, double factor, WaveRow out) noexcept {
  for (std::size_t q = 0; q < wide; ++q) {
    out[0][q] = factor * p[0][q];
  }
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    const double c = factor * by.cosine[(i + 1) / 2];
    const double s = factor * by.sine[(i + 1) / 2];
    for (std::size_t q = 0; q < wide; ++q) {
      out[i][q] = c * p[i][q] - s * p[i + 1][q];
      out[i + 1][q] = c * p[i + 1][q] + s * p[i][q];
    }
  }
}

Triple waves_at(ConstWaveRow p, double x) noexcept {
  const int highest = static_cast<int>(p.size() / 2);
  const Turned turned(x, highest);
  Triple out{};
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    add(p[i], turned.cosine[(i + 1) / 2], out);
    add(p[i + 1], turned.sine[(i + 1) / 2], out);
  }
  return out;
}

Triple wave_slope_at(ConstWaveRow p, double x) noexcept {
  const int highest = static_cast<int>(p.size() / 2);
  const Turned turned(x, highest);
  Triple out{};
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    const std::size_t k = (i + 1) / 2;
    add(p[i], -static_cast<double>(k) * turned.sine[k], out);
    add(p[i + 1], static_cast<double>(k) * turned.cosine[k], out);
  }
  return out;
}

}  // namespace trochoid::force
