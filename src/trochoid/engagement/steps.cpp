#include <trochoid/engagement/steps.h>

#include <trochoid/base/units.h>
#include <trochoid/engagement/causes.h>
#include <trochoid/engagement/look.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/stock/swept.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace trochoid::engagement {

namespace {

/// Steps that are looked at together.
constexpr std::size_t batch = 8192;
/// Turns that are kept at most.
constexpr std::size_t most_turns = 20000;

/// The same where a map of heights follows them: it stands at the first of them.
constexpr std::size_t batch_with_map = 512;

/// Looks at steps and adds their forces.
class Steps {
 public:
  explicit Steps(const Job& job) : job_(job), look_(job) {}

  [[nodiscard]] const Look& look() const noexcept { return look_; }
  void sweep_to(double turns) { look_.sweep_to(turns); }

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
      if (found[i].turn.layers.empty() || !feeds(found[i].turn)) continue;
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

  const Job& job_;
  Look look_;
  std::unordered_map<TurnKey, std::size_t, TurnKeyHash> turns_;
  std::vector<TurnLoads> loads_;
  std::int64_t distinct_ = 0;
};

void raise(Peak& peak, double value, const Step& step) {
  if (std::abs(value) > std::abs(peak.value)) {
    peak = {value, step.line, step.place, step.cause, step.step, step.tool};
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
    find_causes(steps_.look().path(), steps_.look().all_kinks(), traits_, line_);
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
        const auto n = static_cast<double>(row.count);
        const auto m = static_cast<double>(step.count);
        row.along = (n * row.along + m * step.along) / (n + m);
        row.count += step.count;
        row.turns += step.turns;
        row.duration += step.duration;
        steps_.look().put(row, piece);
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

/// @param asks  in the order of the program
void look_all(Steps& steps, std::span<const Ask> asks, std::vector<Found>& found,
              std::span<const double> heights) {
  found.resize(asks.size());
  if (!asks.empty()) steps.sweep_to(steps.look().turns_of(asks.front()) - 1);
  numerics::for_each_index(
      asks.size(), [&](std::size_t i) { found[i] = steps.look().at(asks[i], heights); },
      steps.look().swept().map() == nullptr ? 256 : 8);
}

/// Of the whole program [m^3].
double volume_removed(const Job& job, Steps& steps) {
  steps.sweep_to(std::numeric_limits<double>::infinity());
  const stock::Swept& swept = steps.look().swept();
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < job.tools.size(); ++i) {
    const double R = swept.radius(static_cast<std::int16_t>(i));
    if (R > 0) smallest = std::min(smallest, R);
  }
  constexpr std::size_t a_long_path = 5000;
  const double lines = swept.path().pieces.size() > a_long_path ? 100.0 : 200.0;
  return std::isfinite(smallest) ? stock::volume_removed(swept, smallest / lines) : 0.0;
}

/// Whether a rapid goes through stock: looked at every half radius.
bool hits_stock(const stock::Swept& swept, std::uint32_t index) {
  const stock::Piece& piece = swept.path().pieces[index];
  const stock::Wall& wall = swept.wall(piece.tool);
  const double R = wall.largest();
  const double top = stock::heights(swept.initial()).top;
  if (!(R > 0) || std::min(piece.from[2], piece.to[2]) >= top) return false;
  const int n = static_cast<int>(2 * piece.length / R) + 1;
  for (int k = 1; k <= n; ++k) {
    const stock::PathPoint at = stock::point_at(piece, static_cast<double>(k) / n);
    const stock::Surroundings around(
        swept,
        {at.place, piece.upright() ? 0.0 : at.direction, piece.turns_from, index, true},
        R);
    const double high = std::min(top, std::max(piece.from[2], piece.to[2]));
    const double z = std::max(0.5 * (high - at.place[2]), 1e-6);
    const double r = wall.radius(z);
    if (r > 0 && at.place[2] + z < top && !around.arcs(z, r * 0.999).empty()) {
      return true;
    }
  }
  return false;
}

}  // namespace

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
  const stock::Path& path = steps.look().path();
  std::vector<Ask> asks;
  std::vector<Found> found;
  std::int64_t number = 0;
  bool stands = false;
  bool through = false;
  const std::size_t together =
      steps.look().swept().map() == nullptr ? batch : batch_with_map;
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
    if (!(piece.feed > 0) && !through && hits_stock(steps.look().swept(), i)) {
      through = true;
      out.warnings.push_back(
          {"rapid_through_stock",
           fmt::format(
               "line {}: a rapid move goes through stock; it counts as cut away",
               job.program.moves[piece.first].line)});
    }
    const std::int64_t n = count_of(piece, job.options.step_turns);
    for (std::int64_t k = 0; k < n; ++k) {
      asks.push_back(ask_of(path, i, k, n));
      asks.back().number = number++;
      if (asks.size() == together) {
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
  out.totals.stock_after = out.totals.stock_before - volume_removed(job, steps);
  return std::move(out);
}

std::vector<Step> steps_at(const Job& job, std::span<const PlaceRequest> places,
                           std::span<const double> heights) {
  Steps steps(job);
  const stock::Path& path = steps.look().path();
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
      const double turns = piece.length / piece.feed_per_turn();
      asks.push_back({path.piece_of[m], s / piece.length,
                      turns > 0 ? std::min(1.0, job.options.step_turns / turns) : 1.0,
                      0, m});
      of_place.push_back(i);
      break;
    }
  }
  std::vector<Found> found;
  // The stock follows them in the order of the program.
  std::vector<std::size_t> order(asks.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(
      order, {}, [&](std::size_t k) { return steps.look().turns_of(asks[k]); });
  for (const std::size_t k : order) {
    look_all(steps, std::span(&asks[k], 1), found, heights);
    steps.add_forces(found);
    find_causes(path, steps.look().all_kinks(), std::span(&found[0].traits, 1),
                std::span(&found[0].step, 1));
    out[of_place[k]] = std::move(found[0].step);
  }
  return out;
}

std::vector<TurnForces> forces_with(const Job& job, std::span<const std::int64_t> steps,
                                    std::span<const Tool> tools) {
  Look look(job);
  StepFinder finder(look.path(), job.options.step_turns);
  std::vector<std::size_t> order(steps.size());  // the stock follows the program
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t k) { return steps[k]; });
  std::vector<TurnForces> out(steps.size() * tools.size());
  for (const std::size_t k : order) {
    if (steps[k] < 0) continue;
    const Ask ask = finder.find(steps[k]);
    look.sweep_to(look.turns_of(ask) - 1);
    const Found found = look.at(ask);
    if (found.turn.layers.empty() || !feeds(found.turn)) continue;
    numerics::for_each_index(
        tools.size(),
        [&](std::size_t i) {
          out[k * tools.size() + i] = in_program(
              loads_of(found.turn, tools[i]), found.step.direction, found.step.spindle);
        },
        1);
  }
  return out;
}

}  // namespace trochoid::engagement
