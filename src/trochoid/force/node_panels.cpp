#include <trochoid/force/node_panels.h>

#include <trochoid/base/units.h>

#include <trochoid/force/any_edges.h>
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

/// Radii of the teeth on a panel, and how far they lie apart.
struct Radii {
  double least = 0.0;  ///< above 0 [m]
  double most = 0.0;   ///< [m]
  double aside =
      0.0;  ///< how far the axis of the edges stands off that of rotation [m]
  double apart = 0.0;    ///< of one tooth and another, at most [m]
  double behind = 0.0;   ///< least angle to the tooth before [rad]
  bool at_axis = false;  ///< some of the panel is next to the axis
};

/// How far behind the side of the tool, as a sine, a chip may still be found.
double rear_sine(const chip::Passage& passage, const Radii& radii) {
  if (passage.model.model != chip::Model::trochoidal) {
    return 0.0;
  }
  const double f = passage.feed * unit::turn;
  if (passage.model.lookback == chip::Lookback::all) {
    return 1.2 * f / (2 * radii.least);  // its own mark of one turn before
  }
  return 1.3 * (radii.apart + f * f / (2 * radii.least)) /
         (passage.feed * radii.behind);
}

/// Angles theta between which there may be a chip; wide.
void limit(const chip::Passage& passage, const Radii& radii, NodePanel& panel) {
  const double lo = radii.least;
  const double epsilon = radii.at_axis ? pi : 1.1 * radii.aside / lo + 1e-9;
  const double sine = radii.at_axis ? 1.0 : rear_sine(passage, radii);
  if (!(sine < 0.5) || !(epsilon < 0.5)) {
    panel.centre = 0.0;
    panel.reach = 4.0;
    return;
  }
  const double behind = std::asin(sine) + epsilon;
  const double f = passage.feed * unit::turn;
  const double inner = std::max(lo - radii.aside - 1.2 * f, 0.1 * lo);
  const double outer = radii.most + radii.aside;
  const double y_lo = passage.stock.y_lo;
  const double y_hi = passage.stock.y_hi;
  const double c_lo = std::clamp(y_lo > 0 ? y_lo / outer : y_lo / inner, -1.0, 1.0);
  const double c_hi = std::clamp(y_hi < 0 ? y_hi / outer : y_hi / inner, -1.0, 1.0);
  double from = std::acos(c_hi) - epsilon;
  double to = std::acos(c_lo) + epsilon;
  from = from > behind ? from : -behind;
  to = pi - to > behind ? to : pi + behind;
  panel.centre = 0.5 * (from + to);
  panel.reach = 0.5 * (to - from);
}

Radii radii_of(const Edges& edges, const NodePanel& panel) {
  const NodeRow& r = panel.edges.front().r;
  const std::vector<double>& pitch = edges.setup.cutter.pitch;
  const double runout = reach_of(edges.setup.runout);
  Radii radii{.most = *std::max_element(r.begin(), r.end()),
              .aside = runout,
              .apart = 2 * runout,
              .behind = *std::min_element(pitch.begin(), pitch.end())};
  radii.least = radii.most;
  for (const double x : r) {
    radii.least = x > 0 ? std::min(radii.least, x) : radii.least;
  }
  radii.at_axis = !(radii.least > 0);
  return radii;
}

/// By the rows of the panel: what tooth is where, with runout.
Radii radii_of(const AnyEdges& any, const NodeRule& rule, const NodePanel& panel) {
  const geometry::Runout& runout = any.setup.runout;
  const double height =
      std::max(std::abs(panel.z[0]), std::abs(panel.z[rule.nodes - 1]));
  Radii radii{.least = 1e300,
              .aside = runout.eccentricity + height * std::tan(runout.tilt),
              .behind = unit::turn};
  for (const NodeTooth& tooth : panel.teeth) {
    const auto row = [&](std::size_t k, std::size_t i) {
      return tooth.rows[k * rule.width + i];
    };
    for (std::size_t i = 0; i < rule.nodes; ++i) {
      const double r = panel.edge_of(tooth).r[i];
      const double R = row(NodeTooth::radius, i);
      radii.least = std::min({radii.least, r, R});
      radii.most = std::max({radii.most, r, R});
      for (std::size_t m = 0; m < tooth.marks; ++m) {
        const std::size_t first = NodeTooth::first_mark + m * NodeTooth::rows_of_mark;
        radii.apart = std::max(radii.apart, std::abs(row(first + NodeTooth::apart, i)));
        radii.behind = std::min(radii.behind, row(first + NodeTooth::back, i));
      }
    }
  }
  // Between two nodes they reach a little farther.
  const double beyond = 0.1 * (radii.most - radii.least);
  radii.least -= beyond;
  radii.most += beyond;
  radii.at_axis = !(radii.least > 0);
  return radii;
}

/// @brief Whether the rule follows chips and edge along a panel.
class Resolution {
 public:
  Resolution(const NodePanels& all, const Setup& setup, double tolerance)
      : all_(all), differ_(!edges_alike(setup)) {
    const double gap =
        *std::max_element(setup.cutter.pitch.begin(), setup.cutter.pitch.end());
    allowed_ = std::max({tolerance * (all.passage.feed * gap),
                         panel_rounding * reach_of(setup.runout),
                         rounding_of_radius * setup.cutter.profile.D / 2});
    allowed_edge_ = tolerance;
  }

  /// @param slack  by how much a panel may err more than all of the edge
  bool enough(const NodePanel& panel, double slack = 1.0) {
    constexpr int angles = 6;
    slack_ = slack;
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
    const NodeRow& lean = chips_.edge->cos_kappa;
    for (const NodeRow* side : {&chips_.sine, &chips_.cosine}) {
      if (!follows(panel, [&](std::size_t i) { return (*side)[i]; })) return false;
      // Along a serration the profile waves, and along other edges it does not.
      if (differ_ &&
          !follows(panel, [&](std::size_t i) { return (*side)[i] * lean[i]; })) {
        return false;
      }
    }
    return true;
  }

  /// The edge and chips over each mark, times a part of the frame.
  template <class Factor>
  [[nodiscard]] bool follows(const NodePanel& panel, const Factor& factor) const {
    const NodeEdge& edge = *chips_.edge;
    if (left_out([&](std::size_t i) { return factor(i) * edge.edge[i] / panel.half; }) >
        slack_ * allowed_edge_) {
      return false;
    }
    for (std::size_t m = 0; m < chips_.over.size(); m += all_.rule->width) {
      const double* h = &chips_.over[m];
      if (left_out([&](std::size_t i) {
            return factor(i) * edge.width[i] / panel.half * h[i];
          }) > slack_ * allowed_) {
        return false;
      }
    }
    return true;
  }

  const NodePanels& all_;
  bool differ_;
  double allowed_ = 0.0;
  double allowed_edge_ = 0.0;
  double slack_ = 1.0;
  NodeChips chips_;
};

int newton_steps(double feed, double least_radius) {
  const double bend = feed / std::max(least_radius, 1e-9);
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
  Resolution resolution(all, edges.setup, tolerance);
  const double shortest = 1e-4 * end;
  for (double from = all.begin; !ends.empty();) {
    NodePanel panel = node_panel(edges, *all.rule, from, ends.back());
    panel.steps = newton_steps(
        edges.passage.feed,
        std::min(edges.point(from).meridian.r, edges.point(panel.to).meridian.r));
    limit(edges.passage, radii_of(edges, panel), panel);
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

namespace {

/// A place in a zone.
struct PlaceInZones {
  std::size_t zone = 0;
  double t = 0.0;
};

/// @brief The lowest place above which all teeth are far enough from the axis for marks by
/// series; beyond all zones: nowhere.
PlaceInZones begin_of_panels(const AnyEdges& any) {
  const geometry::Runout& runout = any.setup.runout;
  const bool exact = any.passage.model.model == chip::Model::trochoidal;
  const auto far = [&](const Zone& zone, double t) {
    const double z = zone.from + zone.beyond(t);
    const double aside = runout.eccentricity + std::abs(z) * std::tan(runout.tilt);
    const double least =
        exact ? std::max(any.passage.feed / largest_bend, 8 * aside) : 8 * aside;
    for (std::size_t j = 0; j < zone.there.size(); ++j) {
      if (zone.there[j] == 0) continue;
      const geometry::EdgeAt at = any.edges.edge_at(j, zone.from, zone.beyond(t));
      if (!(std::min(at.r, at.position.R) >= least + aside)) return false;
    }
    return true;
  };
  for (std::size_t k = any.zones.size(); k-- > 0;) {
    const Zone& zone = any.zones[k];
    for (std::size_t i = zone.grid.size(); i-- > 0;) {
      if (far(zone, zone.grid[i])) continue;
      if (i + 1 == zone.grid.size()) return {k + 1, 0.0};
      double lo = zone.grid[i];
      double hi = zone.grid[i + 1];
      for (int step = 0; step < 40; ++step) {
        (far(zone, 0.5 * (lo + hi)) ? hi : lo) = 0.5 * (lo + hi);
      }
      return {k, hi};
    }
  }
  return {};
}

/// A panel that is short may err by so much more: all panels together by what is allowed.
double slack_of(const NodePanel& panel, double height) {
  constexpr double panels = 16;
  return std::max(1.0, height / (panels * 2 * panel.half));
}

/// Teeth that stand nearly on one ray pass one another.
constexpr double crossing = 1e-3;  // [rad]

/// @brief Cut a zone into panels.
/// @return whether chips are smooth along all of them
bool add_panels(const AnyEdges& any, const Zone& zone, double begin,
                Resolution& resolution, NodePanels& all) {
  constexpr double shortest = 1e-4;
  constexpr double longest = 0.3;  // of a wave: what a rule does not see looks smooth
  const double wave = any.edges.wavelength() > 0 ? longest * any.edges.wavelength()
                                                 : zone.to - zone.from;
  if (std::ranges::count(zone.there, 1) == 0) {
    return true;
  }
  const double height = any.zones.back().to - any.zones.front().from;
  std::vector<double> ends = {1.0};  // descending: the next one last
  for (double from = begin; !ends.empty();) {
    NodePanel panel = node_panel(any, *all.rule, zone, from, ends.back());
    const Radii radii = radii_of(any, *all.rule, panel);
    if (any.passage.model.model == chip::Model::trochoidal && radii.behind < crossing) {
      return false;
    }
    panel.steps = newton_steps(any.passage.feed, radii.least);
    limit(any.passage, radii, panel);
    const bool finest = panel.to - panel.from < shortest;
    const bool too_long = 2 * panel.half_turn > longest_panel ||
                          zone.beyond(panel.to) - zone.beyond(from) > wave;
    if (!finest && (too_long || !resolution.enough(panel, slack_of(panel, height)))) {
      ends.push_back(0.5 * (panel.from + panel.to));
      continue;
    }
    from = panel.to;
    ends.pop_back();
    all.panels.push_back(std::move(panel));
  }
  return true;
}

}  // namespace

std::optional<NodePanels> node_panels(const AnyEdges& any, double tolerance) {
  if (any.passage.feed <= 0 || any.passage.by_arcs || any.zones.empty()) {
    return std::nullopt;
  }
  const PlaceInZones begin = begin_of_panels(any);
  if (begin.zone >= any.zones.size()) {
    return std::nullopt;
  }
  NodePanels all{.passage = any.passage,
                 .rule = &node_rule(tolerance),
                 .at_stock_edge = std::isfinite(any.passage.stock.y_lo) ||
                                  std::isfinite(any.passage.stock.y_hi)};
  const Zone& first = any.zones[begin.zone];
  all.begin = first.from + first.beyond(begin.t);
  Resolution resolution(all, any.setup, tolerance);
  for (std::size_t k = begin.zone; k < any.zones.size(); ++k) {
    const double from = k == begin.zone ? begin.t : 0.0;
    if (!add_panels(any, any.zones[k], from, resolution, all)) {
      return std::nullopt;
    }
  }
  return all;
}

}  // namespace trochoid::force
