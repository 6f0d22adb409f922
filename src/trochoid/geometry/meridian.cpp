#include <trochoid/geometry/meridian.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace trochoid::geometry {

namespace {

/// Distances below this part of D are rounding.
constexpr double relative_slack = 1e-9;

MeridianPoint on_cone(const Profile& p, double r) {
  return {r, r * std::tan(p.alpha), std::sin(p.alpha), std::cos(p.alpha)};
}

MeridianPoint on_flank(const Profile& p, double r, double z) {
  return {r, z, std::cos(p.beta), std::sin(p.beta)};
}

double checked_root(double square, double D) {
  if (square < -relative_slack * D * D) {
    throw std::invalid_argument("the corner arc meets neither the cone nor the flank");
  }
  return std::sqrt(std::max(square, 0.0));
}

}  // namespace

Meridian meridian(const Profile& p) {
  const double ta = std::tan(p.alpha);
  const double tb = std::tan(p.beta);
  const double u = p.D / 2 * (1 - ta * tb);
  Meridian m{.profile = p};
  if (p.R == 0.0) {  // cone and flank meet at r = D/2
    m.M = on_cone(p, p.D / 2);
    m.N = on_flank(p, p.D / 2, p.D / 2 * ta);
  } else {  // G-5
    const double R2 = p.R * p.R;
    const double Mr = (p.Rz * ta + p.Rr +
                       checked_root((R2 - p.Rr * p.Rr) * ta * ta +
                                        2 * p.Rr * p.Rz * ta + R2 - p.Rz * p.Rz,
                                    p.D)) /
                      (1 + ta * ta);
    const double c = p.Rr - u;
    const double Nz =
        (c * tb + p.Rz -
         checked_root((R2 - p.Rz * p.Rz) * tb * tb + 2 * p.Rz * c * tb - c * c + R2,
                      p.D)) /
        (1 + tb * tb);
    m.M = on_cone(p, Mr);
    m.N = on_flank(p, u + Nz * tb, Nz);
    m.chi_M = std::atan2(m.M.r - p.Rr, p.Rz - m.M.z);
  }
  const double chi_N =
      p.R == 0.0 ? 0.0 : std::atan2(m.N.r - p.Rr, p.Rz - m.N.z) - m.chi_M;
  const double slack = relative_slack * p.D;
  if (m.M.r < -slack || m.N.r < -slack || m.N.z < m.M.z - slack ||
      chi_N < -relative_slack) {
    throw std::invalid_argument("cone, corner and flank do not meet in this order");
  }
  m.s_M = p.alpha > 0 ? std::max(m.M.r, 0.0) / std::cos(p.alpha) : 0.0;
  m.s_N = m.s_M + p.R * std::max(chi_N, 0.0);
  return m;
}

MeridianPoint point_at(const Meridian& m, double s) noexcept {
  const Profile& p = m.profile;
  if (s < m.s_M) {  // G-2
    const double c = std::cos(p.alpha);
    const double sn = std::sin(p.alpha);
    return {s * c, s * sn, sn, c};
  }
  if (s < m.s_N) {  // G-3
    const double chi = m.chi_M + (s - m.s_M) / p.R;
    const double sn = std::sin(chi);
    const double half = std::sin(chi / 2);
    // 1 - cos(chi) by its half angle: at a ball tip z would lose all digits otherwise.
    const double z = p.Rz - p.R + 2 * p.R * half * half;
    return {p.Rr + p.R * sn, z, sn, std::cos(chi)};
  }
  const double c = std::cos(p.beta);  // G-4
  const double sn = std::sin(p.beta);
  return {m.N.r + (s - m.s_N) * sn, m.N.z + (s - m.s_N) * c, c, sn};
}

double arc_length_at(const Meridian& m, double z) noexcept {
  const Profile& p = m.profile;
  if (z < m.M.z && p.alpha > 0) {
    return std::max(z, 0.0) / std::sin(p.alpha);
  }
  if (z < m.N.z && p.R > 0) {
    const double c = std::clamp((p.Rz - z) / p.R, -1.0, 1.0);
    return m.s_M + std::max(0.0, p.R * (std::acos(c) - m.chi_M));
  }
  return m.s_N + std::max(0.0, z - m.N.z) / std::cos(p.beta);
}

}  // namespace trochoid::geometry
