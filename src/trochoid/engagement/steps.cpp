#include <trochoid/engagement/steps.h>

#include <trochoid/base/units.h>
#include <trochoid/engagement/causes.h>
#include <trochoid/engagement/contact.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/stock/swept.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace trochoid::engagement {

namespace {

/// Steps that are looked at together.
constexpr std::size_t batch = 8192;
/// Turns that are kept at most.
constexpr std::size_t most_turns = 20000;

/// Radius of the longest tooth: where walls stand.
double wall_radius(const Tool& tool) {
  if (!tool.cuts) return 0.0;
  const double r = tool.cutter.profile.D / 2;
  const std::vector<double> psi = geometry::tooth_angles(tool.cutter);
  std::vector<geometry::EdgePosition> teeth(psi.size());
  const geometry::Runout runout =
      chip::feels_runout(tool.chip.model) ? tool.runout : geometry::Runout{};
  double largest = 0.0;
  // With an eccentricity the longest tooth changes along a helix: the envelope stands.
  const int places = runout.eccentricity > 0 && tool.cutter.helix > 0 ? 64 : 1;
  for (int i = 0; i < places; ++i) {
    geometry::edge_positions(runout, psi, r, unit::turn * i / places, teeth);
    for (const geometry::EdgePosition& tooth : teeth) {
      largest = std::max(largest, tooth.R);
    }
  }
  return largest;
}

void check(const Tool& tool) {
  if (tool.cuts && !takes(tool.cutter)) {
    throw std::invalid_argument(
        "forces along a program are computed for flat end mills of constant lead");
  }
}

/// Program::tools may be empty: then the one tool there is.
std::int16_t tool_of(const Job& job, std::int16_t tool) {
  if (tool >= 0) {
    if (static_cast<std::size_t>(tool) >= job.tools.size()) {
      throw std::invalid_argument("a move has a tool that is not given");
    }
    return tool;
  }
  return job.tools.empty() ? std::int16_t{-1} : std::int16_t{0};
}

stock::Swept sweep(const Job& job) {
  std::vector<double> radius;
  for (const Tool& tool : job.tools) {
    check(tool);
    radius.push_back(wall_radius(tool));
  }
  stock::Path path = stock::path(job.program.moves, job.options.rapid_feed);
  for (stock::Piece& piece : path.pieces) {
    piece.tool = tool_of(job, piece.tool);
  }
  return {std::move(path), job.stock, std::move(radius)};
}

/// Steps of a piece.
std::int64_t count_of(const stock::Piece& piece, double step_turns) noexcept {
  if (!(piece.feed > 0)) return 0;
  const double turns = piece.turns_to - piece.turns_from;
  return std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(turns / step_turns - 1e-9)));
}

/// A step to be looked at.
struct Ask {
  std::uint32_t piece = 0;
  double u = 0.0;      ///< place of its middle on the piece
  double share = 0.0;  ///< of the piece that it is
  std::int64_t number = 0;
  std::uint32_t move = 0;
};

/// What was found of it.
struct Found {
  Step step;
  StepTraits traits;
  Turn turn;
};

std::uint32_t move_at(const stock::Path& path, const stock::Piece& piece, double s) {
  const auto first = path.begins.begin() + piece.first;
  const auto last = path.begins.begin() + piece.last + 1;
  const auto after = std::upper_bound(first, last, s);
  return piece.first +
         static_cast<std::uint32_t>(std::max<std::ptrdiff_t>(after - first, 1) - 1);
}

class Steps {
 public:
  explicit Steps(const Job& job)
      : job_(job),
        swept_(sweep(job)),
        kinks_(kinks(swept_.path())),
        lengths_(feed_lengths(swept_.path())) {}

  [[nodiscard]] const stock::Swept& swept() const noexcept { return swept_; }
  [[nodiscard]] std::span<const Kink> all_kinks() const noexcept { return kinks_; }

  [[nodiscard]] Found look(const Ask& ask, std::span<const double> heights) const {
    const stock::Piece& piece = swept_.path().pieces[ask.piece];
    const program::Move& move = job_.program.moves[ask.move];
    const double turns = piece.turns_to - piece.turns_from;
    Found out{.step = bare_step(ask), .traits = {.piece = ask.piece}, .turn = {}};
    Step& step = out.step;
    StepTraits& traits = out.traits;
    traits.at = lengths_[ask.piece] + ask.u * piece.length;
    traits.R = swept_.radius(piece.tool);
    step.line = move.line;
    step.block = move.block;
    if (!(traits.R > 0) || !(turns > 0)) {
      step.flags |= turns > 0 ? 0U : static_cast<std::uint32_t>(spindle_stands);
      return out;
    }
    const Tool& tool = job_.tools[static_cast<std::size_t>(piece.tool)];
    const double f = piece.feed_per_turn();
    traits.f_h = f * piece.horizontal / piece.length;
    traits.f_a = f * (piece.from[2] - piece.to[2]) / piece.length;
    step.f_z = traits.f_h / tool.cutter.teeth();
    step.curvature = piece.arc() ? std::copysign(1 / piece.radius, piece.turn) : 0.0;
    Contact contact =
        engagement::contact(swept_, ask.piece, ask.u,
                            {.R = traits.R,
                             .feed = ask.share * piece.length,
                             .turns = step.turns,
                             .bottom = true,
                             .layers = heights.empty(),
                             .heights = {heights.begin(), heights.end()}});
    describe(contact, tool, step, traits);
    out.turn = {piece.tool, step.f_z, step.curvature, std::move(contact.layers)};
    if (!heights.empty()) {  // forces are those of all the heights between
      out.turn.layers = engagement::contact(swept_, ask.piece, ask.u,
                                            {.R = traits.R, .bottom = false})
                            .layers;
    }
    return out;
  }

  /// Forces of turns, each different one once, in parallel.
  void add_forces(std::span<Found> found) {
    if (turns_.size() > most_turns) {
      turns_.clear();
      loads_.clear();
    }
    std::vector<std::size_t> place(found.size());
    std::vector<std::size_t> fresh;  // which of them is the first of its kind
    constexpr std::size_t none = static_cast<std::size_t>(-1);
    for (std::size_t i = 0; i < found.size(); ++i) {
      place[i] = none;
      if (found[i].turn.layers.empty() || !(found[i].step.f_z > 0)) continue;
      const auto [at, is_new] =
          turns_.try_emplace(key_of(found[i].turn), loads_.size() + fresh.size());
      if (is_new) fresh.push_back(i);
      place[i] = at->second;
    }
    distinct_ += static_cast<std::int64_t>(fresh.size());
    const std::size_t first = loads_.size();
    loads_.resize(first + fresh.size());
    numerics::for_each_index(
        fresh.size(),
        [&](std::size_t i) {
          const Turn& turn = found[fresh[i]].turn;
          loads_[first + i] =
              loads_of(turn, job_.tools[static_cast<std::size_t>(turn.tool)]);
        },
        4);
    for (std::size_t i = 0; i < found.size(); ++i) {
      Step& step = found[i].step;
      if (place[i] != none) {
        step.forces = in_program(loads_[place[i]], step.direction, step.spindle);
      } else {
        step.forces.peak_of_tooth.assign(teeth_of(step.tool), 0.0);
      }
    }
  }

  [[nodiscard]] std::int64_t distinct() const noexcept { return distinct_; }

 private:
  [[nodiscard]] std::size_t teeth_of(std::int16_t tool) const {
    return tool < 0 ? 0
                    : job_.tools[static_cast<std::size_t>(tool)].cutter.pitch.size();
  }

  [[nodiscard]] Step bare_step(const Ask& ask) const {
    const stock::Piece& piece = swept_.path().pieces[ask.piece];
    const stock::PathPoint point = stock::point_at(piece, ask.u);
    const double time = piece.time_to - piece.time_from;
    Step step;
    step.step = ask.number;
    step.tool = piece.tool;
    step.move = ask.move;
    step.turns = ask.share * (piece.turns_to - piece.turns_from);
    step.time = piece.time_from + ask.u * time;
    step.duration = ask.share * time;
    step.place = point.place;
    step.direction = point.direction;
    if (std::isfinite(step.direction)) {
      step.direction -= unit::turn * std::floor(step.direction / unit::turn);
    }
    step.spindle = piece.spindle;
    step.feed = piece.feed;
    step.programmed_feed = piece.feed;
    return step;
  }

  void describe(const Contact& contact, const Tool& tool, Step& step,
                StepTraits& traits) const {
    double area = 0.0;
    bool thin = false;
    for (const geometry::ArcLayer& layer : contact.layers) {
      Layer& row = step.layers.emplace_back(Layer{layer.from, layer.to, {}});
      for (const geometry::EngagedArc& arc : layer.arcs) row.arcs.push_back(arc.arc);
      const double height = layer.to - layer.from;
      if (height < job_.options.floor || layer.arcs.empty()) {
        thin = true;
        continue;
      }
      const ArcSum sum = sum_of(layer, traits.R);
      step.a_p += height;
      area += height * sum.width;
      if (sum.angle > step.engaged) {
        step.engaged = sum.angle;
        step.entry = layer.arcs.front().arc.from;
        step.exit = layer.arcs.back().arc.to;
      }
    }
    step.a_e = step.a_p > 0 ? area / step.a_p : 0.0;
    step.removed = contact.flank_volume + contact.bottom_volume;
    step.removal_rate = step.removed / step.duration;
    traits.bottom = traits.f_a > 0 && contact.bottom_length > 0;
    traits.stock = step.a_p > 0 || traits.bottom;
    if (thin && !traits.stock) step.flags |= thin_layer;
    if (tool.flute_length > 0 && step.a_p > tool.flute_length) {
      step.flags |= rubs_above_flute;
    }
    if (traits.bottom && job_.options.bottom == Bottom::estimate) {
      // N-11
      const force::Terms law = force::terms(tool.law);
      const int teeth = tool.cutter.teeth();
      const force::ColumnWeights w =
          force::column_weights(law.form, traits.f_a / teeth, 1.0, 1.0);
      step.bottom_force = teeth * contact.bottom_length *
                          (law.K[1] * w.cutting[1] + law.K_e[1] * w.edge);
      step.bottom_torque = teeth * contact.bottom_moment *
                           (law.K[0] * w.cutting[0] + law.K_e[0] * w.edge);
    }
  }

  const Job& job_;
  stock::Swept swept_;
  std::vector<Kink> kinks_;
  std::vector<double> lengths_;
  std::unordered_map<TurnKey, std::size_t, TurnKeyHash> turns_;
  std::vector<TurnLoads> loads_;
  std::int64_t distinct_ = 0;
};

void raise(Peak& peak, double value, const Step& step) {
  if (std::abs(value) > std::abs(peak.value)) {
    peak = {value, step.line, step.place, step.cause};
  }
}

/// Takes the steps of a line, gives rows, and adds up.
class Rows {
 public:
  Rows(const Steps& steps, const Sink& sink) : steps_(steps), sink_(sink) {}

  void add(std::span<Found> found) {
    for (Found& f : found) {
      if (!line_.empty() && line_.back().line != f.step.line) finish_line();
      line_.push_back(std::move(f.step));
      traits_.push_back(f.traits);
    }
  }

  void finish_line() {
    if (line_.empty()) return;
    find_causes(steps_.swept().path(), steps_.all_kinks(), traits_, line_);
    Line line{.line = line_.front().line, .tool = line_.front().tool};
    double largest = -1.0;
    for (std::size_t i = 0; i < line_.size(); ++i) {
      const Step& step = line_[i];
      const bool cuts = traits_[i].stock;
      add_up(step, cuts, line);
      if (step.forces.peak_xy > largest) {
        largest = step.forces.peak_xy;
        line.place = step.place;
      }
    }
    line.cause = cause_of_line(line_);
    summary.lines.push_back(line);
    join_air();
    if (sink_) sink_(line_);
    line_.clear();
    traits_.clear();
  }

  Summary summary;

 private:
  void add_up(const Step& step, bool cuts, Line& line) {
    const TurnForces& F = step.forces;
    Totals& all = summary.totals;
    const double tooth =
        F.peak_of_tooth.empty() ? 0.0 : *std::ranges::max_element(F.peak_of_tooth);
    line.time += step.duration;
    line.steps += step.turns;
    line.removed += step.removed;
    all.removed += step.removed;
    if (cuts) {
      line.time_in_cut += step.duration;
      all.time_in_cut += step.duration;
    }
    line.peak_xy = std::max(line.peak_xy, F.peak_xy);
    line.peak_tooth = std::max(line.peak_tooth, tooth);
    line.torque_peak = std::max(line.torque_peak, F.torque_peak);
    line.power = std::max(line.power, F.power);
    line.moment_peak = std::max(line.moment_peak, F.moment_peak);
    line.deflection = std::max(line.deflection, F.deflection);
    line.peak_chip = std::max(line.peak_chip, F.peak_chip);
    raise(all.peak_xy, F.peak_xy, step);
    raise(all.peak_tooth, tooth, step);
    raise(all.torque, F.torque_peak, step);
    raise(all.power, F.power, step);
    raise(all.moment, F.moment_peak, step);
    raise(all.deflection, F.deflection, step);
    raise(all.chip, F.peak_chip, step);
  }

  /// Steps in air that follow one another on a piece become one row.
  void join_air() {
    std::vector<Step> rows;
    std::uint32_t piece = 0;
    for (std::size_t i = 0; i < line_.size(); ++i) {
      Step& step = line_[i];
      const bool air = !traits_[i].stock && step.layers.empty();
      if (air && !rows.empty() && rows.back().cause == Cause::air &&
          rows.back().layers.empty() && rows.back().flags == step.flags &&
          piece == traits_[i].piece) {
        Step& row = rows.back();
        const double end = step.time + 0.5 * step.duration;
        row.count += step.count;
        row.turns += step.turns;
        row.duration += step.duration;
        row.time = end - 0.5 * row.duration;
        const stock::Piece& p = steps_.swept().path().pieces[piece];
        const auto middle =
            stock::point_at(p, (row.time - p.time_from) / (p.time_to - p.time_from));
        row.place = middle.place;
        if (std::isfinite(middle.direction)) {
          row.direction =
              middle.direction - unit::turn * std::floor(middle.direction / unit::turn);
        }
        continue;
      }
      piece = traits_[i].piece;
      rows.push_back(std::move(step));
    }
    line_ = std::move(rows);
  }

  const Steps& steps_;
  const Sink& sink_;
  std::vector<Step> line_;
  std::vector<StepTraits> traits_;
};

void look_all(const Steps& steps, std::span<const Ask> asks, std::vector<Found>& found,
              std::span<const double> heights) {
  found.resize(asks.size());
  numerics::for_each_index(
      asks.size(), [&](std::size_t i) { found[i] = steps.look(asks[i], heights); },
      256);
}

/// Rapids through stock: looked at every half radius.
void warn_rapids(const Job& job, const stock::Swept& swept, Summary& out) {
  const stock::Path& path = swept.path();
  const double top = stock::heights(swept.initial()).top;
  for (std::uint32_t i = 0; i < path.pieces.size(); ++i) {
    const stock::Piece& piece = path.pieces[i];
    const double R = swept.radius(piece.tool);
    if (piece.feed > 0 || !(R > 0) || std::min(piece.from[2], piece.to[2]) >= top) {
      continue;
    }
    const int n = static_cast<int>(2 * piece.length / R) + 1;
    for (int k = 1; k <= n; ++k) {
      const stock::PathPoint at = stock::point_at(piece, static_cast<double>(k) / n);
      const stock::Surroundings around(
          swept,
          {at.place, piece.upright() ? 0.0 : at.direction, piece.turns_from, i, true},
          R);
      const double high = std::min(top, std::max(piece.from[2], piece.to[2]));
      const double z = std::max(0.5 * (high - at.place[2]), 1e-6);
      if (at.place[2] + z < top && !around.arcs(z, R * 0.999).empty()) {
        out.warnings.push_back(
            {"rapid_through_stock",
             fmt::format(
                 "line {}: a rapid move goes through stock; it counts as cut away",
                 job.program.moves[piece.first].line)});
        return;
      }
    }
  }
}

}  // namespace

bool takes(const geometry::Cutter& cutter) noexcept {
  const geometry::Profile& p = cutter.profile;
  return p.R == 0 && p.alpha == 0 && p.beta == 0 &&
         cutter.lag_law == geometry::LagLaw::constant_lead;
}

double step_count(const Job& job) {
  const stock::Path path = stock::path(job.program.moves, job.options.rapid_feed);
  double sum = 0.0;
  for (const stock::Piece& piece : path.pieces) {
    sum += static_cast<double>(count_of(piece, job.options.step_turns));
  }
  return sum;
}

Summary compute_steps(const Job& job, const Sink& sink) {
  Steps steps(job);
  Rows rows(steps, sink);
  Summary& out = rows.summary;
  const stock::Path& path = steps.swept().path();
  std::vector<Ask> asks;
  std::vector<Found> found;
  std::int64_t number = 0;
  bool stands = false;
  const auto run = [&] {
    look_all(steps, asks, found, {});
    steps.add_forces(found);
    for (const Found& f : found) {
      if ((f.step.flags & spindle_stands) != 0 && !std::exchange(stands, true)) {
        out.warnings.push_back(
            {"spindle_stands",
             fmt::format("line {}: the feed moves while the spindle stands: no forces",
                         f.step.line)});
      }
    }
    rows.add(found);
    asks.clear();
  };
  for (std::uint32_t i = 0; i < path.pieces.size() && out.complete; ++i) {
    const stock::Piece& piece = path.pieces[i];
    const std::int64_t n = count_of(piece, job.options.step_turns);
    for (std::int64_t k = 0; k < n; ++k) {
      const double u = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
      asks.push_back({i, u, 1.0 / static_cast<double>(n), number++,
                      move_at(path, piece, u * piece.length)});
      if (asks.size() == batch) {
        run();
        if (job.options.stop.wanted()) {
          out.complete = false;
          break;
        }
      }
    }
  }
  run();
  rows.finish_line();
  out.totals.time = path.time;
  out.totals.steps = number;
  out.totals.distinct_turns = steps.distinct();
  out.totals.stock_before = stock::volume(job.stock);
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < job.tools.size(); ++i) {
    const double R = steps.swept().radius(static_cast<std::int16_t>(i));
    if (R > 0) smallest = std::min(smallest, R);
  }
  out.totals.stock_after =
      out.totals.stock_before -
      (std::isfinite(smallest) ? stock::volume_removed(steps.swept(), smallest / 200)
                               : 0.0);
  warn_rapids(job, steps.swept(), out);
  return std::move(out);
}

std::vector<Step> steps_at(const Job& job, std::span<const PlaceRequest> places,
                           std::span<const double> heights) {
  Steps steps(job);
  const stock::Path& path = steps.swept().path();
  const auto& moves = job.program.moves;
  std::vector<Ask> asks;
  std::vector<std::size_t> of_place;
  std::vector<Step> out(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    out[i].line = places[i].line;
    out[i].count = 0;
    for (std::uint32_t m = 0; m < moves.size(); ++m) {
      const bool feeds = moves[m].feed > 0 &&
                         moves[m].kind != program::MoveKind::rapid &&
                         moves[m].kind != program::MoveKind::dwell;
      if (moves[m].line != places[i].line || !feeds || !std::isfinite(path.begins[m])) {
        continue;
      }
      const stock::Piece& piece = path.pieces[path.piece_of[m]];
      const double end = m == piece.last ? piece.length : path.begins[m + 1];
      const double s = path.begins[m] + places[i].fraction * (end - path.begins[m]);
      const double turns = piece.turns_to - piece.turns_from;
      asks.push_back({path.piece_of[m], s / piece.length,
                      turns > 0 ? std::min(1.0, job.options.step_turns / turns) : 1.0,
                      0, m});
      of_place.push_back(i);
      break;
    }
  }
  std::vector<Found> found;
  look_all(steps, asks, found, heights);
  steps.add_forces(found);
  for (std::size_t k = 0; k < found.size(); ++k) {
    find_causes(path, steps.all_kinks(), std::span(&found[k].traits, 1),
                std::span(&found[k].step, 1));
    out[of_place[k]] = std::move(found[k].step);
  }
  return out;
}

}  // namespace trochoid::engagement
