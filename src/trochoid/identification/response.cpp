#include <trochoid/identification/response.h>

#include <algorithm>

namespace trochoid::identification {

namespace {

using Amplitudes = std::array<std::complex<double>, 3>;

Amplitudes times(const Response::Matrix& H, const Amplitudes& F) noexcept {
  Amplitudes out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) out[i] += H[3 * i + j] * F[j];
  }
  return out;
}

/// The response in the axes of the tool: Q^-1 H Q, channels = Q force.
Response::Matrix on_tool(const signal::Transmission::Matrix& H,
                         const signal::Matrix3& Q, const signal::Matrix3& inverse) {
  Response::Matrix out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 9; ++k) {
        out[3 * i + j] += inverse[i][k / 3] * H[k] * Q[k % 3][j];
      }
    }
  }
  return out;
}

/// Q^-1, from the forces that unit readings stand for.
signal::Matrix3 inverse_of(const signal::Matrix3& Q) {
  signal::Matrix3 out{};
  for (std::size_t c = 0; c < 3; ++c) {
    std::array<std::vector<double>, 3> unit_reading{{{0.0}, {0.0}, {0.0}}};
    unit_reading[c] = {1.0};
    const auto force = signal::force_on_tool(unit_reading, Q);
    for (std::size_t q = 0; force && q < 3; ++q) out[q][c] = force->front()[q];
  }
  return out;
}

}  // namespace

std::complex<double> oscillation(double omega, const Resonance& resonance) {
  const double x = omega / resonance.omega;
  return 1.0 / std::complex<double>(1.0 - x * x, 2.0 * resonance.zeta * x);  // I-17
}

Response response_of(const Resonances& resonances, double Omega, int highest) {
  const Response::Matrix rigid{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
  return with_resonances({std::vector(static_cast<std::size_t>(highest + 1), rigid)},
                         resonances, Omega);
}

Response with_resonances(Response response, const Resonances& resonances,
                         double Omega) {
  for (std::size_t k = 0; k < response.harmonic.size(); ++k) {
    const double omega = static_cast<double>(k) * Omega;
    for (std::size_t q = 0; q < 3; ++q) {
      if (!resonances[q]) continue;
      const std::complex<double> H = oscillation(omega, *resonances[q]);
      for (std::size_t j = 0; j < 3; ++j) response.harmonic[k][3 * q + j] *= H;
    }
  }
  return response;
}

Response slope_of_resonance(Response response, const Resonances& resonances,
                            double Omega, std::size_t axis, ResonanceUnknown unknown) {
  const Resonance& one = *resonances[axis];
  for (std::size_t k = 0; k < response.harmonic.size(); ++k) {
    const double x = static_cast<double>(k) * Omega / one.omega;
    const std::complex<double> H = oscillation(x * one.omega, one);
    // d(1/H)/d ln omega_n, d(1/H)/d ln zeta
    const std::complex<double> slope =
        unknown == ResonanceUnknown::ln_omega
            ? std::complex<double>(2.0 * x * x, -2.0 * one.zeta * x)
            : std::complex<double>(0.0, 2.0 * one.zeta * x);
    for (std::size_t i = 0; i < 9; ++i) {
      response.harmonic[k][i] *= i / 3 == axis ? -H * H * slope : 0.0;
    }
  }
  return response;
}

void respond(const Response& response, std::size_t columns,
             std::span<double> coefficients) {
  if (response.rigid()) return;
  const std::size_t width = 3 * columns;
  const std::size_t harmonics = (coefficients.size() / width + 1) / 2;
  for (std::size_t m = 0; m < harmonics; ++m) {
    double* const a = &coefficients[(m == 0 ? 0 : 2 * m - 1) * width];
    double* const b = m == 0 ? nullptr : a + width;
    const Response::Matrix H =
        m < response.harmonic.size() ? response.harmonic[m] : Response::Matrix{};
    for (std::size_t c = 0; c < columns; ++c) {
      Amplitudes F;
      for (std::size_t q = 0; q < 3; ++q) {
        F[q] = {a[q * columns + c], b != nullptr ? -b[q * columns + c] : 0.0};
      }
      F = times(H, F);  // I-16
      for (std::size_t q = 0; q < 3; ++q) {
        a[q * columns + c] = F[q].real();
        if (b != nullptr) b[q * columns + c] = -F[q].imag();
      }
    }
  }
}

Response response_on_tool(const signal::Transmission& transmission,
                          const signal::Matrix3& channels, double Omega, int highest) {
  const signal::Matrix3 inverse = inverse_of(channels);
  Response response;
  for (int k = 0; k <= highest; ++k) {
    response.harmonic.push_back(
        on_tool(signal::at(transmission, k * Omega), channels, inverse));
  }
  return response;
}

}  // namespace trochoid::identification
