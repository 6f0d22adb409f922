#include <trochoid/force/axial.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/gauss_kronrod.h>
#include <trochoid/numerics/smooth_samples.h>

#include <algorithm>
#include <cmath>

namespace trochoid::force {
namespace {

/// Break points are found to this part of the edge, or of the tolerance: where a chip
/// jumps they are the ends of a quadrature that errs no less.
constexpr double finest_resolution = 1e-12;
constexpr double resolution_by_tolerance = 1e-3;
/// Errors allowed on a piece, in parts of the tolerance.
constexpr double share_of_piece = 0.02;
/// The same between angles that are computed, of that on a piece.
constexpr double share_between = 0.2;
/// What a tooth does near the axis takes more than this angle.
constexpr double widest_between = 1.5 * unit::deg;

/// A direction and its three components.
using Frame = std::array<std::array<double, 3>, 3>;

/// Rows x, y, z; columns t, r, a.
Frame frame(double theta, const geometry::MeridianPoint& p) noexcept {
  const double s = std::sin(theta);
  const double c = std::cos(theta);
  return {{{-c, -s * p.sin_kappa, -s * p.cos_kappa},  // F-3
           {s, -c * p.sin_kappa, -c * p.cos_kappa},
           {0.0, p.cos_kappa, -p.sin_kappa}}};
}

/// No chip can be thicker than the feed of the widest gap and the runout, nor, where
/// all marks count, than the feed of a turn.
double thickest_chip(const Edges& edges) {
  const geometry::Runout& runout = edges.setup.runout;
  double spread = 2 * runout.eccentricity;
  if (!runout.radial_offsets.empty()) {
    const auto [lo, hi] =
        std::minmax_element(runout.radial_offsets.begin(), runout.radial_offsets.end());
    spread += *hi - *lo;
  }
  const double gap = *std::max_element(edges.setup.cutter.pitch.begin(),
                                       edges.setup.cutter.pitch.end());
  const double previous = edges.passage.feed * gap + spread;
  return edges.setup.chip.lookback == chip::Lookback::all
             ? std::min(previous, edges.passage.feed * unit::turn)
             : previous;
}

}  // namespace

AxialForce::AxialForce(const Setup& setup, const Law& law, double tolerance)
    : edges_(setup, tolerance), terms_(terms(law)) {
  const double h = thickest_chip(edges_);
  const double length = edges_.ends.back();
  if (h > 0) {
    const ColumnWeights w = column_weights(terms_.form, h, 1.0, 1.0);
    allowed_cutting_ = share_of_piece * tolerance * length *
                       std::max({w.cutting[0], w.cutting[1], w.cutting[2]});
  }
  allowed_edge_ = share_of_piece * tolerance * length;
  smallest_ = 0.1 * tolerance * length;
  resolution_ =
      std::max(finest_resolution, resolution_by_tolerance * tolerance) * length;
}

template <std::size_t M, class Element>
void AxialForce::integrate(double phi, const std::array<double, M>& allowed,
                           const Element& element, std::array<double, M>& sum) const {
  EdgeCurve curve(edges_);
  const auto add = [&](double s, double weight, std::array<double, M>& out) {
    const EdgePoint point = edges_.point(s);
    const EdgeState state = curve.state(point);
    if (state.active()) {
      element(point, state, weight, out);
    }
  };
  for_each_stretch(edges_, curve, phi, resolution_, [&](double from, double to) {
    numerics::add_integral(from, to, add, allowed, smallest_, sum);
  });
}

AxialForce::Matrix AxialForce::matrix(double phi, const Matrix& allowed) const {
  Matrix sum{};
  const auto element = [&](const EdgePoint& point, const EdgeState& state,
                           double weight, Matrix& out) {
    const Frame B = frame(state.theta, point.meridian);
    const ColumnWeights w =
        column_weights(terms_.form, state.chip.h, point.meridian.sin_kappa, point.dS);
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t q = 0; q < 3; ++q) {
        out[6 * row + q] += weight * B[row][q] * w.cutting[q];  // F-4
        out[6 * row + 3 + q] += weight * B[row][q] * w.edge;
      }
    }
  };
  integrate(phi, allowed, element, sum);
  const std::size_t columns = terms_.form.columns();
  Matrix C{};
  for (std::size_t row = 0; row < 3; ++row) {
    std::copy_n(&sum[6 * row], columns, &C[columns * row]);
  }
  return C;
}

void AxialForce::matrices(std::span<const double> phi, std::span<Matrix> C) const {
  const std::size_t columns = terms_.form.columns();
  Matrix allowed{};  // as they are summed, six columns
  Matrix between{};  // as they are given
  for (std::size_t q = 0; q < allowed.size(); ++q) {
    allowed[q] = q % 6 < 3 ? allowed_cutting_ : allowed_edge_;
    between[q] = share_between * (q % columns < 3 ? allowed_cutting_ : allowed_edge_);
  }
  numerics::sample_smooth(
      phi, widest_between, between,
      [&](double angle) { return matrix(angle, allowed); }, C);
}

void AxialForce::loads(std::span<const double> phi, double gauge_length,
                       std::span<SixLoads> all) const {
  const auto largest = [](const std::array<double, 3>& v) {
    return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
  };
  const double force =
      allowed_cutting_ * largest(terms_.K) + allowed_edge_ * largest(terms_.K_e);
  const double arm = edges_.setup.cutter.profile.D / 2;
  const double reach = std::max({arm, edges_.setup.cut.a_p, gauge_length});
  const SixLoads allowed{force,       force,         force,
                         force * arm, force * reach, force * reach};
  SixLoads between = allowed;
  for (double& x : between) x *= share_between;
  numerics::sample_smooth(
      phi, widest_between, between,
      [&](double angle) { return loads(angle, gauge_length, allowed); }, all);
}

SixLoads AxialForce::loads(double phi, double gauge_length) const {
  SixLoads one{};
  loads(std::span(&phi, 1), gauge_length, std::span(&one, 1));
  return one;
}

SixLoads AxialForce::loads(double phi, double gauge_length,
                           const SixLoads& allowed) const {
  SixLoads sum{};
  const auto element = [&](const EdgePoint& point, const EdgeState& state,
                           double weight, SixLoads& out) {
    const ColumnWeights w =
        column_weights(terms_.form, state.chip.h, point.meridian.sin_kappa, point.dS);
    std::array<double, 3> tra{};
    for (std::size_t q = 0; q < 3; ++q) {
      tra[q] = weight * (terms_.K[q] * w.cutting[q] + terms_.K_e[q] * w.edge);
    }
    add_loads({.sine = std::sin(state.theta),
               .cosine = std::cos(state.theta),
               .sin_kappa = point.meridian.sin_kappa,
               .cos_kappa = point.meridian.cos_kappa,
               .R = state.R,
               .z = point.meridian.z - gauge_length},
              tra, out);
  };
  integrate(phi, allowed, element, sum);
  return sum;
}

}  // namespace trochoid::force
