// Responses of known modes with noise of known kinds.
#pragma once

#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <vector>

namespace made {

constexpr double Hz = 2 * std::numbers::pi;

struct Band {
  double from = 0.0;  // [Hz]
  double to = 0.0;
  double step = 0.0;
};

/// Standard deviations of real and imaginary part.
struct Noise {
  double floor = 0.0;      // of the largest |H|
  double fraction = 0.0;   // of |H|, magnitude and phase
  double magnitude = 0.0;  // of |H|, magnitude alone
};

inline trochoid::structure::Mode mode_of(double frequency, double zeta, double mass) {
  return trochoid::structure::completed(
      {.mass = mass, .frequency = frequency, .damping_ratio = zeta});
}

inline trochoid::structure::FrequencyResponse response(
    const std::vector<trochoid::structure::Mode>& modes,
    trochoid::structure::ResponseKind kind, Band band, Noise noise = {},
    unsigned seed = 7) {
  trochoid::structure::FrequencyResponse out{.kind = kind};
  double largest = 0.0;
  for (double f = band.from; f <= band.to * (1 + 1e-12); f += band.step) {
    const double w = f * Hz;
    std::complex<double> H;
    for (const auto& mode : modes) H += receptance(mode, w);
    out.omega.push_back(w);
    out.H.push_back(H * factor(kind, w));
    largest = std::max(largest, std::abs(out.H.back()));
  }
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  const auto both = [&] {
    const double re = normal(random);
    return std::complex<double>(re, normal(random));
  };
  for (auto& H : out.H) {
    H = H * (1.0 + noise.fraction * both() + noise.magnitude * normal(random)) +
        noise.floor * largest * both();
  }
  return out;
}

}  // namespace made
