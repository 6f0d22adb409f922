#include <trochoid/correction/spindle_speed.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::correction {

namespace {

constexpr int points = 720;      ///< of a turn
constexpr double slowest = 0.1;  ///< speed over its mean that is still believed
constexpr int bisections = 30;

/// Torque of the cut on the spindle with a motion, at equally spaced angles [N m].
std::vector<double> cutting_torque(const RigidCut& cut, const PeriodicMotion& X) {
  const Prediction all = cut.predict(X, points);
  std::vector<double> torque(points, 0.0);
  for (std::size_t j = 0; j < all.flute_force.size(); ++j) {
    for (std::size_t i = 0; i < points; ++i) {
      const double theta = all.angle[i] - cut.psi()[j];
      const auto& F = all.flute_force[j][i];
      torque[i] += cut.radius() * (F[1] * std::sin(theta) - F[0] * std::cos(theta));
    }
  }
  return torque;
}

/// of a part of a motion; false where there is no such speed.
bool try_part(const RigidCut& cut, const SpindleDrive& drive, double Omega,
              SpeedModulation& out) {
  const std::vector<double> of_cut = cutting_torque(cut, out.motion);
  out.angle.clear();
  out.speed.clear();
  out.torque_at.clear();
  out.speed_change = 0.0;
  out.torque = 0.0;
  for (std::size_t i = 0; i < points; ++i) {
    const double phi = unit::turn * static_cast<double>(i) / points;
    const MotionPoint x = motion_at(out.motion, phi);
    const double late = unit::turn * x.slope / cut.feed();
    const double now = Omega / (1 - late);
    if (!(late < 1) || now > Omega / slowest) {
      return false;
    }
    const double slope = now * now / Omega * unit::turn * x.curvature / cut.feed();
    out.angle.push_back(phi);
    out.speed.push_back(now);
    out.torque_at.push_back(drive.inertia * now * slope + of_cut[i]);
    out.speed_change = std::max(out.speed_change, std::abs(now / Omega - 1));
    out.torque = std::max(out.torque, std::abs(out.torque_at.back()));
  }
  return true;
}

}  // namespace

SpeedModulation speed_modulation(const RigidCut& cut, const PeriodicMotion& X,
                                 const SpindleDrive& drive, double Omega) {
  SpeedModulation out;
  const auto fits = [&](double part) {
    out.part = part;
    out.motion = scaled(X, part);
    return try_part(cut, drive, Omega, out);
  };
  const bool possible = fits(1.0);
  out.torque_wanted = possible ? out.torque : std::numeric_limits<double>::infinity();
  if (!possible || out.torque > drive.torque) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < bisections; ++i) {
      const double middle = (low + high) / 2;
      (fits(middle) && out.torque <= drive.torque ? low : high) = middle;
    }
    fits(low);
    out.limit = possible ? "the torque of the spindle"
                         : "the feed: the tool would have to stand still or turn back";
    if (out.torque > drive.torque) {
      out.limit = "the torque of the spindle, too small even for the cut alone";
    } else if (out.torque > 0.999 * drive.torque) {
      out.limit = "the torque of the spindle";
    }
  }
  out.peak_difference = peak_difference(cut.peaks(out.motion));
  return out;
}

}  // namespace trochoid::correction
