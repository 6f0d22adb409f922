#include <trochoid/force/node_panel.h>

#include <trochoid/base/units.h>
#include <trochoid/force/any_edges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::force {
namespace {

/// @brief The column of one node in the rows of a tooth.
struct Column {
  NodeTooth& tooth;
  std::size_t width;
  std::size_t node;

  double& operator[](std::size_t row) const noexcept {
    return tooth.rows[row * width + node];
  }
};

/// The simplified models are apart + back sin(theta).
void simplify(chip::Model model, double feed, double& apart, double& slope) noexcept {
  switch (model) {
    case chip::Model::none:
      slope = feed;
      apart = 0.0;
      return;
    case chip::Model::feed:
      slope = feed + apart;
      apart = 0.0;
      return;
    case chip::Model::radial:
      slope = feed;
      return;
    case chip::Model::trochoidal:
      return;
  }
}

/// @brief Teeth that pass one after the other, at the height of a node.
struct Teeth {
  const chip::Passage& passage;
  std::span<const geometry::EdgePosition> positions;
};

void fill_marks(const Teeth& teeth, std::size_t j, const Column& at) {
  const chip::Passage& passage = teeth.passage;
  const chip::Model model = passage.model.model;
  const std::size_t N = teeth.positions.size();
  const geometry::EdgePosition& own = teeth.positions[j];
  for (std::size_t m = 1; m <= static_cast<std::size_t>(passage.marks); ++m) {
    const geometry::EdgePosition& other = teeth.positions[(j + N - m % N) % N];
    const double back = passage.back[j * N + m - 1];
    const bool turned = model == chip::Model::trochoidal && m != N;
    const std::size_t row = NodeTooth::first_mark + (m - 1) * NodeTooth::rows_of_mark;
    at[row + NodeTooth::apart] = own.R - other.R;
    at[row + NodeTooth::back] = back + (turned ? other.epsilon - own.epsilon : 0.0);
    at[row + NodeTooth::mark_radius] = other.R;
    at[row + NodeTooth::bend] = passage.feed / other.R;
    simplify(model, passage.feed * back, at[row + NodeTooth::apart],
             at[row + NodeTooth::back]);
  }
}

/// @param omega  nominal angle behind the tip of tooth 1 [rad]
void fill_tooth(const Teeth& teeth, std::size_t j, double omega, const Column& at) {
  const double turned = -omega + teeth.positions[j].epsilon;
  const bool exact = teeth.passage.model.model == chip::Model::trochoidal;
  at[NodeTooth::cosine] = std::cos(turned);
  at[NodeTooth::sine] = std::sin(turned);
  at[NodeTooth::chip_cosine] = std::cos(exact ? turned : -omega);
  at[NodeTooth::chip_sine] = std::sin(exact ? turned : -omega);
  at[NodeTooth::radius] = teeth.positions[j].R;
  fill_marks(teeth, j, at);
}

void fill_nodes(const Edges& edges, const NodeRule& rule, NodePanel& panel) {
  const double half = 0.5 * (panel.to - panel.from);
  NodeEdge& edge = panel.edges.emplace_back();
  std::vector<geometry::EdgePosition> teeth(edges.psi.size());
  for (std::size_t i = 0; i < rule.nodes; ++i) {
    const double s = std::clamp(0.5 * (panel.from + panel.to) + half * rule.t[i],
                                panel.from, std::nextafter(panel.to, panel.from));
    const EdgePoint point = edges.point(s);
    panel.z[i] = point.meridian.z;
    edge.r[i] = point.meridian.r;
    edge.sin_kappa[i] = point.meridian.sin_kappa;
    edge.cos_kappa[i] = point.meridian.cos_kappa;
    edge.width[i] = half * point.meridian.sin_kappa;
    edge.length[i] = half;
    edge.edge[i] = half * point.dS;
    geometry::edge_positions(edges.setup.runout, edges.psi, point.meridian.r, point.lag,
                             teeth);
    for (std::size_t j = 0; j < panel.teeth.size(); ++j) {
      fill_tooth({edges.passage, teeth}, j, edges.psi[j] + point.lag,
                 {panel.teeth[j], rule.width, i});
    }
  }
}

/// From the second derivative of a sine over the widest gap between two nodes.
void set_slack(const Edges& edges, const NodeRule& rule, NodePanel& panel) {
  const geometry::Profile& p = edges.setup.cutter.profile;
  const double around = p.R > 0 ? (panel.to - panel.from) / (2 * p.R) : 0.0;
  const double turned =
      std::max(panel.half_turn, panel.from < edges.meridian.s_N ? around : 0.0);
  const double step =
      (rule.t[rule.nodes / 2] - rule.t[rule.nodes / 2 - 1]) * turned * 1.2;
  const double bend = 0.25 * step * step;
  const double f = edges.passage.feed * unit::turn;
  const NodeRow& r = panel.edges.front().r;
  const double least_r = std::min(r[0], r[rule.nodes - 1]);
  const double curved = least_r > 0.5 * f ? 1 + 2 * f / least_r : 5.0;
  panel.slack = bend * curved * (f + 2 * reach_of(edges.setup.runout)) + 1e-14;
  panel.stock_slack = bend * p.D + 1e-12;
}

NodeTooth empty_tooth(const NodeRule& rule, std::size_t marks) {
  const std::size_t rows = NodeTooth::first_mark + marks * NodeTooth::rows_of_mark;
  return {.marks = marks, .rows = std::vector<double>(rows * rule.width, 1.0)};
}

}  // namespace

double reach_of(const geometry::Runout& runout) noexcept {
  double most = 0.0;
  for (const double offset : runout.radial_offsets) {
    most = std::max(most, std::abs(offset));
  }
  return most + runout.eccentricity;
}

NodePanel node_panel(const Edges& edges, const NodeRule& rule, double from, double to) {
  NodePanel panel{.from = from, .to = to, .half = 0.5 * (to - from)};
  panel.teeth.assign(edges.psi.size(),
                     empty_tooth(rule, static_cast<std::size_t>(edges.passage.marks)));
  fill_nodes(edges, rule, panel);
  const double begin = edges.point(from).lag;
  const double end = edges.point(to).lag;
  for (std::size_t j = 0; j < panel.teeth.size(); ++j) {
    panel.teeth[j].middle = -edges.psi[j] - 0.5 * (begin + end);
  }
  panel.half_turn = 0.5 * (end - begin);
  set_slack(edges, rule, panel);
  return panel;
}

namespace {

/// Ends of a zone are looked at from inside: at the start of a corner ds/dz has no end
/// while ds/dt has one, and a serration begins at a height with a step.
constexpr double next_to_start = 1e-6;
constexpr double next_to_end = 1 - 1e-9;

/// Teeth that are there, numbered as the panel has them.
std::vector<std::size_t> present(const Zone& zone) {
  std::vector<std::size_t> teeth;
  for (std::size_t j = 0; j < zone.there.size(); ++j) {
    if (zone.there[j] != 0) teeth.push_back(j);
  }
  return teeth;
}

void fill_edge(const geometry::EdgeAt& at, EdgeLength length, double dz, std::size_t i,
               NodeEdge& edge) {
  edge.r[i] = at.r;
  edge.sin_kappa[i] = at.sin_kappa;
  edge.cos_kappa[i] = at.cos_kappa;
  edge.width[i] = dz;
  edge.length[i] = dz / at.sin_kappa;
  edge.edge[i] = dz * (length == EdgeLength::axial ? 1.0 : at.dS_dz);
}

/// @return angles of the edges behind the tip of tooth 1 [rad], shape (teeth, nodes)
std::vector<NodeRow> fill_any_nodes(const AnyEdges& any, const NodeRule& rule,
                                    const Zone& zone, NodePanel& panel) {
  const std::vector<std::size_t> there = present(zone);
  std::vector<NodeRow> omega(there.size());
  chip::TeethAtHeight at(any.edges, any.passage);
  for (std::size_t i = 0; i < rule.nodes; ++i) {
    const double place = std::clamp(
        0.5 * (panel.from + panel.to) + 0.5 * (panel.to - panel.from) * rule.t[i],
        next_to_start, next_to_end);
    at.stand_at(zone.from, zone.beyond(place), zone.there);
    panel.z[i] = zone.from + zone.beyond(place);
    const double dz = 0.5 * (panel.to - panel.from) * zone.slope(place);
    const Teeth teeth{at.passage(), at.slice(there.front()).teeth};
    for (std::size_t k = 0; k < there.size(); ++k) {
      omega[k][i] = at.edge(there[k]).omega;
      fill_edge(at.edge(there[k]), any.setup.edge_length, dz, i, panel.edges[k]);
      fill_tooth(teeth, k, omega[k][i], {panel.teeth[k], rule.width, i});
    }
  }
  return omega;
}

/// How far values at the nodes bend between two of them.
class Bending {
 public:
  explicit Bending(const NodeRule& rule) : rule_(rule) {
    for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
      middle_.push_back(basis_at(rule, 0.5 * (rule.t[i] + rule.t[i + 1])));
    }
  }

  [[nodiscard]] double operator()(const double* values) const noexcept {
    double most = 0.0;
    for (std::size_t i = 0; i < middle_.size(); ++i) {
      double value = 0.0;
      for (std::size_t k = 0; k < rule_.nodes; ++k) value += middle_[i][k] * values[k];
      most = std::max(most, std::abs(value - 0.5 * (values[i] + values[i + 1])));
    }
    return most;
  }

 private:
  const NodeRule& rule_;
  std::vector<NodeRow> middle_;
};

/// From how radii and angles bend, and from the second derivative of a sine.
void set_any_slack(const AnyEdges& any, const NodeRule& rule, NodePanel& panel) {
  constexpr double caution = 1.5;
  const Bending bending(rule);
  const bool exact = any.passage.model.model == chip::Model::trochoidal;
  const double per_back = exact ? any.passage.feed : 1.0;  // else a slope by itself
  double apart = 0.0;                                      // of one tooth and another
  double mark = 0.0;  // how far chips over a mark bend by what edges do
  double radius = 0.0;
  double least_r = std::numeric_limits<double>::infinity();
  for (const NodeTooth& tooth : panel.teeth) {
    const auto row = [&](std::size_t k) { return &tooth.rows[k * rule.width]; };
    const double* const R = row(NodeTooth::radius);
    least_r = std::min(least_r, *std::min_element(R, R + rule.nodes));
    radius = std::max(radius, bending(R));
    for (std::size_t m = 0; m < tooth.marks; ++m) {
      const std::size_t first = NodeTooth::first_mark + m * NodeTooth::rows_of_mark;
      const double* const off = row(first + NodeTooth::apart);
      const double slope = bending(row(first + NodeTooth::back)) * per_back;
      mark = std::max(mark, bending(off) + slope);
      for (std::size_t i = 0; i < rule.nodes; ++i) {
        apart = std::max(apart, std::abs(off[i]));
      }
    }
  }
  const double gap = rule.t[rule.nodes / 2] - rule.t[rule.nodes / 2 - 1];
  const double step = 1.2 * gap * panel.half_turn;
  const double bend = 0.25 * step * step;
  const double f = any.passage.feed * unit::turn;
  const double curved = least_r > 0.5 * f ? 1 + 2 * f / least_r : 5.0;
  panel.slack = caution * mark + bend * curved * (f + apart) + 1e-14;
  panel.stock_slack = caution * radius + bend * any.setup.cutter.profile.D + 1e-12;
}

}  // namespace

NodePanel node_panel(const AnyEdges& any, const NodeRule& rule, const Zone& zone,
                     double from, double to) {
  NodePanel panel{.from = from, .to = to};
  const auto count = static_cast<std::size_t>(std::ranges::count(zone.there, 1));
  const std::size_t marks =
      std::min(static_cast<std::size_t>(any.passage.marks), count);
  panel.teeth.assign(count, empty_tooth(rule, marks));
  panel.edges.resize(count);
  const std::vector<NodeRow> omega = fill_any_nodes(any, rule, zone, panel);
  for (std::size_t k = 0; k < count; ++k) {
    const auto [lo, hi] =
        std::minmax_element(omega[k].begin(), omega[k].begin() + rule.nodes);
    panel.teeth[k].edge = k;
    panel.teeth[k].middle = -0.5 * (*lo + *hi);
    panel.half_turn = std::max(panel.half_turn, 0.5 * (*hi - *lo));
    for (std::size_t i = 0; i < rule.nodes; ++i) {
      panel.half += panel.edges[k].length[i] / static_cast<double>(count * rule.nodes);
    }
  }
  set_any_slack(any, rule, panel);
  return panel;
}

namespace {

/// Below this tolerance eight nodes would need many panels.
constexpr double fine_tolerance = 1e-7;

/// Factors of the powers in Lagrange's i-th polynomial.
std::array<long double, node_room> lagrange(const NodeRule& rule, std::size_t i) {
  std::array<long double, node_room> p{1.0L};
  std::size_t degree = 0;
  for (std::size_t j = 0; j < rule.nodes; ++j) {
    if (j == i) {
      continue;
    }
    const long double scale = 1.0L / (rule.t[i] - static_cast<long double>(rule.t[j]));
    for (std::size_t k = ++degree; k > 0; --k) {
      p[k] = scale * (p[k - 1] - rule.t[j] * p[k]);
    }
    p[0] *= -scale * rule.t[j];
  }
  return p;
}

NodeRule make_rule(std::size_t nodes) {
  NodeRule rule{.nodes = nodes, .width = (nodes + 7) / 8 * 8};
  const double last = static_cast<double>(nodes - 1);
  for (std::size_t i = 0; i < nodes; ++i) {
    rule.t[i] = -std::cos(std::numbers::pi * static_cast<double>(i) / last);
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    const auto p = lagrange(rule, i);
    for (std::size_t k = 0; k < nodes; ++k) {
      const auto factor = static_cast<double>(p[k]);
      rule.l[k][i] = factor;
      rule.power[i][k] = factor;
      rule.area[k + 1][i] = factor / static_cast<double>(k + 1);
    }
    // Discrete cosine transform on the closed nodes.
    const bool end = i == 0 || i + 1 == nodes;
    for (std::size_t back = 0; back < 2; ++back) {
      const std::size_t k = nodes - 1 - back;
      const double angle =
          std::numbers::pi * static_cast<double>(k * (nodes - 1 - i)) / last;
      rule.tail[back][i] =
          (end ? 1.0 : 2.0) / last * std::cos(angle) * (back == 0 ? 0.5 : 1.0);
    }
  }
  const NodeRow to = area_at(rule, 1.0);
  const NodeRow from = area_at(rule, -1.0);
  for (std::size_t i = 0; i < nodes; ++i) {
    rule.whole[i] = to[i] - from[i];
  }
  return rule;
}

struct ValueAndSlope {
  double value;
  double slope;
};

ValueAndSlope with_slope(const NodeRule& rule, const NodeRow& powers,
                         double t) noexcept {
  ValueAndSlope p{0.0, 0.0};
  for (std::size_t k = rule.nodes; k-- > 0;) {
    p.slope = p.slope * t + p.value;
    p.value = p.value * t + powers[k];
  }
  return p;
}

/// A stretch at whose ends a function has values of different signs.
struct Bracket {
  double from;
  double to;
  double value_from;
  double value_to;
};

double root_in(const NodeRule& rule, const NodeRow& powers, Bracket b) noexcept {
  const bool rises = b.value_to > b.value_from;
  double t = b.from + (b.to - b.from) * b.value_from / (b.value_from - b.value_to);
  for (int i = 0; i < 60; ++i) {
    const auto [value, slope] = with_slope(rule, powers, t);
    ((value < 0) == rises ? b.from : b.to) = t;
    double next = t - value / slope;
    if (!(next > b.from && next < b.to)) {
      if (std::abs(next - t) < 1e-13) {
        return t;
      }
      next = 0.5 * (b.from + b.to);
    }
    const double step = std::abs(next - t);
    t = next;
    if (step < 1e-8) {  // Newton's next step is below rounding
      const auto last = with_slope(rule, powers, t);
      const double better = t - last.value / last.slope;
      return std::abs(better - t) < 1e-8 ? better : t;
    }
  }
  return t;
}

/// Where the function comes nearest to zero between two nodes of one sign; `from` where
/// it does so at an end.
double nearest_to_zero(const NodeRule& rule, const NodeRow& powers,
                       const Bracket& b) noexcept {
  const double sign = b.value_from < 0 ? -1.0 : 1.0;
  double lo = b.from;
  double hi = b.to;
  if (sign * with_slope(rule, powers, lo).slope >= 0 ||
      sign * with_slope(rule, powers, hi).slope <= 0) {
    return b.from;
  }
  for (int i = 0; i < 30; ++i) {
    const double t = 0.5 * (lo + hi);
    (sign * with_slope(rule, powers, t).slope < 0 ? lo : hi) = t;
  }
  return 0.5 * (lo + hi);
}

}  // namespace

const NodeRule& node_rule(double tolerance) {
  static const NodeRule coarse = make_rule(8);
  static const NodeRule fine = make_rule(12);
  return tolerance < fine_tolerance ? fine : coarse;
}

NodeRow powers_of(const NodeRule& rule, const double* values) noexcept {
  NodeRow powers{};
  for (std::size_t i = 0; i < rule.nodes; ++i) {
    for (std::size_t k = 0; k < rule.width; ++k) {
      powers[k] += rule.power[i][k] * values[i];
    }
  }
  return powers;
}

double value_at(const NodeRule& rule, const NodeRow& powers, double t) noexcept {
  return with_slope(rule, powers, t).value;
}

NodeRow basis_at(const NodeRule& rule, double t) noexcept {
  NodeRow values{};
  for (std::size_t k = rule.nodes; k-- > 0;) {
    for (std::size_t i = 0; i < rule.width; ++i) {
      values[i] = values[i] * t + rule.l[k][i];
    }
  }
  return values;
}

NodeRow area_at(const NodeRule& rule, double t) noexcept {
  NodeRow values{};
  for (std::size_t k = rule.nodes + 1; k-- > 0;) {
    for (std::size_t i = 0; i < rule.width; ++i) {
      values[i] = values[i] * t + rule.area[k][i];
    }
  }
  return values;
}

NodeRoots roots_of(const NodeRule& rule, const double* values, double slack) noexcept {
  NodeRoots roots;
  NodeRow powers;
  bool known = false;
  for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
    const Bracket b{rule.t[i], rule.t[i + 1], values[i], values[i + 1]};
    const bool crosses = (b.value_from < 0) != (b.value_to < 0);
    if (!crosses && std::min(std::abs(b.value_from), std::abs(b.value_to)) > slack) {
      continue;
    }
    if (!known) {
      powers = powers_of(rule, values);
      known = true;
    }
    if (crosses) {
      roots.t[roots.count++] = root_in(rule, powers, b);
      continue;
    }
    const double t = nearest_to_zero(rule, powers, b);
    const double value = value_at(rule, powers, t);
    if (t > b.from && (value < 0) != (b.value_from < 0)) {
      roots.t[roots.count++] = root_in(rule, powers, {b.from, t, b.value_from, value});
      roots.t[roots.count++] = root_in(rule, powers, {t, b.to, value, b.value_to});
    }
  }
  return roots;
}

}  // namespace trochoid::force
