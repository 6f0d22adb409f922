#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

/// Cutting an interval where a curve switches from one smooth branch to another.
namespace trochoid::numerics {

/// @brief An interval on which one branch of a curve is active.
template <class State>
struct Piece {
  double from = 0.0;
  double to = 0.0;
  State state;  ///< anywhere inside
};

/// @brief A curve that is smooth while the branch of its state stays the same.
///
/// `state(x)` has `bool active()`, `int branch()` and `double margin()`, which is
/// continuous, and negative where nothing is active. `boundary(x, a, b)` changes sign
/// where the branch of a hands over to that of b; it need not be defined elsewhere.
template <class Curve>
class PieceFinder {
 public:
  using State = decltype(std::declval<const Curve&>().state(0.0));

  /// @param resolution  break points are found to this accuracy, in units of x
  PieceFinder(const Curve& curve, double resolution)
      : curve_(curve), resolution_(resolution) {}

  /// @brief The active pieces between the ends of a grid.
  /// @param[in] grid ascending; between neighbours a
  /// branch hides only if it peaks there
  /// @param[out] pieces  ascending, not overlapping; cleared first
  void find(std::span<const double> grid, std::vector<Piece<State>>& pieces) {
    sample(grid);
    look_for_hidden_peaks();
    breaks_.clear();
    for (std::size_t i = 0; i + 1 < nodes_.size(); ++i) {
      refine(nodes_[i], nodes_[i + 1], 0);
    }
    collect(pieces);
  }

 private:
  struct Node {
    double x;
    State state;
  };
  struct Break {
    double x;
    State before;
    State after;
  };

  static bool same(const State& a, const State& b) {
    return a.active() == b.active() && (!a.active() || a.branch() == b.branch());
  }

  void sample(std::span<const double> grid) {
    nodes_.clear();
    for (const double x : grid) {
      nodes_.push_back({x, curve_.state(x)});
    }
  }

  /// A short cut between two grid points in air, or a gap between two in cut, shows as
  /// a peak of the margin towards the other side.
  void look_for_hidden_peaks() {
    const std::size_t n = nodes_.size();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      follow_peak(nodes_[i - 1], nodes_[i], nodes_[i + 1]);
    }
    // Within the outermost intervals: does the margin rise from the end?
    if (n > 1) {
      constexpr double step = 1e-3;
      const Node first = nodes_[0];
      const Node second = nodes_[1];
      follow_peak(first, node(first.x + step * (second.x - first.x)), second);
      const Node last = nodes_[n - 1];
      const Node before = nodes_[n - 2];
      follow_peak(before, node(last.x - step * (last.x - before.x)), last);
    }
    if (nodes_.size() > n) {
      std::sort(nodes_.begin(), nodes_.end(),
                [](const Node& p, const Node& q) { return p.x < q.x; });
    }
  }

  [[nodiscard]] Node node(double x) const { return {x, curve_.state(x)}; }

  /// Climb to the peak of the margin at b, towards the other side, as long as it may
  /// reach there. Where marks take over from one another the peak is a kink, so that
  /// only a section search gets to its top.
  void follow_peak(Node a, Node b, Node c) {
    const bool active = b.state.active();
    if (a.state.active() != active || c.state.active() != active) {
      return;
    }
    const double sign = active ? -1.0 : 1.0;
    const auto height = [sign](const Node& p) { return sign * p.state.margin(); };
    if (!(height(b) >= height(a) && height(b) >= height(c)) ||
        height(a) + height(c) == 2 * height(b)) {
      return;
    }
    constexpr double golden = 0.381966011250105;
    for (int i = 0; i < 40 && c.x - a.x > resolution_; ++i) {
      const double rise = std::max((height(b) - height(a)) / (b.x - a.x) * (c.x - b.x),
                                   (height(b) - height(c)) / (c.x - b.x) * (b.x - a.x));
      if (height(b) + 3 * rise < 0) {
        return;
      }
      double x = vertex(a, b, c);
      if (i % 2 == 1 || !(x > a.x && x < c.x && x != b.x)) {
        x = c.x - b.x > b.x - a.x ? b.x + golden * (c.x - b.x)
                                  : b.x - golden * (b.x - a.x);
      }
      const bool right = x > b.x;
      const Node peak = node(x);
      if (peak.state.active() != active) {
        nodes_.push_back(peak);
        return;
      }
      const bool higher = height(peak) > height(b);
      if (right) {
        (higher ? a : c) = higher ? b : peak;
      } else {
        (higher ? c : a) = higher ? b : peak;
      }
      b = higher ? peak : b;
    }
  }

  static double vertex(const Node& a, const Node& b, const Node& c) {
    const double p = (b.x - a.x) * (b.state.margin() - c.state.margin());
    const double q = (b.x - c.x) * (b.state.margin() - a.state.margin());
    return b.x - 0.5 * ((b.x - a.x) * p - (b.x - c.x) * q) / (p - q);
  }

  void refine(const Node& a, const Node& b, int depth) {
    if (same(a.state, b.state)) {
      return;
    }
    if (b.x - a.x <= 2 * resolution_ || depth > 200) {
      breaks_.push_back({0.5 * (a.x + b.x), a.state, b.state});
      return;
    }
    double x = 0.5 * (a.x + b.x);
    // At a jump the rule creeps up from one side: then halving it is.
    if (depth < 10 && hand_over(a, b, x)) {
      const double step = std::min(resolution_, 0.25 * (b.x - a.x));
      const Node before{std::max(x - step, a.x), curve_.state(std::max(x - step, a.x))};
      const Node after{std::min(x + step, b.x), curve_.state(std::min(x + step, b.x))};
      if (same(before.state, a.state) && same(after.state, b.state)) {
        breaks_.push_back({x, a.state, b.state});
        return;
      }
      refine(a, before, depth + 1);
      refine(before, after, depth + 1);
      refine(after, b, depth + 1);
      return;
    }
    const Node middle{x, curve_.state(x)};
    refine(a, middle, depth + 1);
    refine(middle, b, depth + 1);
  }

  /// Root of the boundary function by the Illinois
  /// rule; false where it does not bracket.
  bool hand_over(const Node& a, const Node& b, double& x) const {
    double lo = a.x;
    double hi = b.x;
    double g_lo = curve_.boundary(lo, a.state, b.state);
    double g_hi = curve_.boundary(hi, a.state, b.state);
    if (!std::isfinite(g_lo) || !std::isfinite(g_hi) || (g_lo < 0) == (g_hi < 0)) {
      return false;
    }
    int kept = 0;  // end that stayed in the last step: -1 low, 1 high
    for (int i = 0; i < 60; ++i) {
      x = (lo * g_hi - hi * g_lo) / (g_hi - g_lo);
      if (!(x > lo && x < hi)) {
        x = 0.5 * (lo + hi);
      }
      const double g = curve_.boundary(x, a.state, b.state);
      if (!std::isfinite(g)) {
        return false;
      }
      const bool left = (g < 0) == (g_lo < 0);
      const double moved = left ? x - lo : hi - x;
      if (left) {
        lo = x;
        g_lo = g;
        g_hi *= kept == 1 ? 0.5 : 1.0;
      } else {
        hi = x;
        g_hi = g;
        g_lo *= kept == -1 ? 0.5 : 1.0;
      }
      kept = left ? 1 : -1;
      if (moved <= 0.1 * resolution_ || hi - lo <= resolution_ || g == 0) {
        return true;
      }
    }
    return false;
  }

  void collect(std::vector<Piece<State>>& pieces) const {
    pieces.clear();
    double from = nodes_.front().x;
    State state = nodes_.front().state;
    for (const Break& b : breaks_) {
      if (state.active() && b.x > from) {
        pieces.push_back({from, b.x, state});
      }
      from = b.x;
      state = b.after;
    }
    if (state.active() && nodes_.back().x > from) {
      pieces.push_back({from, nodes_.back().x, state});
    }
  }

  const Curve& curve_;
  double resolution_;
  std::vector<Node> nodes_;
  std::vector<Break> breaks_;
};

}  // namespace trochoid::numerics
