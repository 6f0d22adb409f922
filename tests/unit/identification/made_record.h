#pragma once

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>

#include <numbers>
#include <random>
#include <vector>

/// Records made by the program's own forces, whose answer is therefore known.
namespace trochoid::identification {

/// gtest has a Run of its own in the scope of every test.
using Record = Run;

inline constexpr double pi = std::numbers::pi;

inline force::Setup slot_setup(int teeth, double helix_deg, double a_p) {
  force::Setup out;
  out.cutter.profile = geometry::cylinder(8.0 * unit::mm);
  out.cutter.pitch = geometry::equal_pitch(teeth);
  out.cutter.helix = helix_deg * unit::deg;
  out.cutter.lag_diameter = 8.0 * unit::mm;
  out.cut.engagement = geometry::Slot{};
  out.cut.a_p = a_p;
  out.cut.f_z = 40.0 * unit::um;
  out.cut.Omega = 875.0 * unit::rpm;
  return out;
}

inline force::LinearEdge steel() {
  return {2600e6, 1500e6, 330e6, 7e3, 3e3, 1e3};
}

struct Sampling {
  double phase = 0.0;  ///< [rad]
  int per_turn = 360;
  double turns = 1.0;
  double noise = 0.0;  ///< [N]
  unsigned seed = 1;
};

inline Record made_record(const force::Setup& setup, const force::Law& law,
                          const Sampling& sampling) {
  Record out;
  out.cut = setup.cut;
  const auto n = static_cast<int>(sampling.turns * sampling.per_turn);
  std::vector<double> phi;
  for (int i = 0; i < n; ++i) {
    out.angle.push_back(2.0 * pi * (i + 0.5) / sampling.per_turn);
    phi.push_back(out.angle.back() + sampling.phase);
  }
  out.force = force::forces(setup, law, phi, 1e-10);
  std::mt19937 random(sampling.seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (auto& F : out.force) {
    for (double& f : F) f += sampling.noise * normal(random);
  }
  return out;
}

inline double peak(const Record& run) {
  double out = 0.0;
  for (const auto& F : run.force) {
    for (const double f : F) out = std::max(out, std::abs(f));
  }
  return out;
}

/// The same tool without what is to be found.
inline force::Setup without_runout(force::Setup setup) {
  setup.runout = {};
  return setup;
}

/// Whether a quantity is named as not identifiable.
inline bool refused(const Fit& fit, const std::string& name) {
  for (const auto& [key, reason] : fit.unidentifiable) {
    if (key == name) return !reason.empty();
  }
  return false;
}

}  // namespace trochoid::identification
