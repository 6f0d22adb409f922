#include <trochoid/numerics/spectrum.h>

#include <stdexcept>
#include <unsupported/Eigen/FFT>

namespace trochoid::numerics {

std::vector<std::complex<double>> real_spectrum(std::span<const double> values) {
  if (values.empty() || values.size() % 2 != 0) {
    throw std::invalid_argument("real_spectrum: the number of values must be even");
  }
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  const std::vector<double> in(values.begin(), values.end());
  std::vector<std::complex<double>> out;
  transform.fwd(out, in);
  return out;
}

std::size_t fast_length(std::size_t n) {
  for (std::size_t m = n - n % 2; m > 2; m -= 2) {
    std::size_t rest = m;
    for (const std::size_t p : {2U, 3U, 5U}) {
      while (rest % p == 0) rest /= p;
    }
    if (rest == 1) return m;
  }
  return 2;
}

}  // namespace trochoid::numerics
