#include <trochoid/force/edge_curve.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace trochoid::force {
namespace {

/// Panels turn by no more than this, along the edge and around the corner [rad].
constexpr double longest_grid_panel = 0.7;
/// So near to a jump the edge is looked at, as a part of its length.
constexpr double relative_gap = 1e-12;
/// Grid points of a panel, beside its ends.
constexpr int inner_points = 4;
/// The same of an edge that begins at the axis, up to a feed of a turn from there.
constexpr int points_within_a_feed = 128;
/// The same for forces that need not be good to coarse_tolerance.
constexpr int few_points_within_a_feed = 40;
constexpr double coarse_tolerance = 1e-3;
/// Beyond, a step is about a tenth of the distance.
constexpr double log_step_beyond = 0.1;

double lag_between(const Setup& setup, const geometry::Meridian& m, double a,
                   double b) {
  return geometry::lag_at(setup.cutter, m, b).angle -
         geometry::lag_at(setup.cutter, m, a).angle;
}

std::vector<double> panel_ends(const Setup& setup, const geometry::Meridian& m) {
  const double last = geometry::arc_length_at(m, setup.cut.a_p);
  std::vector<double> corners = {0.0};
  for (const double s : {m.s_M, m.s_N}) {
    if (s > corners.back() && s < last) {
      corners.push_back(s);
    }
  }
  if (const auto* arcs = std::get_if<geometry::Arcs>(&setup.cut.engagement)) {
    for (const geometry::ArcLayer& layer : arcs->layers) {
      for (const double z : {layer.from, layer.to}) {
        if (z > 0 && z < setup.cut.a_p) {
          corners.push_back(geometry::arc_length_at(m, z));
        }
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  }
  corners.push_back(last);
  std::vector<double> ends = {0.0};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double a = corners[i];
    const double b = corners[i + 1];
    const bool arc = a >= m.s_M && b <= m.s_N;
    const double turned =
        std::max(lag_between(setup, m, a, b),
                 arc && m.profile.R > 0 ? (b - a) / m.profile.R : 0.0);
    const int count =
        std::max(1, static_cast<int>(std::ceil(turned / longest_grid_panel)));
    for (int k = 1; k <= count; ++k) {
      ends.push_back(k == count ? b : a + (b - a) * k / count);
    }
  }
  return ends;
}

/// Up to a feed of a turn from the axis, where nearly everything happens, and from there
/// in steps that grow with the distance.
void add_tip_grid(double end, double feed, double tolerance,
                  std::vector<double>& grid) {
  const double near = std::min(feed, end);
  const int points =
      tolerance > coarse_tolerance ? few_points_within_a_feed : points_within_a_feed;
  for (int k = 1; k <= points; ++k) {
    const double t = static_cast<double>(k) / points;
    grid.push_back(k == points ? near : near * t * t * t * t);
  }
  const double growth = std::log(end / near);
  const int count = static_cast<int>(std::ceil(growth / log_step_beyond));
  for (int k = 1; k <= count; ++k) {
    grid.push_back(k == count ? end : near * std::exp(growth * k / count));
  }
}

/// @param feed  of a turn, where the edge begins at the axis; else 0 [m]
std::vector<double> scan_grid(const std::vector<double>& ends, double feed,
                              double tolerance) {
  std::vector<double> grid = {ends.front()};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    if (i == 0 && feed > 0) {
      add_tip_grid(ends[1], feed, tolerance, grid);
      continue;
    }
    constexpr int count = inner_points + 1;
    for (int k = 1; k <= count; ++k) {
      grid.push_back(k == count ? ends[i + 1]
                                : ends[i] + (ends[i + 1] - ends[i]) * k / count);
    }
  }
  return grid;
}

}  // namespace

Edges::Edges(const Setup& given, double tolerance)
    : setup(given),
      meridian(geometry::meridian(given.cutter.profile)),
      passage(chip::passage(given.cutter, given.cut, given.chip)),
      psi(geometry::tooth_angles(given.cutter)),
      ends(panel_ends(given, meridian)),
      grid(scan_grid(
          ends,
          geometry::point_at(meridian, 0).r < 1e-3 * given.cut.a_p + given.cut.f_z
              ? passage.feed * unit::turn
              : 0.0,
          tolerance)) {
  for (const double s : ends) {
    lag_at_ends.push_back(geometry::lag_at(setup.cutter, meridian, s).angle);
  }
  setup.runout = runout_of(setup);
  grid_teeth.resize(grid.size() * psi.size());
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const EdgePoint& p = grid_points.emplace_back(point(grid[i]));
    geometry::edge_positions(setup.runout, psi, p.meridian.r, p.lag,
                             std::span(grid_teeth).subspan(i * psi.size(), psi.size()));
  }
  meetings = force::meetings(*this);
}

std::span<const geometry::EngagedArc> Edges::arcs_at(
    const EdgePoint& point) const noexcept {
  const auto* arcs = std::get_if<geometry::Arcs>(&setup.cut.engagement);
  return arcs == nullptr ? std::span<const geometry::EngagedArc>()
                         : arcs->at(point.meridian.z);
}

EdgePoint Edges::point(double s) const noexcept {
  EdgePoint p{.s = s, .meridian = geometry::point_at(meridian, s)};
  const geometry::Lag lag = geometry::lag_at(setup.cutter, meridian, s, p.meridian);
  p.lag = lag.angle;
  p.dS = setup.edge_length == EdgeLength::axial
             ? p.meridian.sin_kappa
             : geometry::edge_length_factor(p.meridian, lag);
  return p;
}

chip::Slice EdgeCurve::slice(const EdgePoint& point) const {
  geometry::edge_positions(edges_.setup.runout, edges_.psi, point.meridian.r, point.lag,
                           teeth_);
  chip::Slice slice{point.meridian.r, teeth_};
  slice.arcs = edges_.arcs_at(point);
  if (bend_ != nullptr) {
    slice.shift = bend_->shift(point.meridian.z);
    slice.bent = bend_->deflected;
    if (bend_->advance) {
      bend_->advance(point.meridian.z, tooth_, theta_tip_ - point.lag, advance_);
      slice.advance = advance_;
    }
  }
  return slice;
}

void EdgeCurve::add_passages(double target, std::vector<double>& grid) const {
  const std::vector<double>& lags = edges_.lag_at_ends;
  // theta_tip_ - lag = target + k turn, lag in (0, last)
  double lag = theta_tip_ - target;
  lag -= unit::turn * std::floor(lag / unit::turn);
  const int windings = static_cast<int>(std::ceil((lags.back() - lag) / unit::turn));
  for (int k = 0; k < windings; ++k) {
    const double at = lag + k * unit::turn;
    const auto above = std::upper_bound(lags.begin(), lags.end(), at);
    if (above != lags.begin() && above != lags.end()) {
      const auto i = static_cast<std::size_t>(above - lags.begin());
      grid.push_back(edges_.ends[i - 1] + (edges_.ends[i] - edges_.ends[i - 1]) *
                                              (at - lags[i - 1]) /
                                              (lags[i] - lags[i - 1]));
    }
  }
}

void EdgeCurve::add_stock_edge(double y, std::vector<double>& grid) const {
  const double R = edges_.setup.cutter.profile.D / 2;
  if (std::abs(y) < R) {
    add_passages(std::acos(y / R), grid);
  }
  if (bend_ == nullptr || !std::isfinite(y)) {
    return;
  }
  // A bent cutter meets it elsewhere: where exactly, follows from the shift there.
  std::vector<double> here = {edges_.ends.front(), edges_.ends.back()};
  for (int k = 0; k < 3; ++k) {
    std::vector<double> there;
    for (const double s : here) {
      const chip::Slice teeth = slice(edges_.point(s));
      const double own = teeth.teeth[tooth_].R;
      const double met = y - teeth.shift;
      if (std::abs(met) < own) {
        add_passages(std::acos(met / own), there);
      }
    }
    grid.insert(grid.end(), there.begin(), there.end());
    here = there;
  }
}

void EdgeCurve::add_seeds(std::vector<double>& grid) const {
  const std::size_t given = grid.size();
  for (const double s : edges_.meetings[tooth_]) {  // chips jump there
    const double beside = relative_gap * edges_.ends.back();
    grid.push_back(std::max(0.0, s - beside));
    grid.push_back(std::min(edges_.ends.back(), s + beside));
  }
  if (edges_.lag_at_ends.back() != 0) {
    add_passages(std::numbers::pi / 2, grid);
    add_stock_edge(edges_.passage.stock.y_lo, grid);
    add_stock_edge(edges_.passage.stock.y_hi, grid);
    if (const auto* arcs = std::get_if<geometry::Arcs>(&edges_.setup.cut.engagement)) {
      for (const geometry::ArcLayer& layer : arcs->layers) {
        for (const geometry::EngagedArc& engaged : layer.arcs) {
          add_passages(engaged.arc.from, grid);
          add_passages(engaged.arc.to, grid);
        }
      }
    }
  }
  if (grid.size() == given) {
    return;
  }
  std::sort(grid.begin(), grid.end());
}

EdgeState EdgeCurve::state(const EdgePoint& point, const chip::Slice& teeth) const {
  const double theta = theta_tip_ - point.lag;
  const geometry::EdgePosition& own = teeth.teeth[tooth_];
  return {chip::chip_at(edges_.passage, teeth, static_cast<int>(tooth_), theta),
          theta + own.epsilon, own.R};
}

EdgeState EdgeCurve::state(const EdgePoint& point) const {
  return state(point, slice(point));
}

EdgeState EdgeCurve::state(double s) const {
  const auto at = std::lower_bound(edges_.grid.begin(), edges_.grid.end(), s);
  if (bend_ != nullptr || at == edges_.grid.end() || *at != s) {
    return state(edges_.point(s));
  }
  // What does not depend on the spindle angle is known on the grid.
  const auto i = static_cast<std::size_t>(at - edges_.grid.begin());
  const EdgePoint& point = edges_.grid_points[i];
  const std::size_t teeth = edges_.psi.size();
  chip::Slice slice{point.meridian.r,
                    std::span(edges_.grid_teeth).subspan(i * teeth, teeth)};
  slice.arcs = edges_.arcs_at(point);
  return state(point, slice);
}

double EdgeCurve::boundary(double s, const EdgeState& a, const EdgeState& b) const {
  const EdgePoint point = edges_.point(s);
  return chip::boundary(edges_.passage, slice(point), static_cast<int>(tooth_),
                        theta_tip_ - point.lag, a.chip, b.chip);
}

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
  double shortest = 0.0;  // radius of a tooth against the nominal one
  for (const double offset : edges.setup.runout.radial_offsets) {
    shortest = std::min(shortest, offset);
  }
  const double far = edges.setup.runout.eccentricity /
                         std::sin(0.5 * std::min(gap, std::numbers::pi)) -
                     shortest;
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
