#pragma once

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace trochoid::force {

inline constexpr double pi = std::numbers::pi;

/// gtest has a Setup of its own in the scope of every test.
using MadeCut = Setup;

inline LinearEdge steel() {
  return {2600e6, 1500e6, 330e6, 7e3, 3e3, 1e3};
}

inline Power aluminium() {
  return {900e6, 400e6, 150e6, 0.25, 0.4, 0.1};
}

inline PowerEdge both() {
  return {900e6, 400e6, 150e6, 0.25, 0.4, 0.1, 7e3, 3e3, 1e3};
}

inline Setup slot(const geometry::Profile& profile, int teeth, double helix_deg) {
  Setup out;
  out.cutter.profile = profile;
  out.cutter.pitch = geometry::equal_pitch(teeth);
  out.cutter.helix = helix_deg * unit::deg;
  out.cutter.lag_diameter = profile.D;
  out.cut = {.engagement = geometry::Slot{}, .a_p = 2e-3, .f_z = 50e-6, .Omega = 90.0};
  return out;
}

/// Angles over one turn that are no special ones.
inline std::vector<double> turn(int count) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(2 * pi * (i + 0.3217) / count);
  return out;
}

inline double peak(const std::vector<Vector3>& F) {
  double out = 0.0;
  for (const auto& f : F) out = std::max(out, std::hypot(f[0], f[1], f[2]));
  return out;
}

/// Largest difference of two courses of the force [N].
inline double difference(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      out = std::max(out, std::abs(a[i][q] - b[i][q]));
    }
  }
  return out;
}

}  // namespace trochoid::force
