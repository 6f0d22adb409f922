#include <trochoid/dynamics/engaged.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

constexpr double same_delay = 1e-9;  // [rad]
/// Break points along an edge are found to this part of it.
constexpr double relative_resolution = 1e-12;

}  // namespace

Passes passes_of(const force::Setup& setup) {
  Passes passes{.equal = force::teeth_alike(setup),
                .psi = geometry::tooth_angles(setup.cutter)};
  passes.period = passes.equal ? unit::turn / setup.cutter.teeth() : unit::turn;
  if (passes.equal) {
    passes.delays = {passes.period};
    return passes;
  }
  const chip::Passage passage = chip::passage(setup.cutter, setup.cut, setup.chip);
  std::vector<double> all = passage.back;
  std::sort(all.begin(), all.end());
  for (const double delay : all) {
    if (passes.delays.empty() || delay - passes.delays.back() > same_delay) {
      passes.delays.push_back(delay);
    }
  }
  return passes;
}

std::size_t Passes::channel(const chip::Passage& passage, std::size_t tooth,
                            int mark) const noexcept {
  if (mark == 0) {
    return 0;
  }
  if (equal) {  // where an older mark counts, by less than f^2/R, the marks touch
    return 1;
  }
  const double delay =
      passage.back[tooth * psi.size() + static_cast<std::size_t>(mark) - 1];
  const auto at = std::lower_bound(delays.begin(), delays.end(), delay - same_delay);
  return static_cast<std::size_t>(at - delays.begin()) + 1;
}

AxialArcs axial_arcs(const force::Setup& given, const force::Terms& law, double h_floor,
                     double a_p, double tolerance) {
  force::Setup setup = given;
  setup.cut.a_p = a_p;
  AxialArcs axial{.passes = passes_of(setup),
                  .edges = std::make_shared<const force::Edges>(setup),
                  .law = law,
                  .flank = force::damping_terms(setup.process_damping),
                  .h_floor = h_floor,
                  .tolerance = tolerance};
  const force::Edges& edges = *axial.edges;
  const std::vector<double>& psi = axial.passes.psi;
  std::vector<geometry::EdgePosition> teeth(psi.size());
  std::vector<double> corners = {0.0, edges.meridian.s_M, edges.meridian.s_N,
                                 edges.ends.back()};
  for (const double s : corners) {
    const force::EdgePoint point = edges.point(s);
    if (s > edges.ends.back() || point.meridian.r < setup.cut.f_z) {
      continue;
    }
    geometry::edge_positions(edges.setup.runout, psi, point.meridian.r, point.lag,
                             teeth);
    const chip::Slice slice{point.meridian.r, teeth};
    const std::size_t different = axial.passes.equal ? 1 : psi.size();
    for (std::size_t j = 0; j < different; ++j) {
      for (const chip::ChipPiece& piece : chip::engaged_pieces(
               edges.passage, slice, static_cast<int>(j), -unit::turn / 4)) {
        axial.breaks.push_back(piece.from + psi[j] + point.lag);
        axial.breaks.push_back(piece.to + psi[j] + point.lag);
      }
    }
  }
  const Matrix2 g = directional_gradient(law, h_floor, unit::turn / 8, 1.0, 0.0);
  axial.largest.cutting = largest_entry(g) * edges.ends.back();
  if (setup.process_damping.acts()) {  // dz rather than ds, which cannot grow with 1/R
    const Matrix2 d =
        directional_gradient(axial.flank, h_floor, unit::turn / 8, 1.0, 0.0);
    axial.largest.damping = largest_entry(d) * 2 * a_p / setup.cutter.profile.D;
  }
  return axial;
}

void AxialArcs::add(double phi, std::vector<Matrix2>& out) const {
  force::EdgeCurve curve(*edges);
  const double length = edges->ends.back();
  numerics::PieceFinder<force::EdgeCurve> finder(curve, relative_resolution * length);
  std::vector<numerics::Piece<force::EdgeState>> pieces;
  Matrix2 allowed{};
  allowed.fill(0.02 * tolerance * largest.cutting);
  Matrix2 damping_allowed{};
  damping_allowed.fill(0.02 * tolerance * largest.damping);
  const double least_R = edges->setup.cut.f_z;
  const auto damping = [&](double s, double weight, Matrix2& sum) {
    const force::EdgePoint point = edges->point(s);
    const Matrix2 g =
        directional_gradient(flank, h_floor, curve.state(point).theta,
                             point.meridian.sin_kappa, point.meridian.cos_kappa);
    for (std::size_t q = 0; q < g.size(); ++q) {
      sum[q] += weight * g[q] / std::max(least_R, point.meridian.r);  // D-31
    }
  };
  const auto gradient = [&](double s, double weight, Matrix2& sum) {
    const force::EdgePoint point = edges->point(s);
    const force::EdgeState state = curve.state(point);
    const Matrix2 g =
        directional_gradient(law, std::max(h_floor, state.chip.h), state.theta,
                             point.meridian.sin_kappa, point.meridian.cos_kappa);
    for (std::size_t q = 0; q < g.size(); ++q) {
      sum[q] += weight * g[q];
    }
  };
  for (std::size_t j = 0; j < passes.psi.size(); ++j) {
    curve.stand_at(phi, j);
    finder.find(edges->grid, pieces);
    for (const auto& piece : pieces) {
      const chip::Chip& chip = piece.state.chip;
      const bool own = chip::ends_at_edge(chip);
      const bool damps = own && largest.damping > 0;
      Matrix2 sum{};
      double from = piece.from;
      for (const double end : edges->ends) {
        const double to = std::min(end, piece.to);
        if (to > from) {
          numerics::add_integral(from, to, gradient, allowed, 1e-9 * length, sum);
          if (damps) {
            numerics::add_integral(from, to, damping, damping_allowed, 1e-9 * length,
                                   out.back());
          }
          from = to;
        }
      }
      const std::size_t channel =
          passes.channel(edges->passage, j, chip::mark_of(chip));
      for (std::size_t q = 0; q < sum.size(); ++q) {
        out[0][q] += own ? sum[q] : 0.0;
        if (channel > 0) {
          out[channel][q] += sum[q];
        }
      }
    }
  }
}

}  // namespace trochoid::dynamics
