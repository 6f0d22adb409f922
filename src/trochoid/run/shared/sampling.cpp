#include <trochoid/run/shared/sampling.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

std::vector<double> sampled_angles(const inputs::Sampling& sampling) {
  if (!sampling.angles.empty()) {
    return sampling.angles;
  }
  const auto count = static_cast<std::size_t>(
      std::max(1L, std::lround(sampling.samples_per_rev * sampling.revolutions)));
  std::vector<double> phi(count);
  for (std::size_t i = 0; i < count; ++i) {
    phi[i] = sampling.start +
             static_cast<double>(i) * (360.0 / sampling.samples_per_rev) * unit::deg;
  }
  return phi;
}

}  // namespace trochoid::run
