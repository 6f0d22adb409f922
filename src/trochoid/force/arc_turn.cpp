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
constexpr double cone_tolerance = 1e-6;
/// How far from its ends a piece is looked at, as a part of it.
constexpr double inner_part = 1e-9;
/// Steps of a table of chips on cones [rad], up to which feed per angle over radius they
/// are enough, and up to which half of them are.
constexpr double table_step = 0.15;
constexpr double gentle_in_table = 0.06;
constexpr double steepest_in_table = 0.12;
/// The stock bounds a chip that is less than this part of it: more is rounding.
constexpr double clipped_part = 1 - 1e-6;
/// A tool that only falls is fed sideways by next to nothing [m/rad].
constexpr double least_feed = 1e-13;

/// How rays at an angle lie in the stock, as far as chips reach.
enum class Inside { none, partly, wholly };

Inside inside(std::span<const chip::ReachedArc> arcs, double theta) noexcept {
  Inside out = Inside::none;
  for (const chip::ReachedArc& arc : arcs) {
    for (const double at : {theta, theta + unit::turn}) {
      if (!(at > arc.first() && at < arc.last())) continue;
      if (at > arc.at_from.to && at < arc.at_to.from) return Inside::wholly;
      out = Inside::partly;
    }
  }
  return out;
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
  const bool alike = !options.cones && keeps_radius(setup);
  if (alike) find_unbounded(setup, arcs);
  for (const geometry::ArcLayer& given : arcs.layers) {
    const double to = std::min(given.to, setup.cut.a_p);
    if (given.arcs.empty() || !(to > given.from)) continue;
    const double height = to - given.from;
    if (edges) {
      add_cones(*edges, setup, given, {given.from, to});
      continue;
    }
    const double lag = lag_per_height_ * height;
    const int slabs = alike ? 1 : static_cast<int>(lag / slab_lag) + 1;
    for (int i = 0; i < slabs; ++i) {
      add_slab(
          setup, given,
          {given.from + height * i / slabs, given.from + height * (i + 1) / slabs});
    }
  }
}

ArcTurn::Layer ArcTurn::slab_of(const Setup& setup, geometry::Arc slab) const {
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
  return layer;
}

void ArcTurn::find_unbounded(const Setup& setup, const geometry::Arcs& arcs) {
  Layer layer = slab_of(setup, {0.0, setup.cut.a_p});
  layer.arcs = reached(layer, arcs.layers);
  if (layer.arcs.empty()) return;
  const auto by_first = std::ranges::minmax(layer.arcs, {}, &chip::ReachedArc::first);
  const auto by_last = std::ranges::minmax(layer.arcs, {}, &chip::ReachedArc::last);
  geometry::Arc all{by_first.min.first(), by_last.max.last()};
  if (all.from < turn_start || all.to > turn_end) all = {turn_start, turn_end};
  layer.arcs = {{{all}, {all.from, all.from}, {all.to, all.to}}};
  for (Edge& edge : layer.edges) add_tooth(layer, edge, nullptr);
  peak_chip_ = 0.0;  // the stock may end before it
  unbounded_ = std::move(layer);
}

void ArcTurn::add_slab(const Setup& setup, const geometry::ArcLayer& given,
                       geometry::Arc slab) {
  finish(slab_of(setup, slab), given);
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
    jumps_ = jumps_ || at_one_angle(layer, edge);
  }
  if (!layer.positions.empty()) finish(std::move(layer), given);
}

std::vector<chip::ReachedArc> ArcTurn::reached(
    const Layer& layer, std::span<const geometry::ArcLayer> given) const {
  const double least =
      std::ranges::min_element(layer.positions, {}, &geometry::EdgePosition::R)->R;
  // No mark is older than a turn.
  double oldest = passage_.feed * unit::turn;
  for (const Edge& edge : layer.edges) {
    if (!edge.advance.empty()) oldest += std::abs(edge.advance.back());
  }
  std::vector<chip::ReachedArc> out;
  for (const geometry::ArcLayer& one : given) {
    const auto some =
        chip::reached_arcs(one.arcs, std::max(least - oldest, 0.0), options_.within);
    out.insert(out.end(), some.begin(), some.end());
  }
  return out;
}

void ArcTurn::finish(Layer&& layer, const geometry::ArcLayer& given) {
  layer.arcs = reached(layer, std::span(&given, 1));
  for (std::size_t j = 0; j < layer.edges.size(); ++j) {
    Edge& edge = layer.edges[j];
    if (edge.place < 0) continue;
    add_tooth(layer, edge, unbounded_ ? &unbounded_->edges[j] : nullptr);
    const double share = (layer.to - layer.from) / unit::turn;
    const Values& total = edge.integral.total();
    mean_.x += share * total[0];  // N-8
    mean_.y += share * total[1];
    mean_.z += share * total[2];
    mean_.torque += share * total[3] * edge.R;
  }
  layers_.push_back(std::move(layer));
}

void ArcTurn::fill_table(const Layer& layer, Edge& edge) const {
  const double smallest =
      std::ranges::min_element(layer.positions, {}, &geometry::EdgePosition::R)->R;
  const bool smooth = layer.passage.feed <= steepest_in_table * smallest;
  if (layer.passage.model.model != chip::Model::trochoidal || !smooth ||
      layer.arcs.empty()) {
    return;
  }
  MarkTable& table = edge.table;
  const double from =
      std::ranges::min_element(layer.arcs, {}, &chip::ReachedArc::first)->first();
  const double to =
      std::ranges::max_element(layer.arcs, {}, &chip::ReachedArc::last)->last();
  table.step =
      layer.passage.feed <= gentle_in_table * smallest ? table_step : table_step / 2;
  table.start = from;
  table.steps = static_cast<int>(std::min(to - from, unit::turn) / table.step) + 1;
  const chip::Slice slice{
      .r = edge.r, .teeth = layer.positions, .advance = edge.advance};
  const int marks = layer.passage.marks;
  table.over.reserve(static_cast<std::size_t>((table.steps + 3) * marks));
  for (int i = -1; i <= table.steps + 1; ++i) {
    const double theta = from + i * table.step - edge.epsilon;
    for (int m = 1; m <= marks; ++m) {
      table.over.push_back(
          chip::chip_over_mark(layer.passage, slice, edge.place, theta, m));
    }
  }
}

std::optional<ArcTurn::InTable> ArcTurn::in_table(const Edge& edge,
                                                  double theta) noexcept {
  const MarkTable& table = edge.table;
  if (table.over.empty()) return std::nullopt;
  double along = theta - table.start;
  along -= unit::turn * std::floor(along / unit::turn);
  const double place = along / table.step;
  const int first = static_cast<int>(place);
  if (first >= table.steps) return std::nullopt;
  const double t = place - first;
  const double before = t + 1;
  const double after = 1 - t;
  const double last = 2 - t;
  return InTable{static_cast<std::size_t>(first),
                 {-t * after * last / 6, before * after * last / 2,
                  before * t * last / 2, -before * t * after / 6}};
}

double ArcTurn::over_mark(const Layer& layer, const Edge& edge, int mark,
                          const InTable& at) const noexcept {
  const auto marks = static_cast<std::size_t>(layer.passage.marks);
  const double* over =
      &edge.table.over[at.first * marks + static_cast<std::size_t>(mark - 1)];
  double h = 0.0;
  for (std::size_t i = 0; i < 4; ++i) h += at.weight[i] * over[i * marks];
  return h;
}

ArcTurn::OverMarks ArcTurn::over_marks(const Layer& layer, const Edge& edge,
                                       double theta) const noexcept {
  if (const auto at = in_table(edge, theta)) {
    OverMarks best{edge.R, 0};
    for (int m = 1; m <= layer.passage.marks; ++m) {
      const double h = over_mark(layer, edge, m, *at);
      if (h < best.h) best = {h, m};
    }
    return best;
  }
  const chip::Slice slice{
      .r = edge.r, .teeth = layer.positions, .advance = edge.advance};
  const chip::Chip chip =
      chip::chip_at(layer.passage, slice, edge.place, theta - edge.epsilon);
  return {chip.in_cut ? chip.h : 0.0, chip::mark_of(chip)};
}

ArcTurn::Ray ArcTurn::ray(const Layer& layer, const Edge& edge,
                          double theta) const noexcept {
  const OverMarks chip = over_marks(layer, edge, theta);
  if (!(chip.h > chip::h_threshold)) {
    return {0.0, -1};
  }
  const double h = in_stock(layer, edge, theta, chip.h);
  if (!(h > chip::h_threshold)) {
    return {0.0, -1};
  }
  return {h, 2 * chip.mark + (h < clipped_part * chip.h ? 1 : 0)};
}

double ArcTurn::in_stock(const Layer& layer, const Edge& edge, double theta,
                         double h) const noexcept {
  const geometry::Stretch all{edge.R - h, edge.R};
  return std::max(chip::stock_length(layer.arcs, theta, all),
                  chip::stock_length(layer.arcs, theta + unit::turn, all));
}

double ArcTurn::chip_over(const Layer& layer, const Edge& edge, int mark,
                          double theta) const noexcept {
  if (mark == 0) return ray(layer, edge, theta).h;
  double h = 0.0;
  if (const auto at = in_table(edge, theta)) {
    h = over_mark(layer, edge, mark, *at);
  } else {
    const chip::Slice slice{
        .r = edge.r, .teeth = layer.positions, .advance = edge.advance};
    h = chip::chip_over_mark(layer.passage, slice, edge.place, theta - edge.epsilon,
                             mark);
  }
  return h > chip::h_threshold ? in_stock(layer, edge, theta, std::min(h, edge.R))
                               : 0.0;
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

void ArcTurn::add_tooth(const Layer& layer, Edge& edge, const Edge* unbounded) {
  if (options_.cones) fill_table(layer, edge);
  edge.integral.use_first(options_.heights ? all_values : std::tuple_size_v<PerHeight>);
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
    if (!(breaks[i + 1] - breaks[i] > 1e-9)) continue;
    const geometry::Arc stretch{breaks[i], breaks[i + 1]};
    switch (inside(layer.arcs, 0.5 * (stretch.from + stretch.to))) {
      case Inside::none:
        break;
      case Inside::wholly:
        if (unbounded != nullptr) {
          add_unbounded(*unbounded, edge, stretch);
          break;
        }
        [[fallthrough]];
      case Inside::partly:
        add_stretch(layer, edge, stretch.from, stretch.to);
    }
  }
  edge.integral.finish();
}

void ArcTurn::add_unbounded(const Edge& unbounded, Edge& edge, geometry::Arc stretch) {
  edge.integral.append(unbounded.integral, stretch.from, stretch.to);
  const auto add_chip = [&](double h) {
    peak_chip_ = std::max(peak_chip_, edge.sin_kappa * h);
  };
  for (std::size_t i = 0; i + 1 < unbounded.ends.size(); i += 2) {
    const double from = std::max(unbounded.ends[i], stretch.from);
    const double to = std::min(unbounded.ends[i + 1], stretch.to);
    if (!(to > from)) continue;
    edge.ends.push_back(from);
    edge.ends.push_back(to);
    const double inner = inner_part * (to - from);
    for (const double theta : {from + inner, to - inner}) {
      add_chip(ray(*unbounded_, unbounded, theta).h);
    }
    const Crest& crest = unbounded.crests[i / 2];
    if (crest.theta > from && crest.theta < to) add_chip(crest.h);
  }
}

void ArcTurn::add_stretch(const Layer& layer, Edge& edge, double from, double to) {
  const int n = std::max(4, static_cast<int>(std::ceil((to - from) / look)));
  const double a_little = inner_part * (to - from);
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
      add_smooth(layer, edge, {start, end}, bound / 2);
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

/// Where the parabola through three places is largest; the middle one if it has no top.
double top_of_parabola(const std::array<double, 3>& x, const std::array<double, 3>& f) {
  const double left = (f[1] - f[0]) / (x[1] - x[0]);
  const double right = (f[2] - f[1]) / (x[2] - x[1]);
  const double bend = (right - left) / (x[2] - x[0]);
  if (!(bend < 0)) return x[1];
  return std::clamp(0.5 * (x[0] + x[1]) - 0.5 * left / bend, x[0], x[2]);
}

/// The largest chip near the largest one of some.
template <class Crest, class Chip>
Crest crest_near(const Chip& h_at, Crest best, geometry::Arc piece) {
  // Neighbouring nodes are at most this far from the largest one.
  double reach = std::min(0.14, 0.25 * (piece.to - piece.from));
  for (int i = 0; i < 2; ++i, reach /= 6) {
    const double at = best.theta;
    const std::array<double, 3> x{std::max(at - reach, piece.from), at,
                                  std::min(at + reach, piece.to)};
    if (!(x[0] < at && at < x[2])) break;
    const std::array<double, 3> h{h_at(x[0]), best.h, h_at(x[2])};
    const double top = top_of_parabola(x, h);
    for (const Crest& one :
         {Crest{x[0], h[0]}, Crest{x[2], h[2]}, Crest{top, h_at(top)}}) {
      if (one.h > best.h) best = one;
    }
  }
  return best;
}

}  // namespace

void ArcTurn::add_smooth(const Layer& layer, Edge& edge, geometry::Arc piece,
                         int mark) {
  edge.ends.push_back(piece.from);
  edge.ends.push_back(piece.to);
  const auto h_at = [&](double theta) { return chip_over(layer, edge, mark, theta); };
  Crest crest{piece.from, 0.0};
  const double inner = inner_part * (piece.to - piece.from);
  for (const double theta : {piece.from + inner, piece.to - inner}) {
    const double h = h_at(theta);
    if (h > crest.h) crest = {theta, h};
  }
  const auto f = [&](double theta) {
    const double h = h_at(theta);
    if (h > crest.h) crest = {theta, h};
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
  crest = crest_near(h_at, crest, {piece.from + inner, piece.to - inner});
  edge.crests.push_back(crest);
  peak_chip_ = std::max(peak_chip_, edge.sin_kappa * crest.h);
}

}  // namespace trochoid::force
