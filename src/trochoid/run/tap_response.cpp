#include <trochoid/run/tap_response.h>

#include <algorithm>
#include <complex>

namespace trochoid::run {

namespace {

/// Lines below the first of this coherence are left out where no band is given.
constexpr double least_coherence = 0.5;

}  // namespace

structure::FrequencyResponse response_of(const signal::TapResponse& tap,
                                         structure::ResponseKind kind) {
  structure::FrequencyResponse out{.kind = kind,
                                   .omega = tap.omega,
                                   .H = tap.H,
                                   .noise_bandwidth = tap.noise_bandwidth};
  for (std::size_t i = 0; i < tap.omega.size(); ++i) {
    const double omega = tap.omega[i];
    const std::complex<double> ratio =
        std::complex<double>(0, omega) / std::complex<double>(tap.decay, omega);
    const int times = static_cast<int>(kind);  // of the time derivative: 0, 1 or 2
    for (int k = 0; k < times; ++k) {
      out.H[i] *= ratio;
    }
  }
  return out;
}

double first_coherent(const signal::TapResponse& tap) {
  const auto at =
      std::find_if(tap.coherence.begin(), tap.coherence.end(),
                   [](double coherence) { return coherence >= least_coherence; });
  return at == tap.coherence.end()
             ? 0.0
             : tap.omega[static_cast<std::size_t>(at - tap.coherence.begin())];
}

}  // namespace trochoid::run
