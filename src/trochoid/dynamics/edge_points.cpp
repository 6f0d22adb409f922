#include <trochoid/dynamics/edge_points.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::dynamics {

namespace {

using std::numbers::pi;
constexpr double infinity = std::numeric_limits<double>::infinity();
/// A lag of the top that is none [rad].
constexpr double no_lag = 1e-9;
/// Arcs longer than this are divided for the quadrature [rad].
constexpr double longest_arc = 1.0;

/// theta in a turn that starts behind the tool, where nothing is in cut.
double in_turn(double theta) {
  return theta - unit::turn * std::floor((theta + pi / 2) / unit::turn);
}

/// Gauss-Legendre on [0, 1].
void gauss_rule(int n, std::vector<double>& t, std::vector<double>& w) {
  for (int i = 0; i < n; ++i) {
    double x = -std::cos(pi * (i + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int round = 0; round < 20; ++round) {
      double p = 1.0;
      double last = 0.0;
      for (int k = 1; k <= n; ++k) {
        const double next = ((2 * k - 1) * x * p - (k - 1) * last) / k;
        last = p;
        p = next;
      }
      slope = n * (x * p - last) / (x * x - 1);
      x -= p / slope;
    }
    t.push_back(0.5 * (1 + x));
    w.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

/// A way from 0 to 1 that is slow at the ends where it should be, and its speed.
std::array<double, 2> drawn(double t, bool to_begin, bool to_end) {
  const double u = 1 - t;
  if (to_begin && to_end) {
    return {t * t * t * (10 - 15 * t + 6 * t * t), 30 * t * t * u * u};
  }
  if (to_begin) {
    return {t * t * t, 3 * t * t};
  }
  if (to_end) {
    return {1 - u * u * u, 3 * u * u};
  }
  return {t, 1.0};
}

}  // namespace

EdgePoints::EdgePoints(const force::Setup& setup, int points, std::size_t lookback)
    : setup_(setup),
      lookback_(lookback),
      passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
      psi_(geometry::tooth_angles(setup.cutter)),
      r_(setup.cutter.profile.D / 2) {
  const geometry::Meridian meridian = geometry::meridian(setup.cutter.profile);
  const double s = geometry::arc_length_at(meridian, setup.cut.a_p);
  const geometry::Lag lag = geometry::lag_at(setup.cutter, meridian, s);
  whole_lag_ = lag.angle > no_lag ? lag.angle : 0.0;
  if (setup.edge_length == force::EdgeLength::true_length) {
    edge_per_height_ =
        geometry::edge_length_factor(geometry::point_at(meridian, s), lag);
  }
  turning_ = whole_lag_ > 0 && setup.runout.eccentricity != 0;
  tips_ = positions(0.0);
  gauss_rule(points, gauss_t_, gauss_w_);
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    reach_.push_back(reach_of(j));
    for (const double theta : reach_[j].events) {
      for (const double behind : {0.0, whole_lag_}) {
        const double phi = psi_[j] + theta + behind;
        events_.push_back(phi - unit::turn * std::floor(phi / unit::turn));
      }
    }
  }
  std::sort(events_.begin(), events_.end());
}

std::vector<geometry::EdgePosition> EdgePoints::positions(double lag) const {
  std::vector<geometry::EdgePosition> teeth(psi_.size());
  geometry::edge_positions(force::runout_of(setup_), psi_, r_, lag, teeth);
  return teeth;
}

/// Angles where what bounds the chip without vibration changes, ascending, and those
/// among them where it enters or leaves the stock.
std::vector<double> EdgePoints::breaks(std::size_t tooth, double lag,
                                       std::vector<double>& events) const {
  const double D = setup_.cutter.profile.D;
  const chip::Arc window = chip::tooth_arc(setup_.cut.engagement, D, D / 2);
  const auto teeth = positions(lag);
  std::vector<double> breaks = {window.from, window.to};
  events = breaks;
  for (const chip::ChipPiece& piece :
       chip::engaged_pieces(passage_, {r_, teeth}, static_cast<int>(tooth), -pi / 2)) {
    breaks.insert(breaks.end(), {piece.from, piece.to});
    const chip::Chip& chip = piece.state.chip;
    if (chip::mark_of(chip) == 0 || !chip::ends_at_edge(chip)) {
      events.insert(events.end(), {piece.from, piece.to});
    }
  }
  std::sort(breaks.begin(), breaks.end());
  breaks.erase(std::unique(breaks.begin(), breaks.end(),
                           [](double a, double b) { return b - a < no_lag; }),
               breaks.end());
  events.insert(events.end(), {breaks.front(), breaks.back()});
  return breaks;
}

EdgePoints::Reach EdgePoints::reach_of(std::size_t tooth) const {
  if (setup_.cut.f_z <= 0) {
    return {};  // nothing is left for a second turn
  }
  Reach reach;
  // At the tip, half-way and at the top: a parabola through all three.
  std::array<std::vector<double>, 3> at;
  at.fill(breaks(tooth, 0.0, reach.events));
  if (turning_) {
    std::vector<double> events;
    at[1] = breaks(tooth, 0.5 * whole_lag_, events);
    at[2] = breaks(tooth, whole_lag_, events);
    reach.events.insert(reach.events.end(), events.begin(), events.end());
    if (at[0].size() != at[1].size() || at[2].size() != at[1].size()) {
      at.fill(at[1]);  // something ends on the way: as in the middle
    }
  }
  const auto is_zero = [&](double theta, double lag) {
    return std::abs(least_chip(tooth, theta, lag)) < 1e-6 * setup_.cut.f_z;
  };
  const auto angle = [&](std::size_t i, double share) {
    std::array<double, 3> b;
    for (std::size_t k = 0; k < b.size(); ++k) {
      b[k] = at[k][i] + share * (at[k][i + 1] - at[k][i]);
    }
    const double L = whole_lag_ > 0 ? whole_lag_ : 1.0;
    return LaggingAngle{b[0], (4 * b[1] - 3 * b[0] - b[2]) / L,
                        2 * (b[0] - 2 * b[1] + b[2]) / (L * L)};
  };
  const std::vector<double>& tip = at[0];
  for (std::size_t i = 0; i + 1 < tip.size(); ++i) {
    const int parts = static_cast<int>(std::ceil((tip[i + 1] - tip[i]) / longest_arc));
    for (int k = 0; k < parts; ++k) {
      const double n = parts;
      const ChipArc arc{angle(i, k / n), angle(i, (k + 1) / n)};
      reach.arcs.push_back(
          {arc.from, arc.to, is_zero(arc.from.tip, 0.0), is_zero(arc.to.tip, 0.0)});
    }
  }
  return reach;
}

/// a_jm of the stock and of the teeth before.
void EdgePoints::chips(const chip::Slice& slice, std::size_t tooth, double theta,
                       std::span<double> above) const {
  const auto j = static_cast<int>(tooth);
  above[0] = infinity;
  if (passage_.model.model == chip::Model::trochoidal) {
    const chip::Chip chip = chip::chip_at(passage_, slice, j, theta);
    if (chip::mark_of(chip) == 0 || !chip::ends_at_edge(chip)) {
      above[0] = chip.margin;
    }
  }
  const std::size_t teeth = psi_.size();
  for (std::size_t m = 1; m <= std::min(lookback_, teeth); ++m) {
    above[m] = chip::chip_over_mark(passage_, slice, j, theta, static_cast<int>(m));
  }
  if (lookback_ > teeth) {
    // A mark older than a turn stands farther back by
    // as much as the own one of a turn ago.
    for (std::size_t m = teeth + 1; m <= lookback_; ++m) {
      above[m] = above[m - teeth] + above[teeth];
    }
  }
  for (auto m = static_cast<std::size_t>(passage_.marks) + 1;
       m <= std::min(lookback_, teeth); ++m) {
    above[m] = infinity;  // not looked at
  }
}

double EdgePoints::least_chip(std::size_t tooth, double theta, double lag) const {
  const auto teeth = positions(lag);
  std::vector<double> above(lookback_ + 1);
  chips({r_, teeth}, tooth, theta, above);
  return *std::min_element(above.begin(), above.end());
}

bool EdgePoints::at_event(double phi) const noexcept {
  constexpr double near = 1e-7;
  const auto next = std::lower_bound(events_.begin(), events_.end(), phi - near);
  return (next != events_.end() && *next < phi + near) || phi < near ||
         phi > unit::turn - near;
}

/// Gauss nodes on the part of an arc that an edge covers, and on its images.
void EdgePoints::add_arc(const ChipArc& arc, double tip,
                         std::vector<EdgePlace>& places) const {
  const double height_per_lag = setup_.cut.a_p / whole_lag_;
  const auto first = static_cast<int>(std::floor((tip - whole_lag_ - pi) / unit::turn));
  const auto last = static_cast<int>(std::ceil((tip + pi) / unit::turn));
  for (int image = first; image < last; ++image) {
    const double here = tip - unit::turn * image;
    const auto meets = [&](const LaggingAngle& angle) {
      double lag = here - angle.tip;
      for (int round = 0; round < 4; ++round) {
        const double off =
            here - lag - angle.tip - lag * (angle.per_lag + lag * angle.per_square);
        lag += off / std::max(0.1, 1 + angle.per_lag + 2 * lag * angle.per_square);
      }
      return here - lag;
    };
    const double begin = meets(arc.from);
    const double end = meets(arc.to);
    const double from = std::max(begin, here - whole_lag_);
    const double to = std::min(end, here);
    if (to - from <= no_lag) {
      continue;
    }
    for (std::size_t k = gauss_t_.size(); k-- > 0;) {  // upwards: theta falls
      const auto [part, speed] =
          drawn(gauss_t_[k], arc.begins && from == begin, arc.ends && to == end);
      const double theta = from + part * (to - from);
      places.push_back(
          {theta, here - theta, gauss_w_[k] * speed * (to - from) * height_per_lag});
    }
  }
}

void EdgePoints::find_places(std::size_t tooth, double tip, double side,
                             std::vector<EdgePlace>& places) const {
  const std::vector<ChipArc>& arcs = reach_[tooth].arcs;
  places.clear();
  if (arcs.empty()) {
    return;
  }
  if (whole_lag_ == 0) {
    const double theta = in_turn(tip + side);
    if (theta > arcs.front().from.tip && theta < arcs.back().to.tip) {
      places.push_back({tip, 0.0, setup_.cut.a_p});
    }
    return;
  }
  for (auto arc = arcs.rbegin(); arc != arcs.rend(); ++arc) {
    add_arc(*arc, tip, places);
  }
}

Contacts EdgePoints::add(double phi, double side, EngagedGrid& grid) const {
  Contacts range{grid.stretches.size(), 0};
  std::vector<EdgePlace> points;
  std::vector<geometry::EdgePosition> turned(turning_ ? psi_.size() : 0);
  std::vector<double> above(lookback_ + 1);
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    find_places(j, phi - psi_[j], side, points);
    if (points.empty()) {
      continue;
    }
    const Stretch stretch{j, grid.sine.size(), points.size(), grid.above.size()};
    grid.above.resize(grid.above.size() + (lookback_ + 1) * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const EdgePlace& point = points[i];
      if (turning_) {
        turned = positions(point.lag);
      }
      const chip::Slice slice{r_, turning_ ? turned : tips_};
      const double theta = point.theta + slice.teeth[j].epsilon;
      grid.sine.push_back(std::sin(theta));
      grid.cosine.push_back(std::cos(theta));
      grid.width.push_back(point.height);
      grid.edge.push_back(point.height * edge_per_height_);
      chips(slice, j, point.theta, above);
      for (std::size_t m = 0; m <= lookback_; ++m) {
        grid.above[stretch.marks + m * points.size() + i] = above[m];
      }
    }
    grid.stretches.push_back(stretch);
  }
  range.last = grid.stretches.size();
  return range;
}

}  // namespace trochoid::dynamics
