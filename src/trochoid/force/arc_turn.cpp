#include <trochoid/force/arc_turn.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/teeth_at_height.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>
#include <variant>

namespace trochoid::force {

namespace {

constexpr double turn_start = -std::numbers::pi / 2;
constexpr double turn_end = turn_start + unit::turn;
/// A layer in which the edge lags less is cut at one angle [rad].
constexpr double shortest_lag = 1e-7;
/// Below this the moments over the height are those about the middle of the layer [rad].
constexpr double short_lag = 0.05;
/// Samples in which what bounds a chip is looked for [rad].
constexpr double look = 0.1;
/// Runout that changes along the edge is taken as constant over such a lag [rad].
constexpr double slab_lag = 0.05;
/// The same where layers are cones, and the part of a wave that is one.
constexpr double cone_lag = 0.3;
constexpr double part_of_wave = 1.0 / 24;
/// How exactly the end of a chip is found, and where another mark bounds it [rad].
struct Closest {
  double end;
  double kink;
};
constexpr Closest closest_on_cylinder{1e-6, 1e-4};
constexpr Closest closest_on_cone{1e-5, 1e-4};
/// Of a cylinder without lag: its force jumps there, and is largest just before.
constexpr Closest closest_at_jump{1e-12, 1e-12};
/// Longest panel [rad].
constexpr double longest_arc_panel = 1.6;
constexpr double arc_tolerance = 1e-7;
/// The same where layers are cones: those stand for a curve, and err more than this.
constexpr double cone_tolerance = 1e-4;
/// A tool that only falls is fed sideways by next to nothing [m/rad].
constexpr double least_feed = 1e-13;

double into_turn(double theta) noexcept {
  return theta - unit::turn * std::floor((theta - turn_start) / unit::turn);
}

}  // namespace

ToothLoads& operator+=(ToothLoads& a, const ToothLoads& b) noexcept {
  a.x += b.x;
  a.y += b.y;
  a.z += b.z;
  a.torque += b.torque;
  for (std::size_t i = 0; i < 3; ++i) {
    a.moment_x[i] += b.moment_x[i];
    a.moment_y[i] += b.moment_y[i];
  }
  a.axial_x += b.axial_x;
  a.axial_y += b.axial_y;
  return a;
}

namespace {

/// A layer on its edge: z = A - theta/q, from its middle over a lag.
struct OnEdge {
  double A;
  double q;
  double middle;
  double lag;
};

/// Moments over the height from those over theta.
void add_window_moments(const std::array<double, 12>& v, const OnEdge& edge,
                        ToothLoads& out) noexcept {
  const auto& [A, q, m, lag] = edge;
  const double each = std::abs(q);
  for (std::size_t i = 0; i < 2; ++i) {
    std::array<double, 3>& moment = i == 0 ? out.moment_x : out.moment_y;
    const double whole = v[i] / each;
    const double first = (A * v[i] - v[4 + i] / q) / each;
    if (lag < short_lag) {
      const double about = lag < 1e-4 ? 0.0 : first - m * whole;
      moment[0] += m * whole + about;
      moment[1] += m * (m * whole + 2 * about);
      moment[2] += m * m * (m * whole + 3 * about);
      continue;
    }
    moment[0] += first;
    moment[1] += (A * A * v[i] - 2 * A * v[4 + i] / q + v[6 + i] / (q * q)) / each;
    moment[2] += (A * A * A * v[i] - 3 * A * A * v[4 + i] / q +
                  3 * A * v[6 + i] / (q * q) - v[8 + i] / (q * q * q)) /
                 each;
  }
}

}  // namespace

ArcTurn::Edge::Edge() : integral(turn_start, unit::turn) {}

ArcTurn::ArcTurn(const Setup& setup, const Law& law, const Options& options)
    : passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
      options_(options),
      r_(setup.cutter.profile.D / 2),
      psi_(geometry::tooth_angles(setup.cutter)),
      lag_per_height_(2 * std::tan(setup.cutter.helix) / setup.cutter.lag_diameter),
      tolerance_(options.cones ? cone_tolerance : arc_tolerance),
      jumps_(!options.cones && !(lag_per_height_ > 0)),
      law_(terms(law)) {
  passage_.by_arcs = false;  // the arcs are looked at here, with what bounds them
  if (options.fall > 0) passage_.feed = std::max(passage_.feed, least_feed);
  if (setup.edge_length == EdgeLength::true_length) {
    edge_factor_ = std::hypot(1.0, r_ * lag_per_height_);
  }
  std::optional<geometry::ToothEdges> edges;
  if (options.cones) edges.emplace(setup.cutter, runout_of(setup));
  const geometry::Arcs& arcs = std::get<geometry::Arcs>(setup.cut.engagement);
  for (const geometry::ArcLayer& given : arcs.layers) {
    const double to = std::min(given.to, setup.cut.a_p);
    if (given.arcs.empty() || !(to > given.from)) continue;
    const double height = to - given.from;
    if (edges) {
      add_cones(*edges, setup, given, {given.from, to});
      continue;
    }
    const double lag = lag_per_height_ * height;
    const int slabs = keeps_radius(setup) ? 1 : static_cast<int>(lag / slab_lag) + 1;
    for (int i = 0; i < slabs; ++i) {
      add_slab(
          setup, given,
          {given.from + height * i / slabs, given.from + height * (i + 1) / slabs});
    }
  }
}

void ArcTurn::add_slab(const Setup& setup, const geometry::ArcLayer& given,
                       geometry::Arc slab) {
  Layer layer{.from = slab.from, .to = slab.to, .passage = passage_};
  layer.positions.resize(psi_.size());
  geometry::edge_positions(runout_of(setup), psi_, r_,
                           lag_per_height_ * 0.5 * (slab.from + slab.to),
                           layer.positions);
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    Edge edge;
    edge.place = static_cast<int>(j);
    edge.r = r_;
    edge.R = layer.positions[j].R;
    edge.epsilon = layer.positions[j].epsilon;
    edge.length = edge_factor_;
    edge.behind = psi_[j] - edge.epsilon + lag_per_height_ * slab.from;
    edge.q = lag_per_height_;
    layer.edges.push_back(std::move(edge));
  }
  finish(std::move(layer), given);
}

void ArcTurn::add_cones(const geometry::ToothEdges& edges, const Setup& setup,
                        const geometry::ArcLayer& given, geometry::Arc layer) {
  const bool constant =
      geometry::runs_true(runout_of(setup)) && edges.wavelength() == 0;
  std::vector<double> ends = edges.breaks(layer.to);
  std::erase_if(ends, [&](double z) { return z <= layer.from; });
  double from = layer.from;
  for (const double end : ends) {
    double turned = 0.0;
    for (std::size_t j = 0; j < edges.teeth(); ++j) {
      turned = std::max(turned, edges.turn_between(j, from, end));
    }
    double parts = constant ? 1.0 : turned / cone_lag;
    if (edges.wavelength() > 0) {
      parts = std::max(parts, (end - from) / (edges.wavelength() * part_of_wave));
    }
    const int n = static_cast<int>(parts) + 1;
    for (int i = 0; i < n; ++i) {
      add_cone(edges, setup, given,
               {from + (end - from) * i / n, from + (end - from) * (i + 1) / n});
    }
    from = end;
  }
}

void ArcTurn::add_cone(const geometry::ToothEdges& edges, const Setup& setup,
                       const geometry::ArcLayer& given, geometry::Arc slab) {
  chip::TeethAtHeight teeth(edges, passage_);
  teeth.stand_at(0.5 * (slab.from + slab.to));
  Layer layer{.from = slab.from, .to = slab.to, .passage = teeth.passage()};
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    Edge& edge = layer.edges.emplace_back();
    edge.place = teeth.place(j);
    if (edge.place < 0) continue;
    const geometry::EdgeAt& at = teeth.edge(j);
    const double omega = edges.edge_at(j, slab.from).omega;
    edge.r = at.r;
    edge.R = at.position.R;
    edge.epsilon = at.position.epsilon;
    edge.sin_kappa = at.sin_kappa;
    edge.cos_kappa = at.cos_kappa;
    edge.length = setup.edge_length == EdgeLength::true_length ? at.dS_dz : 1.0;
    edge.behind = omega - edge.epsilon;
    edge.q = (edges.edge_at(j, slab.to).omega - omega) / (slab.to - slab.from);
    layer.positions.push_back(at.position);
    const auto teeth_there = static_cast<std::size_t>(layer.passage.teeth);
    for (std::size_t m = 0; options_.fall != 0 && m < teeth_there; ++m) {  // N-18
      const double back =
          layer.passage.back[static_cast<std::size_t>(edge.place) * teeth_there + m];
      const double above = options_.fall * back / unit::turn;
      const geometry::EdgeAt before =
          edges.edge_at(j, 0.5 * (slab.from + slab.to) - above);
      edge.advance.push_back(at.r - (before.there ? before.r : 0.0));
    }
    jumps_ = jumps_ || std::abs(edge.q) * (slab.to - slab.from) < shortest_lag;
  }
  if (!layer.positions.empty()) finish(std::move(layer), given);
}

void ArcTurn::finish(Layer&& layer, const geometry::ArcLayer& given) {
  const double least =
      std::ranges::min_element(layer.positions, {}, &geometry::EdgePosition::R)->R;
  // No mark is older than a turn.
  double oldest = passage_.feed * unit::turn;
  for (const Edge& edge : layer.edges) {
    if (!edge.advance.empty()) oldest += std::abs(edge.advance.back());
  }
  layer.arcs =
      chip::reached_arcs(given.arcs, std::max(least - oldest, 0.0), options_.within);
  for (Edge& edge : layer.edges) {
    if (edge.place < 0) continue;
    add_tooth(layer, edge);
    const double share = (layer.to - layer.from) / unit::turn;
    const Values& total = edge.integral.total();
    mean_.x += share * total[0];  // N-8
    mean_.y += share * total[1];
    mean_.z += share * total[2];
    mean_.torque += share * total[3] * edge.R;
  }
  layers_.push_back(std::move(layer));
}

ArcTurn::Ray ArcTurn::ray(const Layer& layer, const Edge& edge,
                          double theta) const noexcept {
  const chip::Slice slice{
      .r = edge.r, .teeth = layer.positions, .advance = edge.advance};
  const chip::Chip chip =
      chip::chip_at(layer.passage, slice, edge.place, theta - edge.epsilon);
  if (!chip.in_cut) {
    return {0.0, -1};
  }
  const geometry::Stretch all{edge.R - chip.h, edge.R};
  const double h = std::max(chip::stock_length(layer.arcs, theta, all),
                            chip::stock_length(layer.arcs, theta + unit::turn, all));
  if (!(h > chip::h_threshold)) {
    return {0.0, -1};
  }
  const bool clipped = h < chip.h;
  return {h, 2 * chip::mark_of(chip) + (clipped ? 1 : 0)};
}

ArcTurn::PerHeight ArcTurn::per_height(const Edge& edge, double h,
                                       std::array<double, 2> direction) const noexcept {
  const double sine = edge.sin_kappa;
  const ColumnWeights w = column_weights(law_.form, h, sine, edge.length * sine);
  const double t = (law_.K[0] * w.cutting[0] + law_.K_e[0] * w.edge) / sine;
  const double r = (law_.K[1] * w.cutting[1] + law_.K_e[1] * w.edge) / sine;
  const double a = (law_.K[2] * w.cutting[2] + law_.K_e[2] * w.edge) / sine;
  const double inward = r * sine + a * edge.cos_kappa;
  const auto [x, y] = in_plane(t, inward, direction[0], direction[1]);
  return {x, y, r * edge.cos_kappa - a * sine, t};
}

void ArcTurn::add_tooth(const Layer& layer, Edge& edge) {
  // Between these nothing changes but what the marks do.
  std::vector<double> breaks{turn_start, turn_end};
  for (const chip::ReachedArc& arc : layer.arcs) {
    for (const double theta :
         {arc.at_from.from, arc.at_from.to, arc.at_to.from, arc.at_to.to,
          arc.engaged.arc.from, arc.engaged.arc.to}) {
      breaks.push_back(into_turn(theta));
    }
  }
  std::ranges::sort(breaks);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    if (breaks[i + 1] - breaks[i] > 1e-9) {
      add_stretch(layer, edge, breaks[i], breaks[i + 1]);
    }
  }
  edge.integral.finish();
}

void ArcTurn::add_stretch(const Layer& layer, Edge& edge, double from, double to) {
  const double middle = 0.5 * (from + to);
  const auto holds = [&](const chip::ReachedArc& arc) {
    return (middle > arc.first() && middle < arc.last()) ||
           (middle + unit::turn > arc.first() && middle + unit::turn < arc.last());
  };
  if (std::ranges::none_of(layer.arcs, holds)) {
    return;
  }
  const int n = std::max(4, static_cast<int>(std::ceil((to - from) / look)));
  const double a_little = 1e-9 * (to - from);
  const auto at = [&](int i) {
    return i == 0 ? from + a_little
                  : (i == n ? to - a_little : from + (to - from) * i / n);
  };
  const Closest& closest = options_.cones ? closest_on_cone
                           : jumps_       ? closest_at_jump
                                          : closest_on_cylinder;
  double start = from;
  int bound = ray(layer, edge, at(0)).bound;
  const auto close = [&](double end) {
    if (bound >= 0 && end > start) {
      add_smooth(layer, edge, {start, end});
    }
    start = end;
  };
  for (int i = 1; i <= n; ++i) {
    const int next = ray(layer, edge, at(i)).bound;
    double lo = at(i - 1);
    while (next != bound) {  // several may follow one another
      double hi = at(i);
      int beyond = next;
      while (hi - lo > (bound < 0 || beyond < 0 ? closest.end : closest.kink)) {
        const double half = 0.5 * (lo + hi);
        const int there = ray(layer, edge, half).bound;
        if (there == bound) {
          lo = half;
        } else {
          hi = half;
          beyond = there;
        }
      }
      close(hi);
      lo = hi;
      bound = beyond;
    }
  }
  close(to);
}

namespace {

/// Of a function with one maximum.
template <class Function>
double largest_between(const Function& f, double lo, double hi) {
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 12; ++i) {
    const double a = hi - golden * (hi - lo);
    const double b = lo + golden * (hi - lo);
    const bool rises = f(a) < f(b);
    (rises ? lo : hi) = rises ? a : b;
  }
  return f(0.5 * (lo + hi));
}

}  // namespace

void ArcTurn::add_smooth(const Layer& layer, Edge& edge, geometry::Arc piece) {
  edge.ends.push_back(piece.from);
  edge.ends.push_back(piece.to);
  const auto h_at = [&](double theta) { return ray(layer, edge, theta).h; };
  double largest = 0.0;
  double at_largest = piece.from;
  const double inner = 1e-9 * (piece.to - piece.from);
  for (const double theta : {piece.from + inner, piece.to - inner}) {
    const double h = h_at(theta);
    if (h > largest) {
      largest = h;
      at_largest = theta;
    }
  }
  const auto f = [&](double theta) {
    const double h = h_at(theta);
    if (h > largest) {
      largest = h;
      at_largest = theta;
    }
    const std::array<double, 2> direction = {std::sin(theta), std::cos(theta)};
    const PerHeight g = per_height(edge, h, direction);
    Values out{g[0], g[1], g[2], g[3]};
    if (options_.heights) {
      double power = theta;
      for (std::size_t k = 0; k < 3; ++k) {
        out[4 + 2 * k] = power * g[0];
        out[5 + 2 * k] = power * g[1];
        power *= theta;
      }
      out[10] = direction[0] * g[2];
      out[11] = direction[1] * g[2];
    }
    return out;
  };
  // The largest force that the chip here could make, and a little.
  const double most = passage_.feed * unit::turn +
                      (edge.advance.empty() ? 0.0 : std::abs(edge.advance.back()));
  const PerHeight g = per_height(edge, most, {0.0, 1.0});
  const double scale = std::abs(g[0]) + std::abs(g[1]) + std::abs(g[2]);
  Values allowed{};
  for (std::size_t q = 0; q < allowed.size(); ++q) {
    allowed[q] = tolerance_ * scale * (q < 4 ? 1.0 : 30.0);
  }
  edge.integral.append(piece.from, piece.to, f, longest_arc_panel, allowed);
  if (largest * edge.sin_kappa <= peak_chip_ * (1 - 1e-3)) return;
  if (options_.cones) {
    peak_chip_ = std::max(peak_chip_, edge.sin_kappa * largest);
    return;
  }
  const double largest_chip =
      largest_between(h_at, std::max(piece.from + inner, at_largest - 0.5 * look),
                      std::min(piece.to - inner, at_largest + 0.5 * look));
  peak_chip_ = std::max(peak_chip_, edge.sin_kappa * std::max(largest, largest_chip));
}

bool ArcTurn::at_one_angle(const Layer& layer, const Edge& edge) const noexcept {
  return std::abs(edge.q) * (layer.to - layer.from) < shortest_lag;
}

ArcTurn::PerHeight ArcTurn::force_at_one_angle(const Layer& layer, const Edge& edge,
                                               double theta) const noexcept {
  const double h = ray(layer, edge, theta).h;
  return h > 0 ? per_height(edge, h, {std::sin(theta), std::cos(theta)}) : PerHeight{};
}

template <std::size_t Q, class Use>
void ArcTurn::for_each_window(const Layer& layer, const Edge& edge,
                              std::array<double, 2> phi_and_from,
                              const Use& use) const {
  const auto [phi, from] = phi_and_from;
  const double lag = std::abs(edge.q) * (layer.to - from);
  const double at_bottom = into_turn(phi - edge.behind - edge.q * (from - layer.from));
  // The window of theta, from the top to the bottom of the layer, and its images.
  const double ahead = edge.q < 0 ? lag : 0.0;
  for (double bottom = at_bottom - (edge.q < 0 ? unit::turn : 0.0);
       bottom + ahead - lag < turn_end; bottom += unit::turn) {
    const double first = std::max(bottom + ahead - lag, turn_start);
    const double last = std::min(bottom + ahead, turn_end);
    if (!(last > first)) continue;
    std::array<double, Q> v{};
    edge.integral.add_between(first, last, v);
    use(v, bottom);
  }
}

void ArcTurn::add_layer(const Layer& layer, const Edge& edge, double phi, double from,
                        ToothLoads& out) const noexcept {
  const double height = layer.to - from;
  const double middle = from + 0.5 * height;
  const auto add = [&](const PerHeight& F, double by) {
    out.x += by * F[0];
    out.y += by * F[1];
    out.z += by * F[2];
    out.torque += by * F[3] * edge.R;
  };
  if (at_one_angle(layer, edge)) {
    const double theta = into_turn(phi - edge.behind - edge.q * (middle - layer.from));
    const PerHeight F = force_at_one_angle(layer, edge, theta);
    add(F, height);
    out.axial_x += edge.R * std::sin(theta) * height * F[2];
    out.axial_y += edge.R * std::cos(theta) * height * F[2];
    for (std::size_t k = 0; options_.heights && k < 3; ++k) {
      const auto n = static_cast<int>(k) + 2;
      const double share = (std::pow(layer.to, n) - std::pow(from, n)) / n;
      out.moment_x[k] += share * F[0];
      out.moment_y[k] += share * F[1];
    }
    return;
  }
  const double q = std::abs(edge.q);
  for_each_window<all_values>(
      layer, edge, {phi, from}, [&](const Values& v, double bottom) {
        add({v[0], v[1], v[2], v[3]}, 1 / q);  // N-7
        if (!options_.heights) return;
        out.axial_x += edge.R * v[10] / q;
        out.axial_y += edge.R * v[11] / q;
        const double A = from + bottom / edge.q;  // z = A - theta/q
        add_window_moments(v, {A, edge.q, middle, q * height}, out);
      });
}

ToothLoads ArcTurn::at(std::size_t tooth, double phi, double above) const noexcept {
  ToothLoads out;
  for (const Layer& layer : layers_) {
    if (layer.edges[tooth].place >= 0 && layer.to > above) {
      add_layer(layer, layer.edges[tooth], phi, std::max(layer.from, above), out);
    }
  }
  return out;
}

std::vector<std::array<double, 4>> ArcTurn::forces_at(
    std::size_t tooth, std::span<const double> phi) const {
  std::vector<std::array<double, 4>> out(phi.size());
  for (const Layer& layer : layers_) {
    const Edge& edge = layer.edges[tooth];
    if (edge.place < 0) continue;
    const double height = layer.to - layer.from;
    const bool at_one = at_one_angle(layer, edge);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const auto add = [&](const PerHeight& F, double by) {
        for (std::size_t k = 0; k < 3; ++k) out[i][k] += by * F[k];
        out[i][3] += by * edge.R * F[3];
      };
      if (at_one) {
        const double theta = into_turn(phi[i] - edge.behind - 0.5 * edge.q * height);
        add(force_at_one_angle(layer, edge, theta), height);
        continue;
      }
      for_each_window<4>(layer, edge, {phi[i], layer.from},
                         [&](const PerHeight& v, double) {
                           add(v, 1 / std::abs(edge.q));  // N-7
                         });
    }
  }
  return out;
}

std::vector<double> ArcTurn::events() const {
  std::vector<double> out;
  for (const Layer& layer : layers_) {
    for (const Edge& edge : layer.edges) {
      for (const double end : edge.ends) {
        for (const double z : {0.0, layer.to - layer.from}) {
          const double phi = end + edge.behind + edge.q * z;
          out.push_back(phi - unit::turn * std::floor(phi / unit::turn));
        }
      }
    }
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end(),
                        [](double a, double b) { return b - a < 1e-9; }),
            out.end());
  return out;
}

}  // namespace trochoid::force
