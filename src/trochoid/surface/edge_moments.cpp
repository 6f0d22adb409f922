#include <trochoid/surface/edge_moments.h>

#include <trochoid/numerics/gauss_kronrod.h>
#include <trochoid/surface/edge_nodes.h>
#include <trochoid/surface/pass.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

namespace trochoid::surface {

namespace {

/// Break points along an edge are found to this part of it.
constexpr double relative_resolution = 1e-11;

/// Moments, then F_x, then F_y, which is the sum of the moments.
void put_moments(const PointRow& across, double along, std::span<double> out) {
  const std::size_t points = out.size() - 2;
  double F_y = 0.0;
  for (std::size_t q = 0; q < points; ++q) {
    out[q] = across[q];
    F_y += across[q];
  }
  out[points] = along;
  out[points + 1] = F_y;
}

}  // namespace

std::array<double, columns> wall_coefficients(const force::Law& law) {
  const force::Terms terms = force::terms(law);
  return {terms.K[0], terms.K[1], terms.K_e[0], terms.K_e[1]};
}

EdgeMoments::EdgeMoments(const force::Setup& setup, const force::Law& law,
                         const numerics::LagrangeBasis& basis, const StockLeft& left)
    : edges_(setup), form_(force::form(law)), terms_(force::terms(law)), basis_(basis) {
  const std::optional<Side> side = side_of(setup.cut.engagement);
  if (left && !side) {
    throw std::invalid_argument("stock left before a cut that has no single wall");
  }
  if (!left) {
    nodes_ = EdgeNodes::make(edges_, form_, basis_);
  }
  if (left) {
    shift_ = [left, sigma = side->sigma](double z) {
      return -sigma * left(z);
    };  // E-40
  }
}

template <class Add>
void EdgeMoments::integrate(double phi, const force::Bend* bend, const Add& add) const {
  force::Bend shifted;
  if (shift_) {
    shifted.shift = [this, bend](double z) {
      return (bend == nullptr ? 0.0 : bend->shift(z)) + shift_(z);
    };
    shifted.deflected = bend != nullptr;
    if (bend != nullptr) {
      shifted.advance = bend->advance;
    }
    bend = &shifted;
  }
  force::EdgeCurve curve(edges_, bend);
  const numerics::KronrodRule& rule = numerics::kronrod_rule();
  const auto add_at = [&](double s, double ds) {
    const force::EdgePoint point = edges_.point(s);
    const force::EdgeState state = curve.state(point);
    if (state.active()) {
      add(point, state, ds);
    }
  };
  const double resolution = relative_resolution * edges_.ends.back();
  force::for_each_stretch(edges_, curve, phi, resolution, [&](double from, double to) {
    const double half = 0.5 * (to - from);
    for (std::size_t i = 0; i < rule.t.size(); ++i) {
      add_at(from + half * (1 + rule.t[i]), half * rule.kronrod[i]);
    }
  });
}

void EdgeMoments::from_nodes(double phi, const NodeBend* bend,
                             std::span<double> out) const {
  MomentSums sums;
  nodes_->at(phi, bend, sums);
  for (std::size_t c = 0; c < columns; ++c) {
    put_moments(sums.across[c], sums.along[c], out.subspan(c * values(), values()));
  }
}

void EdgeMoments::bent_at(double phi, const NodeBend& bend,
                          std::span<double> out) const {
  if (nodes_) {
    from_nodes(phi, &bend, out);
    return;
  }
  const std::size_t points = basis_.size();
  std::vector<double> now(points);
  basis_.series(bend.shift, now);
  std::vector<double> then(bend.before.size());
  for (std::size_t k = 0; k < then.size(); k += points) {
    basis_.series(bend.before.subspan(k, points), std::span(then).subspan(k, points));
  }
  force::Bend curve;
  curve.shift = [&](double z) { return basis_.series_value(now, z); };
  if (!then.empty()) {
    curve.advance = [&](double z, std::size_t tooth, double theta,
                        std::span<double> gained) {
      const double here = basis_.series_value(now, z);
      const double cosine = std::cos(theta);
      for (std::size_t m = 0; m < gained.size(); ++m) {
        const std::size_t mark = tooth * gained.size() + m;
        const double before =
            basis_.series_value(std::span(then).subspan(mark * points, points), z);
        gained[m] = cosine * (here - before);  // E-10
      }
    };
  }
  at(phi, &curve, out);
}

void EdgeMoments::at(double phi, const force::Bend* bend, std::span<double> out) const {
  const std::size_t n = values();
  if (bend == nullptr && nodes_) {
    from_nodes(phi, nullptr, out);
    return;
  }
  std::fill(out.begin(), out.end(), 0.0);
  std::vector<double> L(basis_.size());
  integrate(
      phi, bend,
      [&](const force::EdgePoint& point, const force::EdgeState& state, double ds) {
        const force::ColumnWeights w = force::column_weights(
            form_, state.chip.h, point.meridian.sin_kappa, point.dS);
        const double sine = std::sin(state.theta);
        const double cosine = std::cos(state.theta);
        const std::array<double, columns> x = {-cosine * w.cutting[0],
                                               -sine * w.cutting[1], -cosine * w.edge,
                                               -sine * w.edge};
        const std::array<double, columns> y = {sine * w.cutting[0],
                                               -cosine * w.cutting[1], sine * w.edge,
                                               -cosine * w.edge};  // E-2
        basis_.weights(point.meridian.z, L);
        for (std::size_t c = 0; c < columns; ++c) {
          double* row = out.data() + c * n;
          for (std::size_t q = 0; q < L.size(); ++q) {
            row[q] += ds * y[c] * L[q];  // E-3
          }
          row[L.size()] += ds * x[c];
          row[L.size() + 1] += ds * y[c];
        }
      });
}

void EdgeMoments::couples_at(double phi, const LeverArms& arms,
                             std::span<double> out) const {
  std::fill(out.begin(), out.end(), 0.0);
  const std::size_t n = basis_.size();
  std::vector<double> L(n);
  integrate(
      phi, nullptr,
      [&](const force::EdgePoint& point, const force::EdgeState& state, double ds) {
        const force::ColumnWeights w = force::column_weights(
            form_, state.chip.h, point.meridian.sin_kappa, point.dS);
        std::array<double, 3> tra{};
        for (std::size_t q = 0; q < 3; ++q) {
          tra[q] = terms_.K[q] * w.cutting[q] + terms_.K_e[q] * w.edge;
        }
        const double cosine = std::cos(state.theta);
        const double across = state.R * cosine;
        const double F_x =
            force::in_plane(tra[0], tra[1], std::sin(state.theta), cosine)[0];
        const double F_z = -tra[2];
        const double arm = arms.sigma * arms.mid_plane + across;  // sigma l
        const std::array<double, 4> parts = {F_x, arm * F_x, across * F_z, arm * F_z};
        basis_.weights(point.meridian.z, L);
        for (std::size_t k = 0; k < parts.size(); ++k) {
          for (std::size_t q = 0; q < n; ++q) {
            out[k * n + q] += ds * parts[k] * L[q];  // E-42
          }
        }
      });
}

std::vector<double> EdgeMoments::kinks(bool bent) const {
  std::vector<double> angles;
  std::vector<geometry::EdgePosition> positions(edges_.psi.size());
  for (const double s : {0.0, edges_.ends.back()}) {
    const force::EdgePoint point = edges_.point(s);
    geometry::edge_positions(edges_.setup.runout, edges_.psi, point.meridian.r,
                             point.lag, positions);
    chip::Slice slice{.r = point.meridian.r, .teeth = positions, .bent = bent};
    slice.shift = shift_ ? shift_(point.meridian.z) : 0.0;
    for (std::size_t j = 0; j < positions.size(); ++j) {
      for (const chip::ChipPiece& piece : chip::engaged_pieces(
               edges_.passage, slice, static_cast<int>(j), -std::numbers::pi / 2)) {
        angles.push_back(piece.from + edges_.psi[j] + point.lag);
        angles.push_back(piece.to + edges_.psi[j] + point.lag);
      }
    }
  }
  return angles;
}

bool EdgeMoments::equal_teeth() const {
  return force::teeth_alike(edges_.setup);
}

}  // namespace trochoid::surface
