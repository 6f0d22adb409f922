#include <trochoid/force/node_pieces.h>

#include <trochoid/force/node_kernel.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <boost/math/quadrature/gauss.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace trochoid::force {
namespace {

/// @brief Chips over all marks at the nodes of a panel: which marks count between them.
struct NodeMarks {
  const NodeChips& chips;
  const NodeRule& rule;
  double slack;  ///< how far a chip may bend between two nodes [m]

  /// @brief Marks that may be the closest somewhere on the panel.
  /// @param[out] marks  numbers from 0 on
  void choose(std::vector<std::size_t>& marks) const;

  /// @brief Whether one of the marks alone leaves nothing between any two neighbours.
  [[nodiscard]] bool leave_air(std::span<const std::size_t> marks) const noexcept;

 private:
  [[nodiscard]] const double* over(std::size_t mark) const noexcept {
    return &chips.over[mark * rule.width];
  }
  [[nodiscard]] bool near_at_a_node(std::size_t mark) const noexcept;
  [[nodiscard]] bool may_be_between(std::size_t mark,
                                    std::span<const std::size_t> near) const noexcept;
};

bool NodeMarks::near_at_a_node(std::size_t mark) const noexcept {
  const double* h = over(mark);
  double nearest = h[0] - chips.least[0];
  for (std::size_t i = 1; i < rule.nodes; ++i) {
    nearest = std::min(nearest, h[i] - chips.least[i]);
  }
  return nearest <= slack;
}

/// A mark may be the closest between two nodes although it is so at neither: the closest
/// ones there lie above it where they change places.
bool NodeMarks::may_be_between(std::size_t mark,
                               std::span<const std::size_t> near) const noexcept {
  const double* h = over(mark);
  for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
    const bool below_another = std::ranges::any_of(near, [&](std::size_t k) {
      const double* other = over(k);
      const bool closest =
          other[i] == chips.least[i] || other[i + 1] == chips.least[i + 1];
      return closest && other[i] < h[i] - slack && other[i + 1] < h[i + 1] - slack;
    });
    if (!below_another) {
      return true;
    }
  }
  return false;
}

void NodeMarks::choose(std::vector<std::size_t>& marks) const {
  const std::size_t all = chips.over.size() / rule.width;
  marks.clear();
  for (std::size_t m = 0; m < all; ++m) {
    if (near_at_a_node(m)) {
      marks.push_back(m);
    }
  }
  const std::size_t near = marks.size();
  for (std::size_t m = 0; near > 1 && m < all; ++m) {
    if (std::ranges::find(marks, m) == marks.end() && may_be_between(m, marks)) {
      marks.push_back(m);
    }
  }
}

bool NodeMarks::leave_air(std::span<const std::size_t> marks) const noexcept {
  for (std::size_t i = 0; i + 1 < rule.nodes; ++i) {
    const bool air = std::ranges::any_of(marks, [&](std::size_t m) {
      return over(m)[i] < -slack && over(m)[i + 1] < -slack;
    });
    if (!air) {
      return false;
    }
  }
  return true;
}

// Along a panel the chip over one mark is a polynomial that its values at the nodes hold. What
// is no polynomial is the chip of the tooth: which mark is the closest, where the chip begins,
// and where the stock cuts it short. Those places are roots of what the nodes hold, found as
// breaks of the panel. Between two of them one mark counts, and the integral is a sum over the
// nodes, with weights by the antiderivatives of Lagrange's polynomials (area_at). Most panels
// have no break at all: one mark, thick everywhere and away from the edge of the stock, takes
// the weights of a whole panel.

/// One tooth on one panel.
struct Look {
  const NodePanels& all;
  const NodePanel& panel;
  const NodeChips& chips;
  NodeScratch& scratch;

  [[nodiscard]] const NodeRule& rule() const noexcept { return *all.rule; }
  [[nodiscard]] bool exact() const noexcept {
    return all.passage.model.model == chip::Model::trochoidal;
  }
  [[nodiscard]] const double* over(std::size_t mark) const noexcept {
    return &chips.over[mark * rule().width];
  }
  /// The polynomial through some values at a place.
  [[nodiscard]] double at(const NodeRow& basis, const double* values) const noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < rule().nodes; ++i) {
      sum += basis[i] * values[i];
    }
    return sum;
  }
};

void add_breaks(const Look& look, const double* values, double slack) {
  const NodeRoots roots = roots_of(look.rule(), values, slack);
  look.scratch.breaks.insert(
      look.scratch.breaks.end(), roots.t.begin(),
      roots.t.begin() + static_cast<std::ptrdiff_t>(roots.count));
}

void add_mark_breaks(const Look& look) {
  NodeRow& difference = look.scratch.difference;
  const auto& marks = look.scratch.marks;
  for (std::size_t a = 0; a < marks.size(); ++a) {
    add_breaks(look, look.over(marks[a]), look.panel.slack);
    for (std::size_t b = 0; b < a; ++b) {
      for (std::size_t i = 0; i < look.rule().nodes; ++i) {
        difference[i] = look.over(marks[a])[i] - look.over(marks[b])[i];
      }
      add_breaks(look, difference.data(), look.panel.slack);
    }
  }
}

/// Where the edge, and the end of each mark on its ray, pass the edge of the stock.
void add_stock_breaks(const Look& look, double y) {
  if (!std::isfinite(y)) {
    return;
  }
  NodeRow& beyond = look.scratch.difference;
  const NodeRow& cosine = look.chips.chip_cosine;
  const std::size_t n = look.rule().nodes;
  for (std::size_t i = 0; i < n; ++i) {
    beyond[i] = look.chips.radius[i] * cosine[i] - y;
  }
  add_breaks(look, beyond.data(), look.panel.stock_slack);
  if (!look.exact()) {
    return;
  }
  for (const std::size_t m : look.scratch.marks) {
    for (std::size_t i = 0; i < n; ++i) {
      beyond[i] = (look.chips.radius[i] - look.over(m)[i]) * cosine[i] - y;
    }
    add_breaks(look, beyond.data(), look.panel.stock_slack);
  }
}

/// @brief The edge at one place of a panel.
struct Place {
  double least = 0.0;  ///< chip over the closest mark [m]
  std::size_t mark = 0;
  double radius = 0.0;
  double sine = 0.0;
  double cosine = 0.0;
};

Place place_at(const Look& look, const NodeRow& basis) noexcept {
  Place p{.least = 1e300};
  const auto at = [&](const double* values) { return look.at(basis, values); };
  for (const std::size_t m : look.scratch.marks) {
    const double h = at(look.over(m));
    if (h < p.least) {
      p.least = h;
      p.mark = m;
    }
  }
  p.radius = at(look.chips.radius.data());
  p.sine = at(look.chips.chip_sine.data());
  p.cosine = at(look.chips.chip_cosine.data());
  return p;
}

struct Clipped {
  double h = 0.0;
  bool by_stock = false;
};

/// C-7: what the stock leaves of a chip.
Clipped clip(const Look& look, const Place& p) noexcept {
  const geometry::Band& stock = look.all.passage.stock;
  const double y = p.radius * p.cosine;
  if (!look.exact()) {
    const bool inside = p.sine > 0 && y > stock.y_lo && y < stock.y_hi;
    return {inside ? p.least : 0.0, false};
  }
  double inner = p.radius - p.least;
  double outer = p.radius;
  for (const double side : {1.0, -1.0}) {  // y >= y_lo, and then -y >= -y_hi
    const double edge = side > 0 ? stock.y_lo : -stock.y_hi;
    const double c = side * p.cosine;
    if (edge > 0) {
      inner = c > 0 ? std::max(inner, edge / c) : p.radius;
    } else if (c < 0) {
      outer = std::min(outer, edge / c);
    }
  }
  const bool by_stock = inner > p.radius - p.least || outer < p.radius;
  return {by_stock ? outer - inner : p.least, by_stock};
}

/// Where the stock cuts the chip short h is no polynomial: Gauss' nodes between.
void add_clipped(const Look& look, double from, double to, NodeWeights& weights) {
  const numerics::KronrodRule& gauss = numerics::kronrod_rule();
  const double half = 0.5 * (to - from);
  for (std::size_t k = 0; k < gauss.t.size(); ++k) {
    if (gauss.gauss[k] == 0) {
      continue;
    }
    const NodeRow basis = basis_at(look.rule(), from + half * (1 + gauss.t[k]));
    const double h = clip(look, place_at(look, basis)).h * half * gauss.gauss[k];
    for (std::size_t i = 0; i < look.rule().nodes; ++i) {
      weights.chip[i] += h * basis[i];
    }
  }
}

/// Gauss' nodes and weights on (0, 1), crowded where a chip begins or ends.
struct PowerRule {
  std::size_t places = 0;
  PowerRow t{};
  PowerRow weight{};
};

/// What of an end is near zero.
enum class ThinEnd { none, first, last, both };

template <unsigned points, class Map>
PowerRule mapped(const Map& map) {
  using Gauss = boost::math::quadrature::gauss<double, points>;
  PowerRule rule;
  const auto add = [&](double x, double weight) {
    const auto [t, slope] = map(0.5 * (1 + x));
    rule.t[rule.places] = t;
    rule.weight[rule.places++] = 0.5 * weight * slope;
  };
  for (std::size_t k = 0; k < Gauss::abscissa().size(); ++k) {
    add(Gauss::abscissa()[k], Gauss::weights()[k]);
    if (Gauss::abscissa()[k] != 0) {
      add(-Gauss::abscissa()[k], Gauss::weights()[k]);
    }
  }
  return rule;
}

/// A chip that begins grows like the distance from there, and its power 1 - m has no
/// slope: in the third root of the distance it is smooth enough.
const PowerRule& power_rule(ThinEnd thin) {
  using Place = std::pair<double, double>;  // and its slope
  static const std::array<PowerRule, 4> rules = {
      mapped<10>([](double v) {
        return Place{v, 1.0};
      }),
      mapped<15>([](double v) {
        return Place{v * v * v, 3 * v * v};
      }),
      mapped<15>([](double v) {
        const double u = 1 - v;
        return Place{1 - u * u * u, 3 * u * u};
      }),
      mapped<20>([](double v) {
        return Place{v * v * v * (10 - v * (15 - 6 * v)),
                     30 * v * v * (1 - v) * (1 - v)};
      })};
  return rules[static_cast<std::size_t>(thin)];
}

/// One mark bounds the chip between two places, or the stock does.
struct MarkPiece {
  double from = 0.0;
  double to = 0.0;
  std::size_t mark = 0;
  bool by_stock = false;
};

/// What F-2 takes the power of, times h_0: the chip across the edge.
double chip_across(const Look& look, const MarkPiece& s, double t) noexcept {
  const NodeRow basis = basis_at(look.rule(), t);
  const double h = s.by_stock ? clip(look, place_at(look, basis)).h
                              : look.at(basis, look.over(s.mark));
  return h * look.at(basis, look.chips.edge->sin_kappa.data());
}

/// Where the chip begins or ends, or the edge lies flat, as at the tip of a corner.
ThinEnd thin_end(const Look& look, const MarkPiece& s) noexcept {
  constexpr double thin = 0.3;  // of the middle
  const bool whole = s.from == -1 && s.to == 1 && !s.by_stock;
  const auto at = [&](std::size_t node, double t) {
    return whole ? look.over(s.mark)[node] * look.chips.edge->sin_kappa[node]
                 : chip_across(look, s, t);
  };
  const std::size_t end = look.rule().nodes - 1;
  const double middle = thin * at(end / 2, 0.5 * (s.from + s.to));
  const bool first = at(0, s.from) < middle;
  const bool last = at(end, s.to) < middle;
  return first ? (last ? ThinEnd::both : ThinEnd::first)
               : (last ? ThinEnd::last : ThinEnd::none);
}

/// Under a power law: h^(1 - m) is no polynomial through its values at the nodes, and the
/// frame and the edge still are.
void add_power(const Look& look, const MarkPiece& s, NodeWeights& weights) {
  const PowerRule& rule = power_rule(thin_end(look, s));
  const double length = s.to - s.from;
  PowerRow t{};
  PowerRow across{};
  for (std::size_t g = 0; g < power_room; ++g) {
    t[g] = s.from + length * rule.t[g];
  }
  if (s.by_stock) {
    for (std::size_t g = 0; g < rule.places; ++g) {
      across[g] = chip_across(look, s, t[g]);
    }
  } else {
    chips_across(look.rule(), look.over(s.mark), look.chips.edge->sin_kappa.data(), t,
                 across);
  }
  add_powers(look.rule(),
             {look.all.form.m, t, across, rule.weight, rule.places, length},
             weights.power);
}

/// @param w  weights of the nodes for a polynomial on the piece
void add_piece(const Look& look, const MarkPiece& s, const NodeRow& w,
               NodeWeights& weights) {
  for (std::size_t i = 0; i < w.size(); ++i) {
    weights.edge[i] += w[i];
  }
  if (look.all.form.power) {
    add_power(look, s, weights);
  } else if (s.by_stock) {
    add_clipped(look, s.from, s.to, weights);
  } else {
    for (std::size_t i = 0; i < look.rule().nodes; ++i) {
      weights.chip[i] += w[i] * look.over(s.mark)[i];
    }
  }
}

void add_pieces(const Look& look, NodeWeights& weights) {
  std::vector<double>& breaks = look.scratch.breaks;
  std::sort(breaks.begin(), breaks.end());
  breaks.push_back(1.0);
  double from = -1.0;
  NodeRow before = area_at(look.rule(), from);
  for (const double to : breaks) {
    if (!(to - from > 1e-14)) {
      continue;
    }
    const Place p = place_at(look, basis_at(look.rule(), 0.5 * (from + to)));
    const Clipped chip = clip(look, p);
    NodeRow after = area_at(look.rule(), to);
    NodeRow w;
    for (std::size_t i = 0; i < w.size(); ++i) {
      w[i] = after[i] - before[i];
    }
    if (chip.h > chip::h_threshold) {
      add_piece(look, {from, to, p.mark, chip.by_stock}, w, weights);
    }
    from = to;
    before = after;
  }
}

enum class Inside { everywhere, nowhere, partly };

/// Where the nodes lie by y, or by the front of the tool for the simplified models.
/// @param thickest  chip at the nodes [m]
Inside inside_stock(const Look& look, double thickest) noexcept {
  const geometry::Band& stock = look.all.passage.stock;
  const double far = look.panel.stock_slack;
  // A chip lies between the edge and its mark: more than a feed where others are short.
  const double thick =
      look.exact() ? std::max(look.all.passage.feed * 7, thickest + look.panel.slack)
                   : 0.0;
  bool all_in = true;
  bool low = true;
  bool high = true;
  bool behind = !look.exact();
  for (std::size_t i = 0; i < look.rule().nodes; ++i) {
    const double y = look.chips.radius[i] * look.chips.chip_cosine[i];
    all_in = all_in && y > stock.y_lo + far + thick && y < stock.y_hi - far - thick;
    low = low && y < stock.y_lo - far - thick;
    high = high && y > stock.y_hi + far + thick;
    if (!look.exact()) {
      const double x = look.chips.radius[i] * look.chips.chip_sine[i];
      all_in = all_in && x > far;
      behind = behind && x < -far;
    }
  }
  return low || high || behind ? Inside::nowhere
                               : (all_in ? Inside::everywhere : Inside::partly);
}

}  // namespace

bool weigh(const NodePanels& all, const NodePanel& panel, const NodeChips& chips,
           NodeScratch& scratch, NodeWeights& weights) {
  const Look look{all, panel, chips, scratch};
  const auto n = static_cast<std::ptrdiff_t>(all.rule->nodes);
  const auto [least, most] =
      std::minmax_element(chips.least.begin(), chips.least.begin() + n);
  const Inside inside = all.at_stock_edge || !look.exact() ? inside_stock(look, *most)
                                                           : Inside::everywhere;
  if (inside == Inside::nowhere) {
    return false;
  }
  const NodeMarks marks{chips, *all.rule, panel.slack};
  marks.choose(scratch.marks);
  if (*most < -panel.slack && marks.leave_air(scratch.marks)) {
    return false;
  }
  weights = {};
  if (inside == Inside::everywhere && *least > panel.slack &&
      scratch.marks.size() == 1) {
    add_piece(look, {-1.0, 1.0, scratch.marks.front(), false}, all.rule->whole,
              weights);
    return true;
  }
  scratch.breaks.clear();
  add_mark_breaks(look);
  if (inside == Inside::partly) {
    add_stock_breaks(look, all.passage.stock.y_lo);
    add_stock_breaks(look, all.passage.stock.y_hi);
    if (!look.exact()) {
      add_breaks(look, chips.chip_sine.data(), panel.stock_slack);
    }
  }
  add_pieces(look, weights);
  return true;
}

}  // namespace trochoid::force
