#include <trochoid/force/tip_force.h>

#include <trochoid/base/units.h>
#include <trochoid/force/tip_kernel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>

namespace trochoid::force {

namespace {

constexpr std::size_t places = 8;  ///< that are looked at together
/// Panels grow by this from the axis; near to it, where next to nothing is left, faster.
constexpr double growth = 2.0;
constexpr double fast_growth = 4.0;
constexpr double begin_of_growth = 0.06;  ///< of the tip
/// What is nearer to the axis is left out, and places are known to this, of the tolerance.
constexpr double left_out = 0.03;
constexpr double known_to = 0.1;
/// Gaps between places are this narrow before a straight line leads to where marks change.
constexpr double straight = 1e-3;
/// A peak of the margin is followed where it may rise so much more than it seems to.
constexpr double safety = 3.0;
/// Panels end so much before what jumps there.
constexpr double beside = 1e-8;
/// Panels are no shorter than this, as a part of how far out they lie.
constexpr double shortest_share = 8 * beside;
/// The teeth are known at least so well, as sines.
constexpr double loosest = 1e-3;
/// Nodes of the rule with eight.
constexpr double rule_of_eight = 1e-6;

/// Rows of a panel that a force needs.
enum PanelRow { sin_kappa, cos_kappa, height, edge, panel_rows };

/// Angles between a tooth and the one that left a mark, in (0, turn] and without a jump
/// along the panel: on which side of each other they stand, its middle says.
void unwrap(NodePanel& panel, const NodePanels& all) {
  const std::size_t width = all.rule->width;
  const auto marks = static_cast<std::size_t>(all.passage.marks);
  for (NodeTooth& tooth : panel.teeth) {
    for (std::size_t m = 0; m + 1 < all.psi.size() && m < marks; ++m) {
      double* back = &tooth.rows[(NodeTooth::first_mark + m * NodeTooth::rows_of_mark +
                                  NodeTooth::back) *
                                 width];
      const double raw = back[all.rule->nodes / 2];
      const double middle = raw - unit::turn * (std::ceil(raw / unit::turn) - 1);
      for (std::size_t i = 0; i < all.rule->nodes; ++i) {
        back[i] += unit::turn * std::round((middle - back[i]) / unit::turn);
      }
    }
  }
}

/// Where the edge has a radius.
double place_of(const Edges& edges, double r) {
  double lo = 0.0;
  double hi = edges.ends.back();
  for (int i = 0; i < 60; ++i) {
    const double s = 0.5 * (lo + hi);
    (edges.point(s).meridian.r < r ? lo : hi) = s;
  }
  return 0.5 * (lo + hi);
}

/// Where panels end, from the axis outwards.
std::vector<double> panel_ends(const Edges& edges, double least) {
  const double end = edges.ends.back();
  std::vector<double> ends;
  double s = end;
  while (s > least) {
    ends.push_back(s);
    s /= s > begin_of_growth * end ? growth : fast_growth;
  }
  ends.push_back(least);
  for (const auto& of_tooth : edges.meetings) {
    for (const double at : of_tooth) {
      if (at > least && at < end) ends.push_back(at);
    }
  }
  for (const double at : edges.ends) {
    if (at > least && at < end) ends.push_back(at);
  }
  // Up to there a shorter tooth is not there at all.
  for (const double offset : edges.setup.runout.radial_offsets) {
    if (offset < 0) ends.push_back(std::clamp(place_of(edges, -offset), least, end));
  }
  std::sort(ends.begin(), ends.end());
  const auto same = [&](double a, double b) { return b - a < 1e-3 * least; };
  ends.erase(std::unique(ends.begin(), ends.end(), same), ends.end());
  return ends;
}

std::vector<NodeRow> powers_of_rows(const NodeRule& rule,
                                    const std::vector<double>& rows) {
  std::vector<NodeRow> out;
  for (std::size_t at = 0; at + rule.width <= rows.size(); at += rule.width) {
    out.push_back(powers_of(rule, &rows[at]));
  }
  return out;
}

/// Whether polynomials lead to where the teeth stand at the nodes of one half of their
/// panel: where a tooth comes near the axis, it turns fast.
/// @param middle  of the half, from -1 to 1
/// @param close   of sines and relative radii
bool follow(const NodeRule& rule, const std::vector<std::vector<NodeRow>>& powers,
            const NodePanel& half, double middle, double close) {
  for (std::size_t j = 0; j < powers.size(); ++j) {
    for (std::size_t i = 0; i < rule.nodes; ++i) {
      const double t = middle + 0.5 * rule.t[i];
      const auto off = [&](std::size_t row) {
        return std::abs(value_at(rule, powers[j][row], t) -
                        half.teeth[j].rows[row * rule.width + i]);
      };
      const double R = half.teeth[j].rows[NodeTooth::radius * rule.width + i];
      if (off(NodeTooth::cosine) > close || off(NodeTooth::sine) > close ||
          off(NodeTooth::radius) > close * std::abs(R)) {
        return false;
      }
    }
  }
  return true;
}

bool stock_reaches(const Edges& edges, double reach) {
  const geometry::Band& stock = edges.passage.stock;
  return stock.y_lo > -reach || stock.y_hi < reach;
}

/// Whether a function that is nearest to zero in the middle of three places, or at one of
/// two where the middle is an end, may pass through zero between them.
/// @param steps  between the places; 0: there is no place on that side
bool may_cross(const std::array<double, 3>& value, const std::array<double, 2>& steps) {
  const double sign = value[1] < 0 ? 1.0 : -1.0;
  const double left = sign * (value[1] - value[0]);
  const double right = sign * (value[1] - value[2]);
  if (left < 0 || right < 0) {
    return false;
  }
  double rise = std::max(left, right);
  if (steps[0] > 0 && steps[1] > 0) {
    rise = std::max(left / steps[0] * steps[1], right / steps[1] * steps[0]);
  }
  return sign * value[1] + safety * rise >= 0;
}

}  // namespace

std::optional<TipForce> TipForce::make(const Setup& setup, const Law& law,
                                       double tolerance) {
  const Edges edges(setup, tolerance);
  const double far = edges.point(edges.ends.back()).meridian.r + reach_of(setup.runout);
  if (setup.chip.model != chip::Model::trochoidal || edges.passage.by_arcs ||
      edges.passage.curvature != 0 || edges.passage.feed <= 0 ||
      stock_reaches(edges, 1.5 * far)) {
    return std::nullopt;
  }
  TipForce tip;
  tip.terms_ = terms(law);
  tip.panels_ = {.passage = edges.passage,
                 .psi = edges.psi,
                 .rule = &node_rule(rule_of_eight),
                 .form = form(law)};
  const double length = edges.ends.back();
  tip.resolution_ = known_to * tolerance * length;
  tip.allowed_ = known_to * tolerance * length * edges.passage.feed * unit::turn;
  const std::vector<double> ends = panel_ends(edges, left_out * tolerance * length);
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (ends[i + 1] - ends[i] > shortest_share * ends[i + 1]) {
      tip.add_panel(edges, ends[i], ends[i + 1]);
    }
  }
  return tip;
}

void TipForce::add_panel(const Edges& edges, double from, double to) {
  const NodeRule& rule = *panels_.rule;
  NodePanel panel = node_panel(edges, rule, from * (1 + beside), to * (1 - beside));
  // Its nodes stay clear of what jumps at its ends, and stand for the whole of it.
  const double whole = (to - from) / (panel.to - panel.from);
  panel.half *= whole;
  NodeEdge& edge = panel.edges.front();
  for (double& e : edge.edge) e *= whole;
  unwrap(panel, panels_);
  Powers powers;
  for (const NodeRow* row : {&edge.sin_kappa, &edge.cos_kappa, &panel.z, &edge.edge}) {
    powers.of_panel.push_back(powers_of(rule, row->data()));
  }
  for (const NodeTooth& tooth : panel.teeth) {
    powers.of_teeth.push_back(powers_of_rows(rule, tooth.rows));
  }
  const double middle = 0.5 * (panel.from + panel.to);
  const double close = std::min(loosest, resolution_ / to);
  const bool follows =
      follow(rule, powers.of_teeth, node_panel(edges, rule, panel.from, middle), -0.5,
             close) &&
      follow(rule, powers.of_teeth, node_panel(edges, rule, middle, panel.to), 0.5,
             close);
  if (!follows && to - from > std::max(2 * resolution_, 2 * shortest_share * to)) {
    add_panel(edges, from, middle);
    add_panel(edges, middle, to);
    return;
  }
  panels_.panels.push_back(std::move(panel));
  powers_.push_back(std::move(powers));
}

/// @brief Walks along all edges, one angle after the other.
class TipForce::Walk {
 public:
  explicit Walk(const TipForce& tip)
      : tip_(tip), marks_(static_cast<std::size_t>(tip.panels_.passage.marks)) {
    for (TipChips* one : {&chips_, &some_}) {
      one->chips.over.resize(marks_ * places);
      one->there.resize(marks_ * places);
    }
    rows_.rows.resize((NodeTooth::first_mark + marks_ * NodeTooth::rows_of_mark) *
                      places);
  }

  /// @param visit  takes an element, its chip [m], dS/ds and ds [m]
  template <class Visit>
  void at(double phi, const Visit& visit) {
    sine_cosine_ = {std::sin(phi), std::cos(phi)};
    for (std::size_t p = 0; p < tip_.panels_.panels.size(); ++p) {
      for (std::size_t j = 0; j < tip_.panels_.psi.size(); ++j) {
        add(p, j, visit);
      }
    }
  }

 private:
  /// What bounds the chip: a mark by its number, the axis after all marks.
  static constexpr std::size_t air = static_cast<std::size_t>(-1);

  struct Break {
    double t = 0.0;
    std::size_t after = air;
  };

  [[nodiscard]] std::size_t bound(const NodeChips& chips, std::size_t i) const {
    if (!(chips.least[i] > chip::h_threshold)) return air;
    for (std::size_t m = 0; m < marks_; ++m) {
      if (chips.over[m * places + i] == chips.least[i]) return m;
    }
    return marks_;
  }

  [[nodiscard]] std::array<std::size_t, places> bounds_of(
      const NodeChips& chips) const {
    std::array<std::size_t, places> out;
    for (std::size_t i = 0; i < places; ++i) {
      out[i] = bound(chips, i);
    }
    return out;
  }

  /// How far above a bound the edge is; over air: above the closest.
  [[nodiscard]] double above(const NodeChips& chips, std::size_t bound,
                             std::size_t i) const {
    if (bound == air) return chips.least[i];
    return bound < marks_ ? chips.over[bound * places + i] : chips.radius[i];
  }

  /// The chip where a bound is what the edge is above; where that mark ends, the closest.
  [[nodiscard]] double thickness(const TipChips& at, std::size_t bound,
                                 std::size_t i) const {
    const double h = above(at.chips, bound, i);
    return h < 0.5 * no_mark ? h : at.chips.least[i];
  }

  template <class Visit>
  void add(std::size_t p, std::size_t j, const Visit& visit) {
    panel_ = &tip_.panels_.panels[p];
    powers_ = &tip_.powers_[p];
    tooth_ = j;
    tip_chips(tip_.panels_, panel_->teeth[j], sine_cosine_, chips_);
    const Seen seen = seen_in(chips_, tip_.panels_.rule->t);
    breaks_.clear();
    find_breaks(tip_.panels_.rule->t, seen);
    if (breaks_.empty()) {
      if (seen.bounds.front() != air) add_whole(seen.bounds.front(), visit);
      return;
    }
    double from = -1.0;
    std::size_t bound = seen.bounds.front();
    breaks_.push_back({1.0, air});
    for (const Break& next : breaks_) {
      if (bound != air && next.t > from) {
        add_part(from, next.t, bound, visit);
      }
      from = next.t;
      bound = next.after;
    }
  }

  /// Whether a polynomial through the nodes follows the chip on a part of the panel.
  [[nodiscard]] bool follows(const TipChips& at, std::size_t bound, double half) const {
    double most = 0.0;
    for (const NodeRow& row : tip_.panels_.rule->tail) {
      double c = 0.0;
      for (std::size_t i = 0; i < places; ++i) {
        c += row[i] * thickness(at, bound, i);
      }
      most = std::max(most, std::abs(c));
    }
    const double steepest = std::max(panel_->edges.front().sin_kappa[0],
                                     panel_->edges.front().sin_kappa[places - 1]);
    return most * steepest * half * panel_->half <= tip_.allowed_;
  }

  template <class Visit>
  void add_whole(std::size_t bound, const Visit& visit) {
    if (!follows(chips_, bound, 1.0)) {
      add_part(-1.0, 0.0, bound, visit);
      add_part(0.0, 1.0, bound, visit);
      return;
    }
    const NodePanel& panel = *panel_;
    const NodeEdge& edge = panel.edges.front();
    for (std::size_t i = 0; i < places; ++i) {
      visit({.sine = chips_.chips.sine[i],
             .cosine = chips_.chips.cosine[i],
             .sin_kappa = edge.sin_kappa[i],
             .cos_kappa = edge.cos_kappa[i],
             .R = chips_.chips.radius[i],
             .z = panel.z[i]},
            thickness(chips_, bound, i), edge.edge[i] / panel.half,
            tip_.panels_.rule->whole[i] * panel.half);
    }
  }

  /// What is seen at eight places.
  struct Seen {
    std::array<std::size_t, places> bounds{};
    std::array<bool, places> hides{};  ///< whether something short may hide beside it
  };

  /// @param t  of the places, ascending
  template <class Places>
  [[nodiscard]] Seen seen_in(const TipChips& all, const Places& t) const {
    Seen seen{.bounds = bounds_of(all.chips)};
    for (std::size_t i = 0; i < places; ++i) {
      const std::size_t a = i > 0 ? i - 1 : i;
      const std::size_t c = std::min(i + 1, places - 1);
      seen.hides[i] = seen.bounds[a] == seen.bounds[i] &&
                      seen.bounds[c] == seen.bounds[i] &&
                      (t[c] - t[a]) * panel_->half > tip_.resolution_ &&
                      may_hide(all, {t[i] - t[a], t[c] - t[i]}, {a, i, c});
    }
    return seen;
  }

  /// @brief Whether something short may hide between three neighbours that look alike.
  ///
  /// A cut between places in air, or a gap between places in cut, shows as a peak of the
  /// margin towards the other side; a mark that is there for a short way only as one of
  /// what tells that it is.
  [[nodiscard]] bool may_hide(const TipChips& all, const std::array<double, 2>& steps,
                              const std::array<std::size_t, 3>& k) const {
    const auto crosses = [&](const double* row) {
      return may_cross({row[k[0]], row[k[1]], row[k[2]]}, steps);
    };
    if (crosses(all.chips.least.data())) {
      return true;
    }
    for (std::size_t m = 0; m < marks_; ++m) {
      if (crosses(&all.there[m * places])) return true;
    }
    return false;
  }

  /// @param t  of the places, ascending
  template <class Places>
  void find_breaks(const Places& t, const Seen& seen) {
    for (std::size_t i = 0; i < places; ++i) {
      const std::size_t before = i > 0 ? i - 1 : i;
      const std::size_t after = std::min(i + 1, places - 1);
      if (seen.hides[i]) {
        look_closer({t[before], t[after]}, {seen.bounds[before], seen.bounds[after]});
      }
      if (seen.bounds[i] != seen.bounds[after]) {
        narrow({t[i], t[after]}, {seen.bounds[i], seen.bounds[after]});
      }
    }
  }

  void look_closer(const std::array<double, 2>& t,
                   const std::array<std::size_t, 2>& ends) {
    const std::array<double, places> at = between(t);
    look(at);
    const Seen seen = seen_in(some_, at);
    if (seen.bounds.front() != ends[0]) {
      narrow({t[0], at.front()}, {ends[0], seen.bounds.front()});
    }
    find_breaks(at, seen);
    if (seen.bounds.back() != ends[1]) {
      narrow({at.back(), t[1]}, {seen.bounds.back(), ends[1]});
    }
  }

  [[nodiscard]] static std::array<double, places> between(
      const std::array<double, 2>& t) {
    std::array<double, places> at;
    for (std::size_t i = 0; i < places; ++i) {
      at[i] = t[0] + (t[1] - t[0]) * static_cast<double>(i + 1) / (places + 1);
    }
    return at;
  }

  /// Chips at eight places of the panel.
  void look(const std::array<double, places>& t) {
    tip_polynomials(powers_->of_teeth[tooth_], t.data(), rows_.rows.data());
    tip_chips(tip_.panels_, rows_, sine_cosine_, some_);
  }

  /// Find where what bounds the chip changes between two places.
  void narrow(std::array<double, 2> t, std::array<std::size_t, 2> bounds) {
    if ((t[1] - t[0]) * panel_->half <= tip_.resolution_) {
      breaks_.push_back({0.5 * (t[0] + t[1]), bounds[1]});
      return;
    }
    const std::array<double, places> at = between(t);
    look(at);
    const std::array<std::size_t, places> found = bounds_of(some_.chips);
    const double gap = (t[1] - t[0]) / (places + 1);
    if (gap < straight && gap * gap * panel_->half < 2 * tip_.resolution_ &&
        found[0] == bounds[0] && found[7] == bounds[1] && cross(at, found)) {
      return;
    }
    std::size_t before = bounds[0];
    double from = t[0];
    for (std::size_t i = 0; i <= places; ++i) {
      const double to = i < places ? at[i] : t[1];
      const std::size_t next = i < places ? found[i] : bounds[1];
      if (next != before) {
        narrow({from, to}, {before, next});
      }
      from = to;
      before = next;
    }
  }

  /// The only change between places, where two bounds cross; false: one of them jumps.
  bool cross(const std::array<double, places>& t,
             const std::array<std::size_t, places>& found) {
    std::size_t at = places;
    for (std::size_t i = 0; i + 1 < places; ++i) {
      if (found[i] != found[i + 1]) {
        if (at != places) return false;
        at = i;
      }
    }
    if (at == places) return false;
    const std::size_t p = found[at];
    const std::size_t q = found[at + 1];
    const auto gap = [&](std::size_t i) {
      if (p == air) return above(some_.chips, q, i);
      return q == air ? above(some_.chips, p, i)
                      : above(some_.chips, p, i) - above(some_.chips, q, i);
    };
    const double before = gap(at);
    const double after = gap(at + 1);
    if (!(std::abs(before) < 0.5 * no_mark && std::abs(after) < 0.5 * no_mark) ||
        (before < 0) == (after < 0)) {
      return false;
    }
    breaks_.push_back({t[at] + (t[at + 1] - t[at]) * before / (before - after), q});
    return true;
  }

  /// @param bound  of the chip on the part
  template <class Visit>
  void add_part(double from, double to, std::size_t bound, const Visit& visit) {
    const NodeRule& rule = *tip_.panels_.rule;
    const double middle = 0.5 * (from + to);
    const double half = 0.5 * (to - from);
    std::array<double, places> t;
    for (std::size_t i = 0; i < places; ++i) {
      t[i] = middle + half * rule.t[i];
    }
    look(t);
    if (!follows(some_, bound, half) && half * panel_->half > tip_.resolution_) {
      add_part(from, middle, bound, visit);
      add_part(middle, to, bound, visit);
      return;
    }
    std::array<double, panel_rows * places> rows;
    tip_polynomials(powers_->of_panel, t.data(), rows.data());
    for (std::size_t i = 0; i < places; ++i) {
      // At an end of the part rounding may leave none.
      const double h = std::max(thickness(some_, bound, i), chip::h_threshold);
      visit({.sine = some_.chips.sine[i],
             .cosine = some_.chips.cosine[i],
             .sin_kappa = rows[sin_kappa * places + i],
             .cos_kappa = rows[cos_kappa * places + i],
             .R = some_.chips.radius[i],
             .z = rows[height * places + i]},
            h, rows[edge * places + i] / panel_->half,
            rule.whole[i] * half * panel_->half);
    }
  }

  const TipForce& tip_;
  std::size_t marks_;
  std::array<double, 2> sine_cosine_{};
  const NodePanel* panel_ = nullptr;
  const Powers* powers_ = nullptr;
  std::size_t tooth_ = 0;
  TipChips chips_;
  TipChips some_;
  NodeTooth rows_;
  std::vector<Break> breaks_;
};

void TipForce::matrices(std::span<const double> phi,
                        std::span<AxialForce::Matrix> C) const {
  Walk walk(*this);
  const std::size_t columns = terms_.form.columns();
  for (std::size_t i = 0; i < phi.size(); ++i) {
    C[i] = {};
    walk.at(phi[i], [&](const Element& at, double h, double dS, double ds) {
      const ColumnWeights w = column_weights(terms_.form, h, at.sin_kappa, dS);
      for (std::size_t q = 0; q < 3; ++q) {
        const double pull = ds * w.cutting[q];
        const double push = ds * w.edge;
        std::array<double, 3> tra{};
        tra[q] = 1.0;
        SixLoads one{};
        add_loads(at, tra, one);
        for (std::size_t row = 0; row < 3; ++row) {
          C[i][row * columns + q] += one[row] * pull;
          if (columns > 3) C[i][row * columns + 3 + q] += one[row] * push;
        }
      }
    });
  }
}

void TipForce::loads(std::span<const double> phi, double gauge_length,
                     std::span<SixLoads> all) const {
  Walk walk(*this);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    all[i] = {};
    walk.at(phi[i], [&](Element at, double h, double dS, double ds) {
      const ColumnWeights w = column_weights(terms_.form, h, at.sin_kappa, dS);
      at.z -= gauge_length;
      add_loads(at,
                {ds * (terms_.K[0] * w.cutting[0] + terms_.K_e[0] * w.edge),
                 ds * (terms_.K[1] * w.cutting[1] + terms_.K_e[1] * w.edge),
                 ds * (terms_.K[2] * w.cutting[2] + terms_.K_e[2] * w.edge)},
                all[i]);
    });
  }
}

}  // namespace trochoid::force
