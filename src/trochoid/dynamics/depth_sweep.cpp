#include <trochoid/dynamics/depth_sweep.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>

namespace trochoid::dynamics {

Cuts cuts_at(const DirectionalModel& model, std::span<const double> depth) {
  Cuts cuts{model, {depth.begin(), depth.end()}, {}};
  if (!model.proportional()) {
    cuts.at_depth.resize(depth.size());
    numerics::for_each_index(depth.size(), [&](std::size_t k) {
      cuts.at_depth[k] = model.at_depth(depth[k]);
    });
  }
  return cuts;
}

Multiplier DepthSweep::at(double depth, double factor, double tolerance) {
  if (cuts_.model.proportional()) {
    auto found = maps_.find(factor);
    if (found == maps_.end()) {
      PeriodMap map(cuts_.model.at_depth(1.0), system_, Omega_, {.factor = factor});
      found = maps_.emplace(factor, std::move(map)).first;
    }
    found->second.scale_forces(depth);
    return multiplier_of(found->second, factor, tolerance);
  }
  const auto known = std::find(cuts_.depth.begin(), cuts_.depth.end(), depth);
  const auto k = static_cast<std::size_t>(known - cuts_.depth.begin());
  return k < cuts_.at_depth.size()
             ? multiplier_with(cuts_.at_depth[k], system_, Omega_, factor, tolerance)
             : multiplier_with(cuts_.model.at_depth(depth), system_, Omega_, factor,
                               tolerance);
}

Multiplier DepthSweep::checked(double depth, double tolerance) {
  return settled([&](double factor) { return at(depth, factor, 0.1 * tolerance); },
                 tolerance);
}

}  // namespace trochoid::dynamics
