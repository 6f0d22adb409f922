#include <trochoid/correction/speed_map.h>

#include <array>

namespace trochoid::correction {

namespace {

/// A motion of a shape that makes the peaks of a rigid cut equal, as far as it can.
PeriodicMotion equalizing(const RigidCut& rigid, Shape shape,
                          const CorrectionOptions& options) {
  const ShapeOptions of_shape{.transition = options.transition,
                              .harmonics = options.harmonics};
  const Amplitude found = equal_flutes(Target::peak_force, rigid, shape, of_shape);
  return found.ok ? found.motion : table_motion(rigid, shape, of_shape);
}

}  // namespace

SpeedMap speed_map(const Setting& s, const Plan& plan,
                   const CorrectionOptions& options) {
  SpeedMap map;
  if (options.spindle_speeds.empty()) {
    return map;
  }
  const RigidCut rigid = designed_cut(s);
  const PeriodicMotion sine = equalizing(rigid, Shape::sine, options);
  const PeriodicMotion square = equalizing(rigid, Shape::square, options);
  map.strategies = {{"sine_plain", {sine, Method::plain}},
                    {"sine_lead", {sine, Method::lead}},
                    {"sine_inverse", {sine, Method::inverse}},
                    {"square_lead", {square, Method::lead}},
                    {"this_case", {plan.motion, options.strategy}}};
  map.Omega = options.spindle_speeds;
  const MapSetting setting{.model = s.cut.plant,
                           .real = s.cut.plant,
                           .limits = s.limits,
                           .command = command_options(options)};
  std::vector<Strategy> strategies;
  for (const NamedStrategy& named : map.strategies) {
    strategies.push_back(named.strategy);
  }
  map.points = residual_map(rigid, strategies, setting, map.Omega);
  const std::array ends = {map.Omega.front(), map.Omega.back()};
  for (const Strategy& strategy : strategies) {
    map.highest.push_back(
        residual_speed(rigid, strategy, setting, options.allowed_difference, ends));
  }
  return map;
}

}  // namespace trochoid::correction
