// Responses in x and y of a structure with known modes, with noise.
#pragma once

#include "made_response.h"

#include <trochoid/structure/identify_modes.h>

#include <array>
#include <complex>
#include <string>
#include <vector>

namespace made {

/// A mode along a direction in the plane of x and y.
struct TiltedMode {
  double frequency = 0.0;  // [Hz]
  double zeta = 0.0;
  double mass = 0.0;   // [kg]
  double angle = 0.0;  // [deg]
};

/// Mass, damping and stiffness of x and y: two modes at right angles, and a damper
/// between x and y that does not care for them.
struct Plane {
  std::array<TiltedMode, 2> modes{};
  double damper = 0.0;  // along x + y [N s/m]

  // Receptances xx, xy, yy by inverting the dynamic stiffness.
  [[nodiscard]] std::array<std::complex<double>, 3> receptance(double omega) const {
    std::complex<double> xx = 0.0, xy = 0.0, yy = 0.0;  // dynamic stiffness
    for (const TiltedMode& m : modes) {
      const double w = m.frequency * Hz;
      const std::complex<double> k =
          m.mass * std::complex<double>(w * w - omega * omega, 2 * m.zeta * w * omega);
      const double c = std::cos(m.angle / 180 * std::numbers::pi);
      const double s = std::sin(m.angle / 180 * std::numbers::pi);
      xx += k * c * c;
      xy += k * c * s;
      yy += k * s * s;
    }
    const std::complex<double> d(0.0, 0.5 * damper * omega);
    xx += d;
    xy += d;
    yy += d;
    const auto det = xx * yy - xy * xy;
    return {yy / det, -xy / det, xx / det};
  }
};

/// How responses are measured.
struct Measuring {
  Band band{600, 1600, 2.5};
  trochoid::structure::ResponseKind kind =
      trochoid::structure::ResponseKind::receptance;
  Noise noise{.fraction = 0.02};
  unsigned seed = 1;
};

/// One response of a plane: `name` is motion, then force, like "xy".
inline trochoid::structure::DirectedResponse measured(const Plane& plane,
                                                      const std::string& name,
                                                      const Measuring& how) {
  trochoid::structure::DirectedResponse out{
      .motion = name[0] == 'x' ? 0U : 1U,
      .force = name[1] == 'x' ? 0U : 1U,
      .response = response({}, how.kind, how.band),
      .name = name};
  std::mt19937 random(how.seed * 7919 + static_cast<unsigned>(name[0]) * 31 +
                      static_cast<unsigned>(name[1]));
  std::normal_distribution<double> normal;
  double largest = 0.0;
  for (std::size_t i = 0; i < out.response.omega.size(); ++i) {
    const double w = out.response.omega[i];
    out.response.H[i] =
        plane.receptance(w)[out.motion + out.force] * factor(how.kind, w);
    largest = std::max(largest, std::abs(out.response.H[i]));
  }
  for (auto& H : out.response.H) {
    const auto both = [&] {
      const double re = normal(random);
      return std::complex<double>(re, normal(random));
    };
    H = H * (1.0 + how.noise.fraction * both() + how.noise.magnitude * normal(random)) +
        how.noise.floor * largest * both();
  }
  return out;
}

inline std::vector<trochoid::structure::DirectedResponse> all_of(
    const Plane& plane, const std::vector<std::string>& names,
    const Measuring& how = {}) {
  std::vector<trochoid::structure::DirectedResponse> out;
  for (const std::string& name : names) {
    out.push_back(measured(plane, name, how));
  }
  return out;
}

}  // namespace made
