#include <trochoid/force/edge_meetings.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

constexpr int scan_points = 256;
constexpr int halvings = 50;

/// @brief All teeth about the axis of rotation.
class Ring {
 public:
  explicit Ring(const Edges& edges) : edges_(edges), teeth_(edges.psi.size()) {}

  void stand_at(double s) {
    const EdgePoint p = edges_.point(s);
    geometry::edge_positions(edges_.setup.runout, edges_.psi, p.meridian.r, p.lag,
                             teeth_);
  }

  /// How far tooth k is ahead of tooth j, in [-pi, pi] [rad].
  [[nodiscard]] double ahead(std::size_t j, std::size_t k) const noexcept {
    return std::remainder(
        edges_.psi[j] - edges_.psi[k] + teeth_[k].epsilon - teeth_[j].epsilon,
        unit::turn);
  }

 private:
  const Edges& edges_;
  std::vector<geometry::EdgePosition> teeth_;
};

/// Beyond it the eccentricity turns no tooth past another.
double end_of_meetings(const Edges& edges) {
  const auto& pitch = edges.setup.cutter.pitch;
  const double gap = *std::min_element(pitch.begin(), pitch.end());
  const double far =
      edges.setup.runout.eccentricity / std::sin(0.5 * std::min(gap, std::numbers::pi));
  double lo = 0.0;
  double hi = edges.ends.back();
  for (int i = 0; i < halvings && edges.point(hi).meridian.r > far; ++i) {
    const double s = 0.5 * (lo + hi);
    (edges.point(s).meridian.r > far ? hi : lo) = s;
  }
  return hi;
}

double meeting_between(Ring& ring, std::size_t j, std::size_t k, double lo, double hi) {
  ring.stand_at(lo);
  const bool behind = ring.ahead(j, k) < 0;
  for (int i = 0; i < halvings; ++i) {
    const double s = 0.5 * (lo + hi);
    ring.stand_at(s);
    ((ring.ahead(j, k) < 0) == behind ? lo : hi) = s;
  }
  return 0.5 * (lo + hi);
}

/// Pairs of teeth, the angle between them for each.
std::vector<double> all_ahead(const Ring& ring, std::size_t teeth) {
  std::vector<double> angles;
  for (std::size_t j = 0; j < teeth; ++j) {
    for (std::size_t k = j + 1; k < teeth; ++k) {
      angles.push_back(ring.ahead(j, k));
    }
  }
  return angles;
}

}  // namespace

std::vector<std::vector<double>> meetings(const Edges& edges) {
  const std::size_t teeth = edges.psi.size();
  std::vector<std::vector<double>> out(teeth);
  if (edges.setup.chip.model != chip::Model::trochoidal || teeth == 1 ||
      edges.setup.runout.eccentricity == 0 || edges.point(0.0).meridian.r > 0) {
    return out;
  }
  Ring ring(edges);
  const double end = end_of_meetings(edges);
  const auto place = [&](int i) {
    const double t = static_cast<double>(i) / scan_points;
    return end * t * t;
  };
  double from = place(1);  // on the axis all teeth stand in one point
  ring.stand_at(from);
  std::vector<double> before = all_ahead(ring, teeth);
  for (int i = 2; i <= scan_points; ++i) {
    const double to = place(i);
    ring.stand_at(to);
    const std::vector<double> after = all_ahead(ring, teeth);
    std::size_t pair = 0;
    for (std::size_t j = 0; j < teeth; ++j) {
      for (std::size_t k = j + 1; k < teeth; ++k, ++pair) {
        // A change of sign at half a turn is no meeting.
        if ((before[pair] < 0) != (after[pair] < 0) &&
            std::abs(after[pair] - before[pair]) < std::numbers::pi) {
          const double s = meeting_between(ring, j, k, from, to);
          out[j].push_back(s);
          out[k].push_back(s);
        }
      }
    }
    from = to;
    before = after;
  }
  return out;
}

}  // namespace trochoid::force
