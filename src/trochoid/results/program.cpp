#include <trochoid/results/program.h>

#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/program_steps.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

using program::Move;
using program::MoveKind;

constexpr double empty_field = std::numeric_limits<double>::quiet_NaN();

bool is_fed(const Move& move) noexcept {
  return move.kind != MoveKind::rapid && move.kind != MoveKind::dwell;
}

/// NaN is an empty field.
const Columns<ProgramResult>& move_columns() {
  using R = const ProgramResult&;
  const auto of = [](auto get) {
    return [get](R r, std::size_t i) { return given(get(r.program.moves[i])); };
  };
  const auto of_arc = [](auto get) {
    return [get](R r, std::size_t i) {
      const Move& m = r.program.moves[i];
      return given(m.kind == MoveKind::arc ? get(m) : empty_field);
    };
  };
  static const Columns<ProgramResult> all{
      "moves.csv",
      [](R r) { return r.program.moves.size(); },
      {{"move", "from 0", [](R, std::size_t i) { return i; }},
       {"line", "of the text, from 1",
        [](R r, std::size_t i) { return r.program.moves[i].line; }},
       {"block", "its N number; empty: it has none",
        [](R r, std::size_t i) {
          const auto block = r.program.moves[i].block;
          return block < 0 ? empty_field : static_cast<double>(block);
        }},
       {"kind",
        "`rapid`, `line` (plunges too), `arc` (in G17, helices too), `chord` (a piece of "
        "an arc in G18 or G19), `dwell`",
        [](R r, std::size_t i) { return name_of(r.program.moves[i].kind); }},
       {"note",
        "`cycle`: of a drilling cycle; `retract`: to a place that is not in the program "
        "(G28, G30, G53, SUPA); `start`: where `start_mm` of [program] says",
        [](R r, std::size_t i) { return name_of(r.program.moves[i].note); }},
       {"x_mm", "end of the move in the frame of the stock; empty: not known",
        of([](const Move& m) { return m.end[0]; })},
       {"y_mm", "the same", of([](const Move& m) { return m.end[1]; })},
       {"z_mm", "the same", of([](const Move& m) { return m.end[2]; })},
       {"center_x_mm", "of an arc", of_arc([](const Move& m) { return m.center[0]; })},
       {"center_y_mm", "of an arc", of_arc([](const Move& m) { return m.center[1]; })},
       {"turn_deg", "of an arc, positive counter-clockwise",
        of_arc([](const Move& m) { return m.turn; })},
       {"time_s", "that the move takes", of([](const Move& m) { return m.time; })},
       {"feed_mm_per_min", "along the path; empty: a rapid or a dwell",
        of([](const Move& m) { return is_fed(m) ? m.feed : empty_field; })},
       {"spindle_rpm", "0: it stands", of([](const Move& m) { return m.spindle; })},
       {"tool", "number or name; empty: neither T nor M6 before",
        [](R r, std::size_t i) {
          const std::int16_t tool = r.program.moves[i].tool;
          return tool < 0 ? std::string()
                          : r.program.tools[static_cast<std::size_t>(tool)];
        }}}};
  return all;
}

double total_time(const ProgramResult& r) noexcept {
  double time = 0.0;
  for (const Move& move : r.program.moves) time += move.time;
  return time;
}

/// A peak as summary.json has it: its value in the unit of the key.
struct NamedPeak {
  engagement::Peak peak;
  double unit = 1.0;
  std::optional<double> error;  ///< half of its interval
};

const Fields<NamedPeak>& peak_fields() {
  using P = const NamedPeak&;
  const auto has_error = [](P p) { return p.error.has_value(); };
  static const Fields<NamedPeak> all{
      {"value", "in the unit of the key above",
       [](P p) { return as_named(p.peak.value / p.unit); }},
      {"line", "of the text", [](P p) { return p.peak.line; }},
      {"x_mm", "tip there", [](P p) { return given(p.peak.place[0]); }},
      {"y_mm", "the same", [](P p) { return given(p.peak.place[1]); }},
      {"z_mm", "the same", [](P p) { return given(p.peak.place[2]); }},
      {"cause", "as in steps.csv", [](P p) { return name_of(p.peak.cause); }},
      {"low", "of the 95 % interval that `[program] covariance` gives",
       [](P p) { return as_named((p.peak.value - p.error.value_or(0.0)) / p.unit); },
       has_error},
      {"high", "the same",
       [](P p) { return as_named((p.peak.value + p.error.value_or(0.0)) / p.unit); },
       has_error}};
  return all;
}

const Fields<ProgramForces>& peaks_fields() {
  using F = const ProgramForces&;
  using E = PeakErrors;
  const auto of = [](engagement::Peak engagement::Totals::*which,
                     std::optional<double> E::*error, double unit) {
    return [which, error, unit](F f) {
      return NamedPeak{f.summary.totals.*which, unit,
                       f.errors ? (*f.errors).*error : std::nullopt};
    };
  };
  using T = engagement::Totals;
  static const Fields<ProgramForces> all{
      {"peak_xy_N", "largest force across the axis", peak_fields(),
       of(&T::peak_xy, &E::peak_xy, 1.0)},
      {"peak_tooth_N", "the same of one tooth", peak_fields(),
       of(&T::peak_tooth, &E::peak_tooth, 1.0)},
      {"torque_peak_Nm", "largest torque", peak_fields(),
       of(&T::torque, &E::torque, 1.0)},
      {"power_W", "largest mean power of a turn", peak_fields(),
       of(&T::power, &E::power, 1.0)},
      {"moment_peak_Nm", "largest bending moment", peak_fields(),
       of(&T::moment, &E::moment, 1.0)},
      {"deflection_um", "largest deflection of the tip", peak_fields(),
       of(&T::deflection, &E::deflection, unit::um)},
      {"peak_chip_mm", "largest uncut chip thickness", peak_fields(),
       of(&T::chip, &E::chip, unit::mm)}};
  return all;
}

const Fields<BrokenLimit>& broken_fields() {
  using B = const BrokenLimit&;
  static const Fields<BrokenLimit> all{
      {"limit", "its key under [limits], or `power_curve_W` of [machine]",
       [](B b) { return b.limit; }},
      {"allowed", "in the unit of that key", [](B b) { return as_named(b.allowed); }},
      {"worst", "the same", [](B b) { return as_named(b.worst); }},
      {"lines", "that go beyond it", [](B b) { return b.lines; }}};
  return all;
}

const Fields<FeedTotals>& feed_total_fields() {
  using T = const FeedTotals&;
  static const Fields<FeedTotals> all{
      {"time_s", "of all moves", [](T t) { return t.time; }},
      {"time_in_cut_s", "of the steps that cut", [](T t) { return t.time_in_cut; }},
      {"peak_xy_N", "largest force across the axis", [](T t) { return t.peak_xy; }},
      {"peak_tooth_N", "the same of one tooth", [](T t) { return t.peak_tooth; }}};
  return all;
}

const Fields<NewFeeds>& feed_fields() {
  using F = const NewFeeds&;
  static const Fields<NewFeeds> all{
      {"file", "the program with the new feeds, in this folder; empty: none is written",
       [](F f) { return f.file; }},
      {"before", "the program as it is", feed_total_fields(),
       [](F f) { return std::optional(f.before); }},
      {"after", "the program with the new feeds, read and run again",
       feed_total_fields(), [](F f) { return std::optional(f.after); }},
      {"even_peak_N", "force that `even` makes the others like",
       [](F f) { return f.even_peak; }, [](F f) { return f.even_peak.has_value(); }},
      {"not_reachable", "lines where even the lowest feed breaks a limit",
       [](F f) { return f.not_reachable; }},
      {"rubbing", "lines whose largest chip stays below the lower number of `chip_mm`",
       [](F f) { return f.rubbing; }}};
  return all;
}

const Fields<ChatteringLine>& chattering_fields() {
  using C = const ChatteringLine&;
  static const Fields<ChatteringLine> all{
      {"line", "of the text", [](C c) { return c.line; }},
      {"margin", "the least of its steps: limit depth over axial depth",
       [](C c) { return c.margin; }},
      {"limit_depth_mm", "of that step", [](C c) { return c.limit_depth; }},
      {"frequency_Hz", "of the chatter", [](C c) { return c.frequency; }},
      {"spindle_rpm", "of that step", [](C c) { return c.spindle; }},
      {"better_spindle_rpm",
       "the nearest within 30 % at which that step is stable, with the same feed of a "
       "tooth",
       [](C c) { return c.better_spindle; },
       [](C c) { return c.better_spindle.has_value(); }}};
  return all;
}

const Fields<ProgramChatter>& chatter_fields() {
  using C = const ProgramChatter&;
  static const Fields<ProgramChatter> all{
      {"cuts", "different ones along the program", [](C c) { return c.cuts.size(); }},
      {"looked_at", "part of the time in cut for which the limit is known",
       [](C c) { return c.looked_at; }},
      {"lines", "that chatter", chattering_fields(), [](C c) { return c.lines; }}};
  return all;
}

std::string_view name_of_side(bool left) {
  return left ? "left" : "right";
}

const Fields<WallExtreme>& wall_extreme_fields() {
  using W = const WallExtreme&;
  static const Fields<WallExtreme> all{
      {"error_um", "positive: material left", [](W w) { return given(w.error); }},
      {"line", "of the text", [](W w) { return w.line; }},
      {"side", "`left` or `right` of the feed",
       [](W w) { return name_of_side(w.left); }},
      {"x_mm", "tip there", [](W w) { return given(w.place[0]); }},
      {"y_mm", "the same", [](W w) { return given(w.place[1]); }},
      {"z_mm", "the same", [](W w) { return given(w.place[2]); }}};
  return all;
}

const Fields<LineWall>& line_wall_fields() {
  using W = const LineWall&;
  static const Fields<LineWall> all{
      {"line", "of the text", [](W w) { return w.line; }},
      {"side", "`left` or `right` of the feed",
       [](W w) { return name_of_side(w.left); }},
      {"least_um", "error, over its height and along the line: positive: material left",
       [](W w) { return given(w.error.least); }},
      {"most_um", "the same", [](W w) { return given(w.error.most); }},
      {"mean_um", "the same", [](W w) { return given(w.error.mean); }}};
  return all;
}

const Fields<ProgramWalls>& wall_fields() {
  using W = const ProgramWalls&;
  static const Fields<ProgramWalls> all{
      {"most", "most material left on a wall that stays", wall_extreme_fields(),
       [](W w) { return w.most; }, [](W w) { return w.most.has_value(); }},
      {"least", "least, or cut deepest into such a wall", wall_extreme_fields(),
       [](W w) { return w.least; }, [](W w) { return w.least.has_value(); }},
      {"lines", "that leave a wall that stays", line_wall_fields(),
       [](W w) { return w.lines; }}};
  return all;
}

const Fields<ProgramForces>& force_fields() {
  using F = const ProgramForces&;
  static const Fields<ProgramForces> all{
      {"time_in_cut_s", "of the steps that cut",
       [](F f) { return f.summary.totals.time_in_cut; }},
      {"steps", "turns of the spindle that were computed",
       [](F f) { return f.summary.totals.steps; }},
      {"distinct_turns", "different ones among them",
       [](F f) { return f.summary.totals.distinct_turns; }},
      {"removed_mm3", "sum over the steps",
       [](F f) { return f.summary.totals.removed; }},
      {"stock_before_mm3", "volume of [stock]",
       [](F f) { return f.summary.totals.stock_before; }},
      {"stock_after_mm3", "what all moves leave of it",
       [](F f) { return f.summary.totals.stock_after; }},
      {"peaks", "largest values over the program, and where", peaks_fields(),
       [](F f) { return std::optional(f); }},
      {"limits_broken", "limits that lines go beyond", broken_fields(),
       [](F f) { return f.broken; }},
      {"feed", "the feeds of [feed]", feed_fields(), [](F f) { return f.feed; },
       [](F f) { return f.feed.has_value(); }},
      {"chatter", "whether the cuts chatter", chatter_fields(),
       [](F f) { return f.chatter; }, [](F f) { return f.chatter.has_value(); }},
      {"walls", "errors of the walls that stay, of flat tools with a [cutter_body]",
       wall_fields(), [](F f) { return f.walls; },
       [](F f) { return f.walls.has_value(); }},
      {"record", "the record of [[measurement]], laid over the program",
       record_fields(), [](F f) { return f.record; },
       [](F f) { return f.record.has_value(); }}};
  return all;
}

const Fields<ProgramResult>& program_fields() {
  using R = const ProgramResult&;
  static const Fields<ProgramResult> all{
      {"dialect", "`iso`, `linuxcnc` or `sinumerik`, as given or as found",
       [](R r) { return name_of(r.program.dialect); }},
      {"moves", "number of moves", [](R r) { return r.program.moves.size(); }},
      {"tools", "numbers or names, in the order of their first use",
       [](R r) { return r.program.tools; }},
      {"time_s", "of all moves",
       [](R r) { return r.forces ? r.forces->summary.totals.time : total_time(r); }},
      {"", "", force_fields(), [](R r) { return std::optional(*r.forces); },
       [](R r) { return r.forces.has_value(); }}};
  return all;
}

/// What the table says of walls and of chatter.
std::string walls_and_chatter(const ProgramForces& forces) {
  std::string out;
  if (forces.walls && forces.walls->most) {
    const ProgramWalls& walls = *forces.walls;
    out += fmt::format(
        "walls that stay: from {:.3g} um (line {}) to {:.3g} um (line {}); positive: "
        "material left\n",
        walls.least->error / unit::um, walls.least->line, walls.most->error / unit::um,
        walls.most->line);
  }
  if (forces.chatter) {
    const ProgramChatter& chatter = *forces.chatter;
    out += chatter.lines.empty()
               ? std::string("chatter: in no line\n")
               : fmt::format("chatter: in {} lines, line {} first\n",
                             chatter.lines.size(), chatter.lines.front().line);
  }
  return out;
}

std::string short_table(const ProgramResult& r) {
  std::size_t fed = 0;
  for (const Move& move : r.program.moves) fed += is_fed(move) ? 1U : 0U;
  std::string out = fmt::format(
      "dialect {}, {} moves, {} of them fed; tools: {}\n", name_of(r.program.dialect),
      r.program.moves.size(), fed,
      r.program.tools.empty() ? "the tool of the case"
                              : fmt::format("{}", fmt::join(r.program.tools, ", ")));
  if (!r.forces) return out + fmt::format("time: {:.6g} s\n", total_time(r));
  const engagement::Totals& all = r.forces->summary.totals;
  out += fmt::format("time: {:.6g} s, {:.6g} s of it in cut; removed: {:.6g} mm^3\n\n",
                     all.time, all.time_in_cut,
                     all.removed / (unit::mm * unit::mm * unit::mm));
  if (all.peak_xy.line == 0) return out;
  const std::optional<PeakErrors>& errors = r.forces->errors;
  out += fmt::format("{:<24}{:>12}{}{:>8}  {:<8}{}\n", "largest", "value",
                     errors ? fmt::format("{:>11}", "+- (95 %)") : "", "line", "cause",
                     "x, y, z mm");
  const auto row = [&](std::string_view name, const engagement::Peak& peak,
                       std::optional<double> PeakErrors::*error, double unit) {
    if (peak.line == 0) return;
    std::string interval;
    if (errors) {
      const std::optional<double> half = (*errors).*error;
      interval = fmt::format("{:>11}", half ? fmt::format("{:.2g}", *half / unit) : "");
    }
    out += fmt::format("{:<24}{:>12.4g}{}{:>8}  {:<8}{:.6g}, {:.6g}, {:.6g}\n", name,
                       peak.value / unit, interval, peak.line, name_of(peak.cause),
                       peak.place[0] / unit::mm, peak.place[1] / unit::mm,
                       peak.place[2] / unit::mm);
  };
  row("force across N", all.peak_xy, &PeakErrors::peak_xy, 1.0);
  row("force of a tooth N", all.peak_tooth, &PeakErrors::peak_tooth, 1.0);
  row("torque Nm", all.torque, &PeakErrors::torque, 1.0);
  row("power W", all.power, &PeakErrors::power, 1.0);
  row("bending moment Nm", all.moment, &PeakErrors::moment, 1.0);
  row("deflection um", all.deflection, &PeakErrors::deflection, unit::um);
  row("chip mm", all.chip, &PeakErrors::chip, unit::mm);
  for (const BrokenLimit& one : r.forces->broken) {
    out += fmt::format("limit {} = {:.4g}: {} lines go beyond it, up to {:.6g}\n",
                       one.limit, one.allowed, one.lines.size(), one.worst);
  }
  out += walls_and_chatter(*r.forces);
  if (r.forces->record) out += record_text(*r.forces->record);
  if (r.forces->feed) {
    const NewFeeds& feed = *r.forces->feed;
    out += fmt::format(
        "\nnew feeds: {:.6g} s, were {:.6g} s; largest force across {:.4g} N, was "
        "{:.4g} N\n",
        feed.after.time, feed.before.time, feed.after.peak_xy, feed.before.peak_xy);
  }
  return out;
}

}  // namespace

Answer answer_of(const ProgramResult& r) {
  constexpr std::size_t most_moves = 1000000;
  Answer answer{.command = "program",
                .heading = r.heading,
                .result = program_fields().object(r),
                .short_table = r.heading.ok ? short_table(r) : std::string(),
                .tables = {},
                .texts = {}};
  if (r.forces) answer.tables = tables_of_forces(r);
  if (r.forces && r.forces->feed && !r.forces->feed->file.empty()) {
    answer.texts.push_back({r.forces->feed->file, r.forces->feed->text, true});
  }
  if (r.forces && r.forces->record) {
    if (auto material = material_of(*r.forces->record)) {
      answer.texts.push_back({"material.toml", *std::move(material)});
    }
  }
  if (r.all_moves || r.program.moves.size() <= most_moves) {
    answer.tables.push_back(move_columns().table(r));
  }
  return answer;
}

Description description_of_program() {
  Description all{.command = "program", .keys = program_fields().texts()};
  move_columns().add_texts(all.columns);
  add_texts_of_forces(all.columns);
  return all;
}

}  // namespace trochoid::results
