#pragma once

#include <trochoid/base/units.h>
#include <trochoid/dynamics/multiplier.h>

#include <numbers>

/// The one-mode benchmark of [insperger2004]: 922 Hz, two teeth, a slot.
namespace trochoid::dynamics {

inline constexpr double pi = std::numbers::pi;

inline force::Setup straight_cut(int teeth, const geometry::Engagement& engagement) {
  force::Setup setup;
  setup.cutter = {.profile = geometry::cylinder(10 * unit::mm),
                  .pitch = geometry::equal_pitch(teeth),
                  .lag_diameter = 10 * unit::mm};
  setup.cut = {.engagement = engagement,
               .a_p = 1 * unit::mm,
               .f_z = 0.05 * unit::mm,
               .Omega = 5000 * unit::rpm};
  setup.chip = {chip::Model::none, chip::Lookback::previous};
  return setup;
}

inline force::LinearEdge benchmark_law() {
  return {.K_tc = 600e6, .K_rc = 200e6};
}

inline ChipMode mode_of(double mass, double frequency_Hz, double ratio, double x,
                        double y) {
  const double omega = 2 * pi * frequency_Hz;
  return {mass, 2 * ratio * omega * mass, mass * omega * omega, x, y};
}

inline System benchmark_system() {
  return {{mode_of(0.03993, 922, 0.011, 1, 0)}};
}

/// |mu| of a cut, good to the tolerance.
inline double growth(const force::Setup& setup, const force::Law& law,
                     const System& system, double tolerance = 1e-9) {
  const DirectionalModel model(setup, law, 1e-6, 1e-11);
  return std::abs(
      multiplier(model.at_depth(setup.cut.a_p), system, setup.cut.Omega, tolerance)
          .value);
}

}  // namespace trochoid::dynamics
