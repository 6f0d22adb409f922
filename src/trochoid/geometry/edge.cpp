#include <trochoid/geometry/edge.h>

#include <cmath>

namespace trochoid::geometry {

namespace {

/// atan2(y, x) with the few terms that suffice where the angle is small, as it is
/// everywhere but at a tip.
double angle_of(double x, double y) noexcept {
  if (std::abs(y) > 0.03 * x) {
    return std::atan2(y, x);
  }
  const double t = y / x;
  const double u = t * t;
  return t * (1 - u * (1.0 / 3 - u * (1.0 / 5 - u * (1.0 / 7 - u / 9))));
}

}  // namespace

Lag lag_at(const Cutter& cutter, const Meridian& m, double s) noexcept {
  return lag_at(cutter, m, s, point_at(m, s));
}

Lag lag_at(const Cutter& cutter, const Meridian& m, double s,
           const MeridianPoint& p) noexcept {
  return lag_at({std::tan(cutter.helix), cutter.lag_law, cutter.lag_diameter}, m, s, p);
}

Lag lag_at(const LagOf& tooth, const Meridian& m, double s,
           const MeridianPoint& p) noexcept {
  const double t = tooth.tan_helix;
  const double lead = 2 * t / tooth.diameter;
  if (tooth.law == LagLaw::constant_lead || s < m.s_N) {
    return {lead * p.z, lead * p.sin_kappa};  // G-7
  }
  // G-8. ln(r/N_r)/sin(beta) as log1p, whose limit at beta = 0 is (s - s_N)/N_r.
  const double x = (s - m.s_N) / m.N.r;
  const double sb = std::sin(m.profile.beta);
  const double turn = std::abs(sb) < 1e-12 ? x : std::log1p(x * sb) / sb;
  return {lead * m.N.z + t * turn, t / p.r};
}

double edge_length_factor(const MeridianPoint& point, const Lag& lag) noexcept {
  return std::hypot(1.0, point.r * lag.per_arc);  // G-6
}

EdgePosition edge_position(const Runout& runout, double r, double c) noexcept {
  const double rho = runout.eccentricity;
  if (rho == 0.0) {
    return {r, 0.0};
  }
  const double x = r + rho * std::cos(c);
  if (runout.order == EccentricityOrder::first) {
    return {x, 0.0};  // G-10
  }
  const double y = rho * std::sin(c);
  return {std::sqrt(x * x + y * y), angle_of(x, y)};  // G-9
}

void edge_positions(const Runout& runout, std::span<const double> psi, double r,
                    double lag, std::span<EdgePosition> out) noexcept {
  for (std::size_t k = 0; k < psi.size(); ++k) {
    const double offset =
        runout.radial_offsets.empty() ? 0.0 : runout.radial_offsets[k];
    const double rk = r + offset;
    // A tooth whose own radius is not positive leaves no mark, wherever rho puts it.
    out[k] = rk > 0 ? edge_position(runout, rk, psi[k] + lag - runout.angle)
                    : EdgePosition{rk, 0.0};
  }
}

}  // namespace trochoid::geometry
