#include "over_turns.h"

#include <trochoid/base/units.h>

#include <cmath>
#include <numeric>
#include <unordered_map>

namespace trochoid::force {

DifferentAngles different_angles(std::span<const double> phi) {
  constexpr double same = 1e-11;  // angles closer than this are one angle [rad]
  DifferentAngles out;
  out.place.reserve(phi.size());
  const auto [lo, hi] = std::ranges::minmax_element(phi);
  if (phi.empty() || *hi - *lo < unit::turn) {
    out.phi.assign(phi.begin(), phi.end());
    out.place.resize(phi.size());
    std::iota(out.place.begin(), out.place.end(), std::size_t{0});
    return out;
  }
  std::unordered_map<long long, std::size_t> seen;
  for (const double angle : phi) {
    const double u = angle - unit::turn * std::floor(angle / unit::turn);
    const auto [at, is_new] = seen.try_emplace(std::llround(u / same), out.phi.size());
    if (is_new) {
      out.phi.push_back(u);
    }
    out.place.push_back(at->second);
  }
  return out;
}

}  // namespace trochoid::force
