#include "node_panel.h"

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

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

/// @param teeth  where all teeth stand at the height of the node
void fill_marks(const Edges& edges, std::span<const geometry::EdgePosition> teeth,
                std::size_t j, const Column& at) {
  const chip::Model model = edges.setup.chip.model;
  const std::size_t N = teeth.size();
  for (std::size_t m = 1; m <= static_cast<std::size_t>(edges.passage.marks); ++m) {
    const geometry::EdgePosition& other = teeth[(j + N - m % N) % N];
    const double back = edges.passage.back[j * N + m - 1];
    const bool turned = model == chip::Model::trochoidal && m != N;
    const std::size_t row = NodeTooth::first_mark + (m - 1) * NodeTooth::rows_of_mark;
    at[row + NodeTooth::apart] = teeth[j].R - other.R;
    at[row + NodeTooth::back] =
        back + (turned ? other.epsilon - teeth[j].epsilon : 0.0);
    at[row + NodeTooth::mark_radius] = other.R;
    at[row + NodeTooth::bend] = edges.passage.feed / other.R;
    simplify(model, edges.passage.feed * back, at[row + NodeTooth::apart],
             at[row + NodeTooth::back]);
  }
}

void fill_tooth(const Edges& edges, std::span<const geometry::EdgePosition> teeth,
                std::size_t j, double lag, const Column& at) {
  const double angle = -edges.psi[j] - lag;
  const double turned = angle + teeth[j].epsilon;
  const bool exact = edges.setup.chip.model == chip::Model::trochoidal;
  at[NodeTooth::cosine] = std::cos(turned);
  at[NodeTooth::sine] = std::sin(turned);
  at[NodeTooth::chip_cosine] = std::cos(exact ? turned : angle);
  at[NodeTooth::chip_sine] = std::sin(exact ? turned : angle);
  at[NodeTooth::radius] = teeth[j].R;
  fill_marks(edges, teeth, j, at);
}

void fill_nodes(const Edges& edges, const NodeRule& rule, NodePanel& panel) {
  const double half = 0.5 * (panel.to - panel.from);
  std::vector<geometry::EdgePosition> teeth(edges.psi.size());
  for (std::size_t i = 0; i < rule.nodes; ++i) {
    const double s = std::clamp(0.5 * (panel.from + panel.to) + half * rule.t[i],
                                panel.from, std::nextafter(panel.to, panel.from));
    const EdgePoint point = edges.point(s);
    panel.r[i] = point.meridian.r;
    panel.z[i] = point.meridian.z;
    panel.sin_kappa[i] = point.meridian.sin_kappa;
    panel.cos_kappa[i] = point.meridian.cos_kappa;
    panel.width[i] = half * point.meridian.sin_kappa;
    panel.edge[i] = half * point.dS;
    geometry::edge_positions(edges.setup.runout, edges.psi, point.meridian.r, point.lag,
                             teeth);
    for (std::size_t j = 0; j < panel.teeth.size(); ++j) {
      fill_tooth(edges, teeth, j, point.lag, {panel.teeth[j], rule.width, i});
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
  const double least_r = std::min(panel.r[0], panel.r[rule.nodes - 1]);
  const double curved = least_r > 0.5 * f ? 1 + 2 * f / least_r : 5.0;
  panel.slack = bend * curved * (f + 2 * reach_of(edges.setup.runout)) + 1e-14;
  panel.stock_slack = bend * p.D + 1e-12;
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
  NodePanel panel{.from = from, .to = to};
  const auto marks = static_cast<std::size_t>(edges.passage.marks);
  const std::size_t rows = NodeTooth::first_mark + marks * NodeTooth::rows_of_mark;
  panel.teeth.resize(edges.psi.size());
  for (NodeTooth& tooth : panel.teeth) {
    tooth.rows.assign(rows * rule.width, 1.0);
  }
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

}  // namespace trochoid::force
