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

}  // namespace

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

}  // namespace trochoid::identification
