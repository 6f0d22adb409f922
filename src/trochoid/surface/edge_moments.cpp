#include <trochoid/surface/edge_moments.h>

#include <trochoid/numerics/gauss_kronrod.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::surface {

namespace {

/// Break points along an edge are found to this part of it.
constexpr double relative_resolution = 1e-11;

}  // namespace

std::array<double, columns> wall_coefficients(const force::Law& law) {
  const force::Terms terms = force::terms(law);
  return {terms.K[0], terms.K[1], terms.K_e[0], terms.K_e[1]};
}

EdgeMoments::EdgeMoments(const force::Setup& setup, const force::Law& law,
                         const numerics::LagrangeBasis& basis)
    : edges_(setup), form_(force::form(law)), basis_(basis) {}

void EdgeMoments::at(double phi, const force::Bend* bend, std::span<double> out) const {
  std::fill(out.begin(), out.end(), 0.0);
  const std::size_t n = values();
  force::EdgeCurve curve(edges_, bend);
  numerics::PieceFinder<force::EdgeCurve> finder(
      curve, relative_resolution * edges_.ends.back());
  std::vector<numerics::Piece<force::EdgeState>> pieces;
  std::vector<double> grid;
  std::vector<double> L(basis_.size());
  const numerics::KronrodRule& rule = numerics::kronrod_rule();
  const auto add = [&](double s, double ds) {
    const force::EdgePoint point = edges_.point(s);
    const force::EdgeState state = curve.state(point);
    if (!state.active()) {
      return;
    }
    const force::ColumnWeights w =
        force::column_weights(form_, state.chip.h, point.meridian.sin_kappa, point.dS);
    const double sine = std::sin(state.theta);
    const double cosine = std::cos(state.theta);
    const std::array<double, columns> x = {-cosine * w.cutting[0], -sine * w.cutting[1],
                                           -cosine * w.edge, -sine * w.edge};
    const std::array<double, columns> y = {sine * w.cutting[0], -cosine * w.cutting[1],
                                           sine * w.edge, -cosine * w.edge};  // E-2
    basis_.weights(point.meridian.z, L);
    for (std::size_t c = 0; c < columns; ++c) {
      double* row = out.data() + c * n;
      for (std::size_t q = 0; q < L.size(); ++q) {
        row[q] += ds * y[c] * L[q];  // E-3
      }
      row[L.size()] += ds * x[c];
      row[L.size() + 1] += ds * y[c];
    }
  };
  for (std::size_t j = 0; j < edges_.psi.size(); ++j) {
    curve.stand_at(phi, j);
    grid = edges_.grid;
    curve.add_seeds(grid);
    finder.find(grid, pieces);
    for (const auto& piece : pieces) {
      double from = piece.from;
      for (const double end : edges_.ends) {
        const double to = std::min(end, piece.to);
        if (to > from) {
          for (std::size_t i = 0; i < rule.t.size(); ++i) {
            const double half = 0.5 * (to - from);
            add(from + half * (1 + rule.t[i]), half * rule.kronrod[i]);
          }
          from = to;
        }
      }
    }
  }
}

std::vector<double> EdgeMoments::kinks(bool bent) const {
  std::vector<double> angles;
  std::vector<geometry::EdgePosition> positions(edges_.psi.size());
  for (const double s : {0.0, edges_.ends.back()}) {
    const force::EdgePoint point = edges_.point(s);
    geometry::edge_positions(edges_.setup.runout, edges_.psi, point.meridian.r,
                             point.lag, positions);
    for (std::size_t j = 0; j < positions.size(); ++j) {
      for (const chip::ChipPiece& piece : chip::engaged_pieces(
               edges_.passage,
               {.r = point.meridian.r, .teeth = positions, .bent = bent},
               static_cast<int>(j), -std::numbers::pi / 2)) {
        angles.push_back(piece.from + edges_.psi[j] + point.lag);
        angles.push_back(piece.to + edges_.psi[j] + point.lag);
      }
    }
  }
  return angles;
}

bool EdgeMoments::equal_teeth() const noexcept {
  return force::teeth_alike(edges_.setup);
}

}  // namespace trochoid::surface
