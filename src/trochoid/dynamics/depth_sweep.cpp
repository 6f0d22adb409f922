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
  int& steps = steps_[factor];
  const auto found = [&](PeriodMap& map) {
    const Multiplier mu = multiplier_of(map, factor, tolerance, steps);
    steps = mu.steps;
    return mu;
  };
  if (cuts_.model.proportional()) {
    auto known = maps_.find(factor);
    if (known == maps_.end()) {
      PeriodMap map(cuts_.model.at_depth(1.0), system_, Omega_, {.factor = factor});
      known = maps_.emplace(factor, std::move(map)).first;
    }
    known->second.scale_forces(depth);
    return found(known->second);
  }
  const auto known = std::find(cuts_.depth.begin(), cuts_.depth.end(), depth);
  const auto k = static_cast<std::size_t>(known - cuts_.depth.begin());
  const bool at_hand = k < cuts_.at_depth.size();
  PeriodMap map(at_hand ? cuts_.at_depth[k] : cuts_.model.at_depth(depth), system_,
                Omega_, {.factor = factor});
  return found(map);
}

Multiplier DepthSweep::checked(double depth, double tolerance) {
  return settled([&](double factor) { return at(depth, factor, 0.1 * tolerance); },
                 tolerance);
}

}  // namespace trochoid::dynamics
