#include <trochoid/geometry/cutter.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::geometry {

Profile cylinder(double D) {
  return {.D = D, .Rr = D / 2};
}

Profile ball(double D) {
  return {.D = D, .R = D / 2, .Rz = D / 2};
}

Profile bull_nose(double D, double R) {
  return {.D = D, .R = R, .Rr = D / 2 - R, .Rz = R};
}

Profile taper(double D, double beta, double R) {
  // The corner's centre lies R above the bottom and R away from the flank.
  const double Rr = D / 2 + R * std::tan(beta) - R / std::cos(beta);
  return {.D = D, .R = R, .Rr = Rr, .Rz = R, .beta = beta};
}

std::vector<double> equal_pitch(int teeth) {
  return std::vector<double>(static_cast<std::size_t>(teeth), unit::turn / teeth);
}

bool equally_pitched(std::span<const double> pitch) noexcept {
  constexpr double rounding = 1e-9;  // [rad]
  return std::all_of(pitch.begin(), pitch.end(),
                     [&](double p) { return std::abs(p - pitch.front()) < rounding; });
}

Cutter end_mill(double D, int teeth, double helix) {
  return {.profile = cylinder(D),
          .pitch = equal_pitch(teeth),
          .helix = helix,
          .lag_diameter = D};
}

std::vector<double> tooth_angles(const Cutter& cutter) {
  std::vector<double> psi(cutter.pitch.size());
  std::exclusive_scan(cutter.pitch.begin(), cutter.pitch.end(), psi.begin(), 0.0);
  return psi;
}

}  // namespace trochoid::geometry
