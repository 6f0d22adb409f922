#include <trochoid/base/units.h>
#include <trochoid/surface/edge_nodes.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace trochoid::surface {

namespace {

/// How closely the nodes follow chips, relative to the feed.
constexpr double at_nodes = 1e-9;
/// A bent edge enters and leaves so much earlier and later than a straight one [rad].
constexpr double bent_reach = 0.3;
/// What the deflection bends between two nodes, as a part of how much it changes.
constexpr double bend_between = 0.05;

/// Barycentric weights of any points; their scale is free.
template <class Row>
void set_weights(std::span<const double> at, Row& place, Row& weight) {
  place.fill(1e3);
  weight.fill(0.0);
  for (std::size_t i = 0; i < at.size(); ++i) {
    double product = 1.0;
    for (std::size_t k = 0; k < at.size(); ++k) {
      product *= k == i ? 1.0 : 2 * (at[i] - at[k]);
    }
    place[i] = at[i];
    weight[i] = 1 / product;
  }
}

bool is_cylinder(const force::NodePanel& panel, std::size_t nodes) {
  const force::NodeRow& r = panel.edges.front().r;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (std::abs(r[i] - r[0]) > 1e-12 * r[0]) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::shared_ptr<const EdgeNodes> EdgeNodes::make(const force::Edges& edges,
                                                 const force::Form& form,
                                                 const numerics::LagrangeBasis& basis) {
  if (form.power || basis.size() > point_room) {
    return nullptr;
  }
  auto panels = force::node_panels(edges, at_nodes);
  if (!panels || panels->begin > 0) {
    return nullptr;
  }
  EdgeNodes nodes;
  nodes.all_ = std::move(*panels);
  nodes.points_ = basis.size();
  const force::NodeRule& rule = *nodes.all_.rule;
  set_weights(std::span(rule.t).first(rule.nodes), nodes.rule_.node,
              nodes.rule_.node_weight);
  const double a_p = edges.setup.cut.a_p;
  std::vector<double> points;
  for (const double z : basis.points()) {
    points.push_back(2 * z / a_p - 1);
  }
  set_weights(points, nodes.rule_.point, nodes.rule_.point_weight);
  for (const force::NodePanel& from : nodes.all_.panels) {
    if (!is_cylinder(from, rule.nodes)) {
      return nullptr;
    }
    const double low = from.z[0];
    const double high = from.z[rule.nodes - 1];
    Panel panel{.middle = (low + high) / a_p - 1,
                .half = (high - low) / a_p,
                .height = 0.5 * (high - low)};
    panel.edge = form.edge ? from.edges.front().edge[0] / panel.height : 0.0;
    panel.shares.resize(rule.nodes * point_room);
    for (std::size_t i = 0; i < rule.nodes; ++i) {
      const double lag = edges.point(from.z[i]).lag;
      panel.cosine[i] = std::cos(lag);
      panel.sine[i] = std::sin(lag);
      basis.weights(from.z[i],
                    std::span(panel.shares).subspan(i * point_room, basis.size()));
    }
    nodes.panels_.push_back(std::move(panel));
  }
  return std::make_shared<const EdgeNodes>(std::move(nodes));
}

/// One tooth on one panel, at one spindle angle.
class EdgeNodes::Look {
 public:
  explicit Look(const EdgeNodes& nodes)
      : nodes_(nodes), all_(nodes.all_), rule_(*nodes.all_.rule) {
    chips_.over.resize(static_cast<std::size_t>(all_.passage.marks) * rule_.width);
  }

  // six parameters: an angle as such and as sine and cosine, where to look, the bend
  void add(double phi, std::size_t panel, std::size_t tooth, const NodeBend* bend,
           MomentSums& sums) {
    panel_ = &all_.panels[panel];
    const force::NodeTooth& rows = panel_->teeth[tooth];
    const double theta = phi + rows.middle - panel_->centre;
    const double off = theta - unit::turn * std::floor(theta / unit::turn + 0.5);
    const double reach =
        panel_->reach + panel_->half_turn + (bend != nullptr ? bent_reach : 0.0);
    if (std::abs(off) > reach) {
      return;
    }
    force::node_chips(all_, *panel_, rows, {std::sin(phi), std::cos(phi)}, chips_);
    for (std::size_t m = 0; m < static_cast<std::size_t>(all_.passage.marks); ++m) {
      std::fill(over(m) + rule_.nodes, over(m) + rule_.width, 0.0);  // no nodes
    }
    slack_ = panel_->slack;
    shift_.fill(0.0);
    if (bend != nullptr) {
      give_way(phi, panel, tooth, *bend);
    }
    find_across(bend != nullptr, &rows.rows[force::NodeTooth::radius * rule_.width]);
    if (!find_marks() || !in_stock()) {
      return;
    }
    find_breaks();
    const Panel& place = nodes_.panels_[panel];
    const ToothRows seen{.sine = chips_.sine.data(),
                         .cosine = chips_.cosine.data(),
                         .radius = chips_.radius.data(),
                         .shift = shift_.data(),
                         .stock = {all_.passage.stock.y_lo, all_.passage.stock.y_hi},
                         .middle = place.middle,
                         .half = place.half,
                         .height = place.height,
                         .edge = place.edge};
    add_stretches(seen, sums);
  }

 private:
  /// What bounds the chip on a stretch.
  struct State {
    bool in_cut = false;
    std::size_t mark = 0;
    bool by_stock = false;
    bool operator==(const State&) const = default;
  };

  [[nodiscard]] bool exact() const noexcept {
    return all_.passage.model.model == chip::Model::trochoidal;
  }
  [[nodiscard]] double* over(std::size_t mark) noexcept {
    return &chips_.over[mark * rule_.width];
  }

  /// Shift of the axis, and what chips over marks gain by it (E-10).
  void give_way(double phi, std::size_t panel, std::size_t tooth,
                const NodeBend& bend) {
    const Panel& here = nodes_.panels_[panel];
    const std::size_t points = nodes_.points_;
    const auto at = [&](std::size_t i, std::span<const double> values) {
      const double* shares = &here.shares[i * point_room];
      double sum = 0.0;
      for (std::size_t q = 0; q < points; ++q) {
        sum += shares[q] * values[q];
      }
      return sum;
    };
    double least = 1e300;
    double most = -1e300;
    const std::size_t teeth = all_.psi.size();
    const double tip = phi - all_.psi[tooth];
    const double c = std::cos(tip);
    const double s = std::sin(tip);
    for (std::size_t i = 0; i < rule_.nodes; ++i) {
      shift_[i] = at(i, bend.shift);
      least = std::min(least, shift_[i]);
      most = std::max(most, shift_[i]);
      if (bend.before.empty()) {
        continue;
      }
      const double cosine = c * here.cosine[i] + s * here.sine[i];
      for (std::size_t m = 0; m < static_cast<std::size_t>(all_.passage.marks); ++m) {
        const double then =
            at(i, bend.before.subspan((tooth * teeth + m) * points, points));
        over(m)[i] += cosine * (shift_[i] - then);
      }
    }
    slack_ += bend_between * (most - least);
    for (std::size_t i = 0; !bend.before.empty() && i < rule_.nodes; ++i) {
      chips_.least[i] = over(0)[i];
      for (std::size_t m = 1; m < static_cast<std::size_t>(all_.passage.marks); ++m) {
        chips_.least[i] = std::min(chips_.least[i], over(m)[i]);
      }
    }
  }

  /// y of the edge, for the simple models by the radius that they take.
  /// @param own_radius  of the tooth at the nodes [m]
  void find_across(bool bent, const double* own_radius) {
    const bool own = bent && all_.passage.model.model == chip::Model::radial;
    for (std::size_t i = 0; i < rule_.nodes; ++i) {
      const double R = exact() ? chips_.radius[i]
                       : own   ? own_radius[i]
                               : chips_.edge->r[i];
      window_[i] = R;
      across_[i] = R * chips_.chip_cosine[i] + shift_[i];
    }
  }

  /// Whether m lies behind another mark between two neighbours.
  [[nodiscard]] bool hidden(std::size_t m, std::size_t i) noexcept {
    const double* h = over(m);
    for (std::size_t k = 0; k < static_cast<std::size_t>(all_.passage.marks); ++k) {
      if (k != m && over(k)[i] < h[i] - slack_ && over(k)[i + 1] < h[i + 1] - slack_) {
        return true;
      }
    }
    return false;
  }

  /// Marks that may be the closest somewhere. @return false: there is air everywhere
  bool find_marks() {
    bool air = true;
    for (std::size_t i = 0; air && i + 1 < rule_.nodes; ++i) {
      bool below = false;
      for (std::size_t m = 0; m < static_cast<std::size_t>(all_.passage.marks); ++m) {
        below = below || (over(m)[i] < -slack_ && over(m)[i + 1] < -slack_);
      }
      air = below;
    }
    if (air) {
      return false;
    }
    marks_.clear();
    for (std::size_t m = 0; m < static_cast<std::size_t>(all_.passage.marks); ++m) {
      for (std::size_t i = 0; i + 1 < rule_.nodes; ++i) {
        if (!hidden(m, i)) {
          marks_.push_back(m);
          break;
        }
      }
    }
    return true;
  }

  /// The thickest chip at the nodes, over the closest mark [m].
  [[nodiscard]] double thickest() noexcept {
    double most = 0.0;
    for (std::size_t i = 0; i < rule_.nodes; ++i) {
      double least = std::numeric_limits<double>::infinity();
      for (const std::size_t m : marks_) least = std::min(least, over(m)[i]);
      most = std::max(most, least);
    }
    return most;
  }

  /// Whether some of the nodes may lie in the stock.
  [[nodiscard]] bool in_stock() noexcept {
    const geometry::Band& stock = all_.passage.stock;
    const double thick =
        exact() ? std::max(7 * all_.passage.feed, thickest() + slack_) : 0.0;
    const double far = panel_->stock_slack + slack_ + thick;
    bool low = true;
    bool high = true;
    bool behind = !exact();
    for (std::size_t i = 0; i < rule_.nodes; ++i) {
      low = low && across_[i] < stock.y_lo - far;
      high = high && across_[i] > stock.y_hi + far;
      behind = behind && window_[i] * chips_.chip_sine[i] < -far;
    }
    return !low && !high && !behind;
  }

  void add_roots(const double* values, double slack) {
    const force::NodeRoots roots = force::roots_of(rule_, values, slack);
    breaks_.insert(breaks_.end(), roots.t.begin(),
                   roots.t.begin() + static_cast<std::ptrdiff_t>(roots.count));
  }

  void add_stock_roots(double y) {
    if (!std::isfinite(y)) {
      return;
    }
    const double slack = panel_->stock_slack + slack_;
    for (std::size_t i = 0; i < rule_.nodes; ++i) {
      difference_[i] = across_[i] - y;
    }
    add_roots(difference_.data(), slack);
    for (std::size_t k = 0; exact() && k < marks_.size(); ++k) {
      const double* h = over(marks_[k]);
      for (std::size_t i = 0; i < rule_.nodes; ++i) {
        difference_[i] = across_[i] - h[i] * chips_.chip_cosine[i] - y;
      }
      add_roots(difference_.data(), slack);
    }
  }

  void find_breaks() {
    breaks_.clear();
    for (std::size_t a = 0; a < marks_.size(); ++a) {
      add_roots(over(marks_[a]), slack_);
      for (std::size_t b = 0; b < a; ++b) {
        for (std::size_t i = 0; i < rule_.nodes; ++i) {
          difference_[i] = over(marks_[a])[i] - over(marks_[b])[i];
        }
        add_roots(difference_.data(), slack_);
      }
    }
    add_stock_roots(all_.passage.stock.y_lo);
    add_stock_roots(all_.passage.stock.y_hi);
    if (!exact()) {
      add_roots(chips_.chip_sine.data(), panel_->stock_slack);
    }
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.push_back(1.0);
  }

  [[nodiscard]] State state_at(double t) noexcept {
    const force::NodeRow basis = force::basis_at(rule_, t);
    const auto at = [&](const double* values) {
      double sum = 0.0;
      for (std::size_t i = 0; i < rule_.nodes; ++i) {
        sum += basis[i] * values[i];
      }
      return sum;
    };
    State state;
    double least = 1e300;
    for (const std::size_t m : marks_) {
      const double h = at(over(m));
      if (h < least) {
        least = h;
        state.mark = m;
      }
    }
    const geometry::Band& stock = all_.passage.stock;
    const double cosine = at(chips_.chip_cosine.data());
    const double y = at(across_.data());
    if (!exact()) {
      const bool inside =
          at(chips_.chip_sine.data()) > 0 && y > stock.y_lo && y < stock.y_hi;
      state.in_cut = inside && least > chip::h_threshold;
      return state;
    }
    const double radius = at(chips_.radius.data());
    const double shift = at(shift_.data());
    double inner = radius - least;
    double outer = radius;
    for (const double side : {1.0, -1.0}) {  // y >= y_lo, and then -y >= -y_hi
      const double edge = side > 0 ? stock.y_lo - shift : shift - stock.y_hi;
      const double c = side * cosine;
      if (edge > 0) {
        inner = c > 0 ? std::max(inner, edge / c) : radius;
      } else if (c < 0) {
        outer = std::min(outer, edge / c);
      }
    }
    state.by_stock = inner > radius - least || outer < radius;
    state.in_cut = (state.by_stock ? outer - inner : least) > chip::h_threshold;
    return state;
  }

  void add_stretches(const ToothRows& seen, MomentSums& sums) {
    double from = -1.0;
    double to = -1.0;
    State open;
    const auto close = [&] {
      if (open.in_cut && to > from) {
        add_stretch(nodes_.rule_, seen,
                    {.over = over(open.mark),
                     .from = from,
                     .to = to,
                     .by_stock = open.by_stock},
                    sums);
      }
    };
    for (const double end : breaks_) {
      if (!(end - to > 1e-14)) {
        continue;
      }
      const State state = state_at(0.5 * (to + end));
      if (state != open) {
        close();
        from = to;
        open = state;
      }
      to = end;
    }
    close();
  }

  const EdgeNodes& nodes_;
  const force::NodePanels& all_;
  const force::NodeRule& rule_;
  const force::NodePanel* panel_ = nullptr;
  force::NodeChips chips_;
  force::NodeRow shift_{};
  force::NodeRow window_{};  ///< radius that meets the stock [m]
  force::NodeRow across_{};  ///< y of the edge [m]
  force::NodeRow difference_{};
  double slack_ = 0.0;  ///< how far a chip may bend between two nodes [m]
  std::vector<std::size_t> marks_;
  std::vector<double> breaks_;
};

void EdgeNodes::at(double phi, const NodeBend* bend, MomentSums& sums) const {
  sums = {};
  Look look(*this);
  for (std::size_t panel = 0; panel < panels_.size(); ++panel) {
    for (std::size_t tooth = 0; tooth < all_.psi.size(); ++tooth) {
      look.add(phi, panel, tooth, bend, sums);
    }
  }
}

}  // namespace trochoid::surface
