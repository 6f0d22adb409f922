#include "node_panels.h"

#include <trochoid/base/units.h>

#include "node_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

constexpr double pi = std::numbers::pi;
/// A panel turns by no more than this, along the edge and around the corner [rad].
constexpr double longest_panel = 1.3;
/// Marks by series need a radius of so many feeds per radian.
constexpr double largest_bend = 0.1;
/// Up to these the start of the series needs one or two of Newton's steps.
constexpr double bend_of_one_step = 0.005;
constexpr double bend_of_two_steps = 0.025;
constexpr int most_steps = 4;

/// How far offsets and eccentricity move a tooth.
double reach_of_runout(const geometry::Runout& runout) {
  double most = 0.0;
  for (const double offset : runout.radial_offsets) {
    most = std::max(most, std::abs(offset));
  }
  return most + runout.eccentricity;
}

/// @brief Turns an edge point of a tooth into rows.
class Filler {
 public:
  Filler(const Edges& edges, const NodeRule& rule)
      : edges_(edges), rule_(rule), positions_(edges.psi.size()) {}

  void fill(NodePanel& panel) {
    const double half = 0.5 * (panel.to - panel.from);
    const auto marks = static_cast<std::size_t>(edges_.passage.marks);
    const std::size_t rows = NodeTooth::first_mark + marks * NodeTooth::rows_of_mark;
    panel.teeth.resize(edges_.psi.size());
    for (NodeTooth& tooth : panel.teeth) {
      tooth.rows.assign(rows * rule_.width, 1.0);
    }
    for (std::size_t i = 0; i < rule_.nodes; ++i) {
      const double s = std::clamp(0.5 * (panel.from + panel.to) + half * rule_.t[i],
                                  panel.from, std::nextafter(panel.to, panel.from));
      const EdgePoint point = edges_.point(s);
      panel.r[i] = point.meridian.r;
      panel.sin_kappa[i] = point.meridian.sin_kappa;
      panel.cos_kappa[i] = point.meridian.cos_kappa;
      panel.width[i] = half * point.meridian.sin_kappa;
      panel.edge[i] = half * point.dS;
      geometry::edge_positions(edges_.setup.runout, edges_.psi, point.meridian.r,
                               point.lag, positions_);
      for (std::size_t j = 0; j < panel.teeth.size(); ++j) {
        fill_tooth(panel.teeth[j], j, point.lag, i);
      }
    }
    const double begin = edges_.point(panel.from).lag;
    const double end = edges_.point(panel.to).lag;
    for (std::size_t j = 0; j < panel.teeth.size(); ++j) {
      panel.teeth[j].middle = -edges_.psi[j] - 0.5 * (begin + end);
    }
    panel.half_turn = 0.5 * (end - begin);
  }

 private:
  void fill_tooth(NodeTooth& tooth, std::size_t j, double lag, std::size_t i) {
    const auto at = [&](std::size_t row) -> double& {
      return tooth.rows[row * rule_.width + i];
    };
    const geometry::EdgePosition& own = positions_[j];
    const double angle = -edges_.psi[j] - lag;
    const double turned = angle + own.epsilon;
    const bool exact = edges_.setup.chip.model == chip::Model::trochoidal;
    at(NodeTooth::cosine) = std::cos(turned);
    at(NodeTooth::sine) = std::sin(turned);
    at(NodeTooth::chip_cosine) = std::cos(exact ? turned : angle);
    at(NodeTooth::chip_sine) = std::sin(exact ? turned : angle);
    at(NodeTooth::radius) = own.R;
    const auto teeth = edges_.psi.size();
    for (std::size_t m = 1; m <= static_cast<std::size_t>(edges_.passage.marks); ++m) {
      const geometry::EdgePosition& other = positions_[(j + teeth - m % teeth) % teeth];
      const double back = edges_.passage.back[j * teeth + m - 1];
      const std::size_t row = NodeTooth::first_mark + (m - 1) * NodeTooth::rows_of_mark;
      at(row + NodeTooth::apart) = own.R - other.R;
      at(row + NodeTooth::back) =
          back + (exact && m != teeth ? other.epsilon - own.epsilon : 0.0);
      at(row + NodeTooth::mark_radius) = other.R;
      at(row + NodeTooth::bend) = edges_.passage.feed / other.R;
      simplify(at, row, edges_.passage.feed * back);
    }
  }

  /// The simplified models are apart + back sin(theta).
  template <class At>
  void simplify(const At& at, std::size_t row, double feed) const {
    double& apart = at(row + NodeTooth::apart);
    double& slope = at(row + NodeTooth::back);
    switch (edges_.setup.chip.model) {
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

  const Edges& edges_;
  const NodeRule& rule_;
  std::vector<geometry::EdgePosition> positions_;
};

/// How far behind the side of the tool, as a sine, a chip may still be found.
double rear_sine(const Edges& edges, double r, double runout) {
  const chip::Passage& passage = edges.passage;
  if (edges.setup.chip.model != chip::Model::trochoidal) {
    return 0.0;
  }
  const double f = passage.feed * unit::turn;
  if (edges.setup.chip.lookback == chip::Lookback::all) {
    return 1.2 * f / (2 * r);  // its own mark of one turn before
  }
  const double least =
      passage.feed * *std::min_element(edges.setup.cutter.pitch.begin(),
                                       edges.setup.cutter.pitch.end());
  return 1.3 * (2 * runout + f * f / (2 * r)) / least;
}

/// Angles theta between which there may be a chip; wide.
void limit(NodePanel& panel, const Edges& edges) {
  const double runout = reach_of_runout(edges.setup.runout);
  const double hi = *std::max_element(panel.r.begin(), panel.r.end());
  double lo = hi;
  for (const double r : panel.r) {
    lo = r > 0 ? std::min(lo, r) : lo;
  }
  const double epsilon = lo > 0 ? 1.1 * runout / lo + 1e-9 : pi;
  const double sine = lo > 0 ? rear_sine(edges, lo, runout) : 1.0;
  if (!(sine < 0.5) || !(epsilon < 0.5)) {
    panel.centre = 0.0;
    panel.reach = 4.0;
    return;
  }
  const double behind = std::asin(sine) + epsilon;
  const double f = edges.passage.feed * unit::turn;
  const double inner = std::max(lo - runout - 1.2 * f, 0.1 * lo);
  const double outer = hi + runout;
  const double y_lo = edges.passage.stock.y_lo;
  const double y_hi = edges.passage.stock.y_hi;
  const double c_lo = std::clamp(y_lo > 0 ? y_lo / outer : y_lo / inner, -1.0, 1.0);
  const double c_hi = std::clamp(y_hi < 0 ? y_hi / outer : y_hi / inner, -1.0, 1.0);
  double from = std::acos(c_hi) - epsilon;
  double to = std::acos(c_lo) + epsilon;
  from = from > behind ? from : -behind;
  to = pi - to > behind ? to : pi + behind;
  panel.centre = 0.5 * (from + to);
  panel.reach = 0.5 * (to - from);
}

/// @brief Whether the rule follows chips and edge along a panel.
class Resolution {
 public:
  Resolution(const NodePanels& all, const Edges& edges, double tolerance)
      : all_(all), marks_(static_cast<std::size_t>(edges.passage.marks)) {
    const double gap = *std::max_element(edges.setup.cutter.pitch.begin(),
                                         edges.setup.cutter.pitch.end());
    allowed_ = tolerance * (edges.passage.feed * gap);
    allowed_edge_ = tolerance;
  }

  bool enough(const NodePanel& panel) {
    constexpr int angles = 6;
    chips_.over.resize(marks_ * all_.rule->width);
    for (std::size_t j = 0; j < panel.teeth.size(); ++j) {
      for (int k = 0; k < angles; ++k) {
        const double phi = panel.centre + panel.reach * (2 * k + 1 - angles) / angles -
                           panel.teeth[j].middle;
        node_chips(all_, panel, panel.teeth[j], {std::sin(phi), std::cos(phi)}, chips_);
        if (!follows(panel)) {
          return false;
        }
      }
    }
    return true;
  }

 private:
  /// Largest of the last two coefficients of a product of rows.
  template <class Value>
  [[nodiscard]] double left_out(const Value& value) const {
    double most = 0.0;
    for (const NodeRow& row : all_.rule->tail) {
      double c = 0.0;
      for (std::size_t i = 0; i < all_.rule->nodes; ++i) {
        c += row[i] * value(i);
      }
      most = std::max(most, std::abs(c));
    }
    return most;
  }

  [[nodiscard]] bool follows(const NodePanel& panel) const {
    const double half = 0.5 * (panel.to - panel.from);
    for (const NodeRow* side : {&chips_.sine, &chips_.cosine}) {
      if (left_out([&](std::size_t i) { return (*side)[i] * panel.edge[i] / half; }) >
          allowed_edge_) {
        return false;
      }
      for (std::size_t m = 0; m < marks_; ++m) {
        const double* h = &chips_.over[m * all_.rule->width];
        if (left_out([&](std::size_t i) {
              return (*side)[i] * panel.sin_kappa[i] * h[i];
            }) > allowed_) {
          return false;
        }
      }
    }
    return true;
  }

  const NodePanels& all_;
  std::size_t marks_;
  double allowed_ = 0.0;
  double allowed_edge_ = 0.0;
  NodeChips chips_;
};

void set_slack(NodePanel& panel, const Edges& edges, const NodeRule& rule) {
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
  panel.slack = bend * curved * (f + 2 * reach_of_runout(edges.setup.runout)) + 1e-14;
  panel.stock_slack = bend * p.D + 1e-12;
}

/// Where the edges are far enough from the axis for marks by series [m]; negative: nowhere.
double begin_of_panels(const Edges& edges) {
  const double runout = reach_of_runout(edges.setup.runout);
  const bool exact = edges.setup.chip.model == chip::Model::trochoidal;
  const double least =
      exact ? std::max(edges.passage.feed / largest_bend, 8 * runout) : 8 * runout;
  const auto far = [&](double s) {
    return edges.point(s).meridian.r - runout >= least;
  };
  const double end = edges.ends.back();
  if (!far(end)) {
    return -1.0;
  }
  if (far(0.0)) {
    return 0.0;
  }
  double lo = 0.0;
  double hi = end;
  for (int i = 0; i < 40; ++i) {
    (far(0.5 * (lo + hi)) ? hi : lo) = 0.5 * (lo + hi);
  }
  return hi;
}

}  // namespace

std::optional<NodePanels> node_panels(const Edges& edges, double tolerance) {
  NodePanels all{.passage = edges.passage,
                 .psi = edges.psi,
                 .rule = &node_rule(tolerance),
                 .begin = begin_of_panels(edges)};
  const double end = edges.ends.back();
  if (edges.passage.feed <= 0 || all.begin < 0 || !(all.begin < 0.9 * end)) {
    return std::nullopt;
  }
  std::vector<double> ends = {end};  // descending: the next one last
  for (const double corner : {edges.meridian.s_N, edges.meridian.s_M}) {
    if (corner > all.begin && corner < ends.back()) {
      ends.push_back(corner);
    }
  }
  Filler filler(edges, *all.rule);
  Resolution resolution(all, edges, tolerance);
  const double shortest = 1e-4 * end;
  for (double from = all.begin; !ends.empty();) {
    NodePanel panel{.from = from, .to = ends.back()};
    filler.fill(panel);
    const double least_r = std::min(panel.r[0], panel.r[all.rule->nodes - 1]);
    const double bend = edges.passage.feed / std::max(least_r, 1e-9);
    panel.steps = bend <= bend_of_one_step    ? 1
                  : bend <= bend_of_two_steps ? 2
                                              : most_steps;
    limit(panel, edges);
    const bool finest = panel.to - panel.from < shortest;
    if (!finest && (2 * panel.half_turn > longest_panel || !resolution.enough(panel))) {
      ends.push_back(0.5 * (panel.from + panel.to));
      continue;
    }
    set_slack(panel, edges, *all.rule);
    panel.at_stock_edge = std::isfinite(edges.passage.stock.y_lo) ||
                          std::isfinite(edges.passage.stock.y_hi);
    from = panel.to;
    ends.pop_back();
    all.panels.push_back(std::move(panel));
  }
  return all;
}

}  // namespace trochoid::force
