#include <trochoid/identification/clocking.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/geometry/meridian.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <stdexcept>

namespace trochoid::identification {
namespace {

/// A turn by less than this separates nothing: errors would be a million times larger.
constexpr double least_turn = 1e-6;

using Complex = std::complex<double>;

Complex vector_of(const Offset& offset) {
  return {offset.e[0], offset.e[1]};
}

/// Covariance of a z where z has that covariance.
std::array<double, 3> turned_covariance(const Complex& a,
                                        const std::array<double, 3>& c) {
  const double p = a.real();
  const double q = a.imag();
  return {p * p * c[0] - 2.0 * p * q * c[1] + q * q * c[2],
          p * q * (c[0] - c[2]) + (p * p - q * q) * c[1],
          q * q * c[0] + 2.0 * p * q * c[1] + p * p * c[2]};
}

/// a times one offset plus b times another, which are independent.
Offset combined(const Complex& a, const Offset& x, const Complex& b, const Offset& y) {
  const Complex z = a * vector_of(x) + b * vector_of(y);
  Offset out{{z.real(), z.imag()}, turned_covariance(a, x.covariance)};
  const std::array<double, 3> more = turned_covariance(b, y.covariance);
  for (std::size_t i = 0; i < 3; ++i) out.covariance[i] += more[i];
  return out;
}

}  // namespace

double Offset::amount() const noexcept {
  return std::hypot(e[0], e[1]);
}

double Offset::angle() const noexcept {
  return e[0] == 0.0 && e[1] == 0.0 ? 0.0 : std::atan2(e[1], e[0]);
}

double Offset::amount_se() const noexcept {
  const double c = std::cos(angle());
  const double s = std::sin(angle());
  return std::sqrt(std::max(0.0, c * c * covariance[0] + 2.0 * c * s * covariance[1] +
                                     s * s * covariance[2]));
}

double Offset::angle_se() const noexcept {
  if (!(amount() > 0.0)) return std::numeric_limits<double>::infinity();
  const double c = std::cos(angle());
  const double s = std::sin(angle());
  return std::sqrt(std::max(0.0, s * s * covariance[0] - 2.0 * c * s * covariance[1] +
                                     c * c * covariance[2])) /
         amount();
}

Offset offset_of(double rho, double lambda, double rho_se, double lambda_se) noexcept {
  const Complex direction = std::polar(1.0, lambda);
  const double across = rho * lambda_se;
  const Complex e = rho * direction;
  return {{e.real(), e.imag()},
          turned_covariance(direction, {rho_se * rho_se, 0.0, across * across})};
}

int longest_tooth(const geometry::Cutter& cutter, const geometry::Runout& runout,
                  double z) {
  const std::vector<double> psi = geometry::tooth_angles(cutter);
  const geometry::Meridian m = geometry::meridian(cutter.profile);
  const double s = geometry::arc_length_at(m, z);
  const double r = geometry::point_at(m, s).r;
  const double lag = geometry::lag_at(cutter, m, s).angle;
  std::vector<double> out;
  for (std::size_t k = 0; k < psi.size(); ++k) {
    const double own = runout.radial_offsets.empty() ? 0.0 : runout.radial_offsets[k];
    out.push_back(
        geometry::edge_position(runout, r + own, psi[k] + lag - runout.angle).R);
  }
  return 1 + static_cast<int>(std::ranges::max_element(out) - out.begin());
}

Separation separate(const Offset& before, const Offset& now, double turned) {
  const Complex rotation = std::polar(1.0, turned);
  if (std::abs(1.0 - rotation) < least_turn) {
    throw std::invalid_argument("a tool that was not turned in its holder");
  }
  const Complex factor = 1.0 / (1.0 - rotation);  // I-22
  Separation out;
  out.tool = combined(factor, before, -factor * rotation, now);
  out.holder = combined(1.0 - factor, before, factor * rotation, now);
  const double opposite = out.holder.angle() + 0.5 * unit::turn - out.tool.angle();
  out.best_turn = std::remainder(opposite - turned, unit::turn);
  out.least = std::abs(out.holder.amount() - out.tool.amount());
  return out;
}

}  // namespace trochoid::identification
