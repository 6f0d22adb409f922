#include <trochoid/force/statistics.h>

#include <algorithm>
#include <cmath>

namespace trochoid::force {

ForceStatistics force_statistics(std::span<const Loads> loads) {
  ForceStatistics s{.min = loads.front().force, .max = loads.front().force};
  const double n = static_cast<double>(loads.size());
  for (const Loads& load : loads) {
    const Vector3& F = load.force;
    for (std::size_t q = 0; q < 3; ++q) {
      s.mean[q] += F[q] / n;
      s.rms[q] += F[q] * F[q] / n;
      s.min[q] = std::min(s.min[q], F[q]);
      s.max[q] = std::max(s.max[q], F[q]);
    }
    s.peak_xy = std::max(s.peak_xy, std::hypot(F[0], F[1]));
  }
  for (double& value : s.rms) {
    value = std::sqrt(value);
  }
  return s;
}

MomentStatistics moment_statistics(std::span<const Loads> loads) {
  MomentStatistics s;
  for (const Loads& load : loads) {
    s.mean_torque += load.torque / static_cast<double>(loads.size());
    s.peak_torque = std::max(s.peak_torque, load.torque);
    s.peak_bending = std::max(s.peak_bending, load.bending);
  }
  return s;
}

}  // namespace trochoid::force
