#include <trochoid/force/node_panels.h>

#include <trochoid/base/units.h>

#include <trochoid/force/node_kernel.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

using std::numbers::pi;
/// A panel turns by no more than this, along the edge and around the corner [rad].
constexpr double longest_panel = 1.3;
/// Marks by series need a radius of so many feeds per radian.
constexpr double largest_bend = 0.1;
/// Up to these the start of the series needs one or two of Newton's steps.
constexpr double bend_of_one_step = 0.005;
constexpr double bend_of_two_steps = 0.025;
constexpr int most_steps = 4;
/// Chips over marks are as large as the runout: no rule follows them better than to this
/// part of it, nor than radii are rounded, of which they are differences.
constexpr double panel_rounding = 1e-11;
constexpr double rounding_of_radius = 1e-15;

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
  const double runout = reach_of(edges.setup.runout);
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
    allowed_ = std::max({tolerance * (edges.passage.feed * gap),
                         panel_rounding * reach_of(edges.setup.runout),
                         rounding_of_radius * edges.setup.cutter.profile.D / 2});
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

int newton_steps(const Edges& edges, const NodePanel& panel) {
  const double r =
      std::min(edges.point(panel.from).meridian.r, edges.point(panel.to).meridian.r);
  const double bend = edges.passage.feed / std::max(r, 1e-9);
  if (bend <= bend_of_one_step) return 1;
  return bend <= bend_of_two_steps ? 2 : most_steps;
}

/// Where the edges are far enough from the axis for marks by series [m]; negative: nowhere.
double begin_of_panels(const Edges& edges) {
  const double runout = reach_of(edges.setup.runout);
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
                 .begin = begin_of_panels(edges),
                 .at_stock_edge = std::isfinite(edges.passage.stock.y_lo) ||
                                  std::isfinite(edges.passage.stock.y_hi)};
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
  Resolution resolution(all, edges, tolerance);
  const double shortest = 1e-4 * end;
  for (double from = all.begin; !ends.empty();) {
    NodePanel panel = node_panel(edges, *all.rule, from, ends.back());
    panel.steps = newton_steps(edges, panel);
    limit(panel, edges);
    const bool finest = panel.to - panel.from < shortest;
    if (!finest && (2 * panel.half_turn > longest_panel || !resolution.enough(panel))) {
      ends.push_back(0.5 * (panel.from + panel.to));
      continue;
    }
    from = panel.to;
    ends.pop_back();
    all.panels.push_back(std::move(panel));
  }
  return all;
}

}  // namespace trochoid::force
