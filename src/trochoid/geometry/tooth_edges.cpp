#include <trochoid/geometry/tooth_edges.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::geometry {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// The profile at a height, without the arc length: at the start of a corner that loses
/// half of the digits.
MeridianPoint point_at_height(const Meridian& m, double z) noexcept {
  const Profile& p = m.profile;
  if (z < m.M.z && p.alpha > 0) {
    return {z / std::tan(p.alpha), z, std::sin(p.alpha), std::cos(p.alpha)};
  }
  if (z < m.N.z && p.R > 0) {
    const double cosine = (p.Rz - z) / p.R;
    const double sine =
        std::sqrt(std::max(0.0, (p.R - p.Rz + z) * (p.R + p.Rz - z))) / p.R;
    return {p.Rr + p.R * sine, z, sine, cosine};
  }
  const double c = std::cos(p.beta);
  const double s = std::sin(p.beta);
  return {m.N.r + (z - m.N.z) * s / c, z, c, s};
}

}  // namespace

bool edges_alike(const Cutter& cutter, const Runout& runout) noexcept {
  const bool one_helix =
      std::all_of(cutter.helices.begin(), cutter.helices.end(),
                  [&](double helix) { return helix == cutter.helix; });
  const bool smooth = !cutter.serration || cutter.serration->amplitude == 0;
  return one_helix && cutter.helix >= 0 && smooth && level(runout);
}

ToothEdges::ToothEdges(const Cutter& cutter, const Runout& runout)
    : meridian_(geometry::meridian(cutter.profile)),
      runout_(runout),
      tan_tilt_(std::tan(runout.tilt)) {
  const std::vector<double> psi = tooth_angles(cutter);
  const auto count = static_cast<double>(psi.size());
  if (cutter.serration) {
    amplitude_ = cutter.serration->amplitude;
    wavelength_ = amplitude_ > 0 ? cutter.serration->wavelength : 0.0;
  }
  for (std::size_t j = 0; j < psi.size(); ++j) {
    const double helix = cutter.helices.empty() ? cutter.helix : cutter.helices[j];
    Tooth tooth{.psi = psi[j],
                .lag = {std::tan(helix), cutter.lag_law, cutter.lag_diameter},
                .shift = static_cast<double>(j) * wavelength_ / count};
    if (cutter.serration && !cutter.serration->shift.empty()) {
      tooth.shift = cutter.serration->shift[j];
    }
    if (!runout.axial_offsets.empty()) tooth.axial = runout.axial_offsets[j];
    if (!runout.radial_offsets.empty()) tooth.radial = runout.radial_offsets[j];
    teeth_.push_back(tooth);
  }
}

ToothEdges::Own ToothEdges::own(const Tooth& tooth, double z) const noexcept {
  const MeridianPoint p = point_at_height(meridian_, z);
  const bool flank = z >= meridian_.N.z;
  // Only the law of constant helix asks for the arc length, and of the flank alone.
  const double s = flank ? arc_length_at(meridian_, z) : 0.0;
  const Lag lag = lag_at(tooth.lag, meridian_, s, p);
  const double per_height = flank && tooth.lag.law == LagLaw::constant_helix
                                ? lag.per_arc / p.sin_kappa
                                : 2 * tooth.lag.tan_helix / tooth.lag.diameter;
  Own at{.r = p.r,
         .slope = p.cos_kappa / p.sin_kappa,
         .omega = tooth.psi + lag.angle,
         .turn = per_height,
         .sin_kappa = p.sin_kappa,
         .cos_kappa = p.cos_kappa};
  if (wavelength_ > 0 && flank) {  // G-20
    const double wave = two_pi / wavelength_;
    const double x = wave * (z - tooth.shift);
    const double half = std::sin(0.5 * x);
    at.r -= amplitude_ * half * half;
    at.slope -= 0.5 * amplitude_ * wave * std::sin(x);
    at.sin_kappa = 1 / std::hypot(1.0, at.slope);
    at.cos_kappa = at.slope * at.sin_kappa;
  }
  return at;
}

double ToothEdges::lift(const Tooth& tooth, double z1) const noexcept {
  if (tan_tilt_ == 0) {
    return 0.0;
  }
  const Own at = own(tooth, z1);
  return tan_tilt_ * at.r * std::cos(at.omega - runout_.tilt_angle);
}

EdgePosition ToothEdges::placed(const Tooth& tooth, const Own& at,
                                double height) const noexcept {
  const double r = at.r + tooth.radial;
  const double rho = runout_.eccentricity;
  const double lean = height * tan_tilt_;
  if (!(r > 0) || (rho == 0 && lean == 0)) {
    return {r, 0.0};
  }
  const double c = at.omega - runout_.angle;
  const double t = at.omega - runout_.tilt_angle;
  const double x = r + rho * std::cos(c) + lean * std::cos(t);  // G-23
  if (runout_.order == EccentricityOrder::first) {
    return {x, 0.0};
  }
  const double y = rho * std::sin(c) + lean * std::sin(t);
  return {std::hypot(x, y), std::atan2(y, x)};
}

EdgeAt ToothEdges::edge_at(std::size_t index, double height,
                           double beyond) const noexcept {
  const Tooth& tooth = teeth_[index];
  const double above = (height + tooth.axial) + beyond;
  const double z1 = std::max(above, 0.0);
  const double own_height = above + lift(tooth, z1);  // G-21
  EdgeAt out;
  out.there = own_height >= 0;
  out.own_height = own_height;
  const Own at = own(tooth, std::max(own_height, 0.0));
  out.r = at.r;
  out.omega = at.omega;
  out.sin_kappa = at.sin_kappa;
  out.cos_kappa = at.cos_kappa;
  double rise = 1.0;  // dz'/dz
  if (tan_tilt_ != 0 && above > 0) {
    const Own below = own(tooth, z1);
    const double t = below.omega - runout_.tilt_angle;
    rise +=
        tan_tilt_ * (below.slope * std::cos(t) - below.r * below.turn * std::sin(t));
  }
  // G-22, with 1/sin(kappa) = sqrt(1 + slope^2)
  out.dS_dz = std::hypot(1 / at.sin_kappa, at.r * at.turn) * rise;
  out.position = placed(tooth, at, height + beyond);
  return out;
}

double ToothEdges::height_of(const Tooth& tooth, double own_height) const noexcept {
  // z' rises with z nearly as z itself: the fixed point contracts by the tilt.
  double z = own_height - tooth.axial;
  for (int i = 0; tan_tilt_ != 0 && i < 60; ++i) {
    const double next =
        own_height - tooth.axial - lift(tooth, std::max(z + tooth.axial, 0.0));
    const bool settled = next == z;
    z = next;
    if (settled) break;
  }
  return z;
}

double ToothEdges::lowest_height(std::size_t index) const noexcept {
  const Tooth& tooth = teeth_[index];
  const double at_tip = lift(tooth, 0.0);
  if (at_tip > 0 || tan_tilt_ == 0) {
    return -tooth.axial - at_tip;
  }
  // The tip is lifted: the edge begins where z_1 + lift(z_1) = 0, the upper root.
  const auto above = [&](double z1) { return z1 + lift(tooth, z1); };
  double high = std::max(-4 * at_tip, 1e-3 * meridian_.profile.D);
  while (above(high) < 0) high *= 2;
  double low = 0.5 * high;
  constexpr double next_to_nothing = 1e-16;  // [m]
  while (above(low) > 0 && low > next_to_nothing) {
    high = low;
    low *= 0.5;
  }
  if (low <= next_to_nothing) {
    return -tooth.axial;
  }
  for (int i = 0; i < 100 && high > low; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (above(middle) < 0 ? low : high) = middle;
  }
  return high - tooth.axial;
}

std::vector<double> ToothEdges::breaks(double top) const {
  std::vector<double> all = {top};
  double first = top;
  for (std::size_t j = 0; j < teeth_.size(); ++j) {
    const Tooth& tooth = teeth_[j];
    const double begin = lowest_height(j);
    first = std::min(first, begin);
    all.push_back(begin);
    for (const double node : {meridian_.M.z, meridian_.N.z}) {
      if (node > 0) all.push_back(height_of(tooth, node));
      if (tan_tilt_ != 0) all.push_back(node - tooth.axial);
    }
  }
  std::sort(all.begin(), all.end());
  // The same height by two ways differs by rounding: no edge bends between them.
  constexpr double rounding = 1e-13;  // [m]
  std::vector<double> out;
  for (const double z : all) {
    if (z < first || z > top) continue;
    if (out.empty() || z > out.back() + rounding) {
      out.push_back(z);
    } else if (z == top) {
      out.back() = top;
    }
  }
  return out;
}

double ToothEdges::turn_between(std::size_t tooth, double from,
                                double to) const noexcept {
  return std::abs(edge_at(tooth, to).omega - edge_at(tooth, from).omega);
}

}  // namespace trochoid::geometry
