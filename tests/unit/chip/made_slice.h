#pragma once

#include <trochoid/base/units.h>
#include <trochoid/chip/chip.h>
#include <trochoid/geometry/edge.h>

#include <numbers>
#include <random>
#include <vector>

namespace trochoid::chip {

inline constexpr double pi = std::numbers::pi;

/// from, from + step, ... below to.
inline std::vector<double> steps(double from, double to, double step) {
  std::vector<double> out;
  for (int i = 0; from + i * step < to; ++i) out.push_back(from + i * step);
  return out;
}

/// Teeth of a cylinder at its tip, in a cut.
struct MadeSlice {
  geometry::Cutter cutter;
  geometry::Cut cut;
  ChipModel model;
  std::vector<geometry::EdgePosition> teeth;

  [[nodiscard]] Passage passage() const { return chip::passage(cutter, cut, model); }
  [[nodiscard]] Slice slice() const { return {cutter.profile.D / 2, teeth}; }
  [[nodiscard]] double h(int tooth, double theta) const {
    return chip_at(passage(), slice(), tooth, theta).h;
  }
};

inline MadeSlice made_slice(double D, int teeth, double f_z,
                            const geometry::Runout& runout = {}) {
  MadeSlice out;
  out.cutter.profile = geometry::cylinder(D);
  out.cutter.pitch = geometry::equal_pitch(teeth);
  out.cutter.lag_diameter = D;
  out.cut = {.engagement = geometry::Slot{}, .a_p = 1e-3, .f_z = f_z, .Omega = 100};
  out.teeth.resize(out.cutter.pitch.size());
  geometry::edge_positions(runout, geometry::tooth_angles(out.cutter), D / 2, 0.0,
                           out.teeth);
  return out;
}

/// The example of section 2.2 of the paper: tooth 1 stands out by 10 um.
inline MadeSlice paper_slice(Lookback lookback) {
  MadeSlice out = made_slice(10e-3, 2, 50e-6, {.radial_offsets = {10 * unit::um, 0.0}});
  out.model.lookback = lookback;
  return out;
}

/// Uneven pitches, offsets of up to twice the feed and eccentricity.
inline MadeSlice random_slice(std::mt19937& random, double f_z) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  const int teeth = std::uniform_int_distribution<int>(1, 6)(random);
  MadeSlice out = made_slice(between(3e-3, 30e-3), teeth, f_z);
  double sum = 0.0;
  for (double& p : out.cutter.pitch) sum += p = between(0.6, 1.4);
  for (double& p : out.cutter.pitch) p *= 2 * pi / sum;
  geometry::Runout runout{.eccentricity = between(0, 2 * f_z), .angle = between(0, 6)};
  for (int k = 0; k < teeth; ++k) {
    runout.radial_offsets.push_back(between(-2 * f_z, 2 * f_z));
  }
  geometry::edge_positions(runout, geometry::tooth_angles(out.cutter),
                           out.cutter.profile.D / 2, 0.0, out.teeth);
  return out;
}

}  // namespace trochoid::chip
