#include <trochoid/dynamics/engaged.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {
namespace {

constexpr double same_delay = 1e-9;  // [rad]

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

namespace {

/// Where a turn of theta starts: behind the tool, where nothing is in cut.
constexpr double start = -std::numbers::pi / 2;
constexpr double longest_panel = 0.8;  // [rad]

/// Angles within (from, to) where h passes the floor of the gradient.
std::vector<double> floor_passes(const CylinderArcs& c, std::size_t tooth, double from,
                                 double to) {
  if (!c.law.form.power) {
    return {};
  }
  const chip::Slice slice{c.r, c.teeth};
  const auto above = [&](double theta) {
    return chip::chip_at(c.passage, slice, static_cast<int>(tooth), theta).h -
           c.h_floor;
  };
  constexpr int steps = 64;
  std::vector<double> found;
  const double step = (to - from) / steps;
  for (int i = 0; i < steps; ++i) {
    double lo = from + i * step;
    double hi = lo + step;
    const bool rises = above(lo) < 0;
    if (rises == (above(hi) < 0)) {
      continue;
    }
    while (hi - lo > 1e-13) {
      const double x = 0.5 * (lo + hi);
      ((above(x) < 0) == rises ? lo : hi) = x;
      if (x == lo && x == hi) {
        break;
      }
    }
    found.push_back(0.5 * (lo + hi));
  }
  return found;
}

std::vector<PassArc> arcs_of(const CylinderArcs& c, std::size_t tooth) {
  std::vector<PassArc> arcs;
  const chip::Slice slice{c.r, c.teeth};
  for (const chip::ChipPiece& piece :
       chip::engaged_pieces(c.passage, slice, static_cast<int>(tooth), start)) {
    const chip::Chip& chip = piece.state.chip;
    PassArc arc{piece.from, piece.to,
                c.passes.channel(c.passage, tooth, chip::mark_of(chip)),
                chip::ends_at_edge(chip)};
    for (const double theta : floor_passes(c, tooth, piece.from, piece.to)) {
      arcs.push_back({arc.from, theta, arc.channel, arc.own});
      arc.from = theta;
    }
    arcs.push_back(arc);
  }
  return arcs;
}

using Table = numerics::PiecewiseIntegral<4>;

std::vector<std::optional<Table>> tables_of(const CylinderArcs& c, std::size_t tooth,
                                            double tolerance) {
  const std::size_t marks = c.passes.delays.size();
  std::vector<std::optional<Table>> tables(marks + (c.largest.damping > 0 ? 2 : 1));
  for (std::size_t channel = 0; channel < tables.size(); ++channel) {
    const bool damps = channel > marks;
    const auto f = [&](double theta) {
      return damps ? c.damping(tooth, theta) : c.gradient(tooth, theta);
    };
    Matrix2 allowed{};
    allowed.fill(0.05 * tolerance * (damps ? c.largest.damping : c.largest.cutting));
    for (const PassArc& arc : c.arcs[tooth]) {
      if (channel == 0 || damps ? arc.own : arc.channel == channel) {
        if (!tables[channel]) {
          tables[channel].emplace(start, unit::turn);
        }
        tables[channel]->append(arc.from, arc.to, f, longest_panel, allowed);
      }
    }
    if (tables[channel]) {
      tables[channel]->finish();
    }
  }
  return tables;
}

}  // namespace

double largest_entry(const Matrix2& m) noexcept {
  return std::max({std::abs(m[0]), std::abs(m[1]), std::abs(m[2]), std::abs(m[3])});
}

CylinderArcs cylinder_arcs(const force::Setup& setup, const force::Terms& law,
                           double h_floor, double tolerance) {
  CylinderArcs c{
      .passes = passes_of(setup),
      .passage = chip::passage(setup.cutter, setup.cut, setup.chip),
      .law = law,
      .flank = force::damping_terms(setup.process_damping),
      .h_floor = h_floor,
      .r = setup.cutter.profile.D / 2,
      .lag_per_height = 2 * std::tan(setup.cutter.helix) / setup.cutter.lag_diameter};
  c.teeth.resize(c.passes.psi.size());
  geometry::edge_positions(force::runout_of(setup), c.passes.psi, c.r, 0.0, c.teeth);
  const std::size_t different = c.passes.equal ? 1 : c.passes.psi.size();
  for (std::size_t j = 0; j < different; ++j) {
    c.arcs.push_back(arcs_of(c, j));
    for (const PassArc& arc : c.arcs.back()) {
      for (const double part : {0.001, 0.5, 0.999}) {
        const double theta = arc.from + part * (arc.to - arc.from);
        c.largest.cutting =
            std::max(c.largest.cutting, largest_entry(c.gradient(j, theta)));
        c.largest.damping =
            std::max(c.largest.damping, largest_entry(c.damping(j, theta)));
      }
    }
  }
  for (std::size_t j = 0; c.lag_per_height > 0 && j < different; ++j) {
    c.tables.push_back(tables_of(c, j, tolerance));
  }
  return c;
}

std::vector<double> CylinderArcs::breaks(double lag) const {
  std::vector<double> out;
  for (std::size_t j = 0; j < arcs.size(); ++j) {
    for (const PassArc& arc : arcs[j]) {
      for (const double theta : {arc.from, arc.to}) {
        out.push_back(theta + passes.psi[j]);
        if (lag > 0) {
          out.push_back(theta + passes.psi[j] + lag);
        }
      }
    }
  }
  return out;
}

Matrix2 CylinderArcs::gradient(std::size_t tooth, double theta) const noexcept {
  double h = 0.0;
  if (law.form.power) {
    const chip::Slice slice{r, teeth};
    h = std::max(h_floor,
                 chip::chip_at(passage, slice, static_cast<int>(tooth), theta).h);
  }
  return directional_gradient(law, h, theta + teeth[tooth].epsilon, 1.0, 0.0);
}

Matrix2 CylinderArcs::damping(std::size_t tooth, double theta) const noexcept {
  Matrix2 g = directional_gradient(flank, 0.0, theta + teeth[tooth].epsilon, 1.0, 0.0);
  for (double& value : g) value /= r;  // D-31
  return g;
}

void CylinderArcs::add_edge(std::size_t tooth, double theta, double lag,
                            std::vector<Matrix2>& out) const noexcept {
  const auto& of_tooth = tables[passes.equal ? 0 : tooth];
  for (std::size_t channel = 0; channel < of_tooth.size(); ++channel) {
    if (of_tooth[channel]) {
      of_tooth[channel]->add_to(out[channel], theta, 1.0);
      of_tooth[channel]->add_to(out[channel], theta - lag, -1.0);
    }
  }
}

void CylinderArcs::add_point(std::size_t tooth, double theta, double middle,
                             std::vector<Matrix2>& out) const noexcept {
  const std::size_t source = passes.equal ? 0 : tooth;
  const double turns = std::floor((middle - start) / unit::turn) * unit::turn;
  for (const PassArc& arc : arcs[source]) {
    if (middle - turns < arc.from || middle - turns > arc.to) {
      continue;
    }
    const Matrix2 g = gradient(source, theta - turns);
    const bool damps = arc.own && largest.damping > 0;
    const Matrix2 d = damps ? damping(source, theta - turns) : Matrix2{};
    for (std::size_t q = 0; q < g.size(); ++q) {
      out[0][q] += arc.own ? g[q] : 0.0;
      if (damps) {
        out.back()[q] += d[q];
      }
      if (arc.channel > 0) {
        out[arc.channel][q] += g[q];
      }
    }
    return;
  }
}

}  // namespace trochoid::dynamics
