#include <trochoid/results/program_steps.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace trochoid::results {

namespace {

using engagement::Layer;
using engagement::Line;
using engagement::Step;

constexpr double nothing_there = std::numeric_limits<double>::quiet_NaN();

/// Rows of steps, or of places.
struct StepRows {
  std::span<const Step> rows;
  std::span<const std::array<double, 2>> asked;  ///< of places
  std::size_t teeth = 0;
  const std::vector<std::string>& tools;
  const ProgramChatter* chatter = nullptr;  ///< of the steps
  const ProgramWalls* walls = nullptr;      ///< of the steps
};

/// The limit of a row, with the depth of its cut; nothing: not known.
struct RowLimit {
  double depth = 0.0;
  double margin = 0.0;
};

std::optional<RowLimit> limit_of_row(const ProgramChatter* chatter, std::size_t row) {
  if (chatter == nullptr || chatter->cut_of[row] < 0) return std::nullopt;
  const auto cut = static_cast<std::size_t>(chatter->cut_of[row]);
  const engagement::ChatterLimit& limit = chatter->limits[cut];
  if (!limit.known) return std::nullopt;
  return RowLimit{limit.depth.value_or(nothing_there), limit.margin};
}

std::string flags_of(const Step& step) {
  using namespace engagement;
  std::vector<std::string_view> names;
  const auto add = [&](Flag flag, std::string_view name) {
    if ((step.flags & flag) != 0) names.push_back(name);
  };
  add(rubs_above_flute, "rubs_above_flute");
  add(Flag::straight_after_corner, "straight_after_corner");
  add(Flag::spindle_stands, "spindle_stands");
  add(thin_layer, "thin_layer");
  return fmt::format("{}", fmt::join(names, " "));
}

std::string tool_name(const std::vector<std::string>& tools, std::int16_t tool) {
  const auto place = static_cast<std::size_t>(tool);
  return tool < 0 || place >= tools.size() ? std::string() : tools[place];
}

using R = const StepRows&;

/// Place, feed and engagement of steps and places.
std::vector<Column<StepRows>> columns_of_cut() {
  const auto of = [](auto get) {
    return [get](R r, std::size_t i) { return get(r.rows[i]); };
  };
  return {
      {"tool", "number or name; empty: the program names none",
       [](R r, std::size_t i) { return tool_name(r.tools, r.rows[i].tool); }},
      {"time_s", "at the middle of the step, rapids and dwells counted",
       of([](const Step& s) { return s.time; })},
      {"x_mm", "tip at the middle of the step, in the frame of the stock",
       of([](const Step& s) { return given(s.place[0]); })},
      {"y_mm", "the same", of([](const Step& s) { return given(s.place[1]); })},
      {"z_mm", "the same", of([](const Step& s) { return given(s.place[2]); })},
      {"feed_direction_deg", "from +x of the program; empty: straight up or down",
       of([](const Step& s) { return s.direction; })},
      {"feed_mm_per_min", "of the machine, along the path",
       of([](const Step& s) { return s.feed; })},
      {"programmed_feed_mm_per_min", "F of the program",
       of([](const Step& s) { return s.programmed_feed; })},
      {"f_z_mm", "feed of a tooth, sideways", of([](const Step& s) { return s.f_z; })},
      {"a_e_mm", "radial depth: width times height of the layers over a_p",
       of([](const Step& s) { return s.a_e; })},
      {"a_p_mm", "height with stock", of([](const Step& s) { return s.a_p; })},
      {"arcs", "layers times arcs: rows of arcs.csv", of([](const Step& s) {
         std::size_t count = 0;
         for (const Layer& layer : s.layers) count += layer.arcs.size();
         return count;
       })},
      {"entry_deg", "first theta of the widest layer",
       of([](const Step& s) { return s.a_p > 0 ? s.entry : nothing_there; })},
      {"exit_deg", "last theta of the widest layer",
       of([](const Step& s) { return s.a_p > 0 ? s.exit : nothing_there; })},
      {"engaged_deg", "all arcs of the widest layer",
       of([](const Step& s) { return s.engaged; })},
      {"removed_mm3_per_s", "material that goes",
       of([](const Step& s) { return s.removal_rate; })}};
}

/// Forces of the turn of steps and places.
std::vector<Column<StepRows>> columns_of_forces() {
  const auto of = [](auto get) {
    return [get](R r, std::size_t i) { return get(r.rows[i]); };
  };
  const auto force = [](auto get) {
    return [get](R r, std::size_t i) { return get(r.rows[i].forces); };
  };
  using F = const engagement::TurnForces&;
  const auto teeth = [](R r) {
    std::vector<std::string> names;
    for (std::size_t j = 1; j <= r.teeth; ++j) names.push_back(std::to_string(j));
    return names;
  };
  return {
      {"Fx_mean_N", "force on the tool in the axes of the program: mean over the turn",
       force([](F f) { return f.mean[0]; })},
      {"Fy_mean_N", "the same", force([](F f) { return f.mean[1]; })},
      {"Fz_mean_N", "the same, of the flank", force([](F f) { return f.mean[2]; })},
      {"Fx_peak_N", "the value of largest size, with its sign",
       force([](F f) { return f.peak[0]; })},
      {"Fy_peak_N", "the same", force([](F f) { return f.peak[1]; })},
      {"Fz_peak_N", "the same, of the flank", force([](F f) { return f.peak[2]; })},
      {"peak_xy_N", "largest force across the axis",
       force([](F f) { return f.peak_xy; })},
      Column<StepRows>("peak_tooth_*_N", "the same of one tooth alone", teeth,
                       [](R r, std::size_t i, std::size_t tooth) {
                         const auto& peaks = r.rows[i].forces.peak_of_tooth;
                         return tooth < peaks.size() ? peaks[tooth] : nothing_there;
                       }),
      {"torque_mean_Nm", "about the spindle axis",
       force([](F f) { return f.torque_mean; })},
      {"torque_peak_Nm", "the same, largest", force([](F f) { return f.torque_peak; })},
      {"power_W", "mean torque times the speed of the spindle",
       force([](F f) { return f.power; })},
      {"moment_peak_Nm", "largest bending moment at gauge_length_mm",
       force([](F f) { return f.moment_peak; })},
      {"deflection_um", "largest deflection of the tip; 0 without [cutter_body]",
       force([](F f) { return f.deflection; })},
      {"peak_chip_mm", "largest uncut chip thickness",
       force([](F f) { return f.peak_chip; })},
      {"bottom_Fz_N",
       "estimate of the bottom edges in ramps and plunges, upwards: in no peak",
       of([](const Step& s) { return s.bottom_force; })},
      {"bottom_torque_Nm", "the same estimate of their torque",
       of([](const Step& s) { return s.bottom_torque; })},
      {"cause",
       "why the force is what it is: air, plunge, ramp, slot, corner, entry, exit, side",
       of([](const Step& s) { return name_of(s.cause); })},
      {"flag",
       "rubs_above_flute, straight_after_corner, spindle_stands, thin_layer; empty: none",
       [](R r, std::size_t i) { return flags_of(r.rows[i]); }}};
}

/// Where the cut of a row begins to chatter.
std::vector<Column<StepRows>> columns_of_chatter() {
  return {
      {"limit_depth_mm",
       "axial depth next to a_p at which this cut begins to chatter; empty: none up to "
       "twice a_p, or not looked at",
       [](R r, std::size_t i) {
         const auto limit = limit_of_row(r.chatter, i);
         return limit ? limit->depth : nothing_there;
       }},
      {"chatter_margin", "that depth over a_p, at most 2; empty: not looked at",
       [](R r, std::size_t i) {
         const auto limit = limit_of_row(r.chatter, i);
         return limit ? limit->margin : nothing_there;
       }}};
}

/// Errors of the walls that a row leaves.
std::vector<Column<StepRows>> columns_of_walls() {
  using engagement::StepWalls;
  using engagement::WallError;
  const auto of = [](std::optional<WallError> StepWalls::*side,
                     double WallError::*value) {
    return [side, value](R r, std::size_t i) {
      if (r.walls == nullptr) return nothing_there;
      const auto& wall = r.walls->of_steps[i].*side;
      return wall ? (*wall).*value : nothing_there;
    };
  };
  return {
      {"wall_left_least_um",
       "error of the wall left of the feed, over height and feed, positive: material "
       "left; empty: no wall that stays",
       of(&StepWalls::left, &WallError::least)},
      {"wall_left_most_um", "the same", of(&StepWalls::left, &WallError::most)},
      {"wall_right_least_um", "the same on the right",
       of(&StepWalls::right, &WallError::least)},
      {"wall_right_most_um", "the same", of(&StepWalls::right, &WallError::most)}};
}

std::vector<Column<StepRows>> with_head(std::vector<Column<StepRows>> head) {
  for (const auto& part : {columns_of_cut(), columns_of_forces()}) {
    head.insert(head.end(), part.begin(), part.end());
  }
  return head;
}

std::size_t count(R r) {
  return r.rows.size();
}

std::vector<Column<StepRows>> with_more(std::vector<Column<StepRows>> columns) {
  for (const auto& more : {columns_of_chatter(), columns_of_walls()}) {
    columns.insert(columns.end(), more.begin(), more.end());
  }
  return columns;
}

const Columns<StepRows>& step_columns() {
  static const Columns<StepRows> all{
      "steps.csv", count,
      with_more(with_head(
          {{"step", "of all feed moves, from 0; rows in air join several",
            [](R r, std::size_t i) { return r.rows[i].step; }},
           {"line", "of the text, from 1",
            [](R r, std::size_t i) { return r.rows[i].line; }},
           {"block", "its N number; empty: it has none", [](R r, std::size_t i) {
              const std::int32_t block = r.rows[i].block;
              return block < 0 ? nothing_there : static_cast<double>(block);
            }}}))};
  return all;
}

const Columns<StepRows>& place_columns() {
  static const Columns<StepRows> all{
      "places.csv", count,
      with_head(
          {{"place", "of [program] places, from 0", [](R, std::size_t i) { return i; }},
           {"line", "of the text, from 1",
            [](R r, std::size_t i) { return r.rows[i].line; }},
           {"fraction", "of the path of its first feed move",
            [](R r, std::size_t i) { return r.asked[i][1]; }}})};
  return all;
}

/// An arc of a layer of a row.
struct ArcRow {
  std::size_t row;
  const Layer* layer;
  std::size_t arc;
};

struct ArcRows {
  std::vector<ArcRow> arcs;
};

ArcRows arcs_of(std::span<const Step> rows, bool of_places) {
  ArcRows out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t number = of_places ? i : static_cast<std::size_t>(rows[i].step);
    for (const Layer& layer : rows[i].layers) {
      for (std::size_t k = 0; k < layer.arcs.size(); ++k) {
        out.arcs.push_back({number, &layer, k});
      }
    }
  }
  return out;
}

Columns<ArcRows> arc_columns(std::string_view file, std::string_view number,
                             std::string_view meaning) {
  using A = const ArcRows&;
  const auto arc = [](A a, std::size_t i) -> const chip::Arc& {
    return a.arcs[i].layer->arcs[a.arcs[i].arc];
  };
  return {file,
          [](A a) { return a.arcs.size(); },
          {{number, meaning, [](A a, std::size_t i) { return a.arcs[i].row; }},
           {"from_mm", "layer, above the tip",
            [](A a, std::size_t i) { return given(a.arcs[i].layer->from); }},
           {"to_mm", "the same",
            [](A a, std::size_t i) { return given(a.arcs[i].layer->to); }},
           {"from_deg", "theta at which stock begins",
            [arc](A a, std::size_t i) { return arc(a, i).from; }},
           {"to_deg", "theta at which it ends",
            [arc](A a, std::size_t i) { return arc(a, i).to; }}}};
}

const Columns<ArcRows>& step_arc_columns() {
  static const auto all = arc_columns("arcs.csv", "step", "as in steps.csv");
  return all;
}

const Columns<ArcRows>& place_arc_columns() {
  static const auto all = arc_columns("place_arcs.csv", "place", "as in places.csv");
  return all;
}

struct LineRows {
  const ProgramForces& forces;
  const std::vector<std::string>& tools;
};

std::string broken_by(const ProgramForces& forces, std::uint32_t line) {
  std::vector<std::string_view> names;
  for (const BrokenLimit& one : forces.broken) {
    if (std::ranges::find(one.lines, line) != one.lines.end()) {
      names.push_back(one.limit);
    }
  }
  return fmt::format("{}", fmt::join(names, " "));
}

const Columns<LineRows>& line_columns() {
  using L = const LineRows&;
  const auto of = [](auto get) {
    return [get](L l, std::size_t i) { return get(l.forces.summary.lines[i]); };
  };
  static const Columns<LineRows> all{
      "lines.csv",
      [](L l) { return l.forces.summary.lines.size(); },
      {{"line", "of the text, from 1", of([](const Line& l) { return l.line; })},
       {"text", "the line itself",
        [](L l, std::size_t i) { return l.forces.texts[i]; }},
       {"tool", "number or name; empty: the program names none",
        [](L l, std::size_t i) {
          return tool_name(l.tools, l.forces.summary.lines[i].tool);
        }},
       {"time_s", "of its feed moves", of([](const Line& l) { return l.time; })},
       {"time_in_cut_s", "of its steps that cut",
        of([](const Line& l) { return l.time_in_cut; })},
       {"steps", "turns of the spindle, air too",
        of([](const Line& l) { return l.steps; })},
       {"peak_xy_N", "largest force across the axis",
        of([](const Line& l) { return l.peak_xy; })},
       {"peak_tooth_N", "the same of one tooth alone",
        of([](const Line& l) { return l.peak_tooth; })},
       {"torque_peak_Nm", "largest torque",
        of([](const Line& l) { return l.torque_peak; })},
       {"power_W", "largest mean power of a turn",
        of([](const Line& l) { return l.power; })},
       {"deflection_um", "largest deflection of the tip",
        of([](const Line& l) { return l.deflection; })},
       {"removed_mm3", "material", of([](const Line& l) { return l.removed; })},
       {"cause", "of most steps within 1 % of the largest force",
        of([](const Line& l) { return name_of(l.cause); })},
       {"at_x_mm", "tip where the force is largest",
        of([](const Line& l) { return given(l.place[0]); })},
       {"at_y_mm", "the same", of([](const Line& l) { return given(l.place[1]); })},
       {"at_z_mm", "the same", of([](const Line& l) { return given(l.place[2]); })},
       {"broken", "keys of [limits] that it goes beyond", [](L l, std::size_t i) {
          return broken_by(l.forces, l.forces.summary.lines[i].line);
        }}}};
  return all;
}

/// The feed of each step, steps alike joined.
struct FeedRow {
  engagement::WantedFeed feed;
  std::size_t steps = 1;
};

std::vector<FeedRow> feed_rows(std::span<const engagement::WantedFeed> wanted) {
  std::vector<FeedRow> out;
  for (const engagement::WantedFeed& w : wanted) {
    if (!out.empty()) {
      FeedRow& last = out.back();
      if (last.feed.line == w.line && last.feed.piece == w.piece &&
          std::abs(last.feed.feed - w.feed) <= 1e-5 * w.feed &&
          last.feed.held == w.held && last.feed.reachable == w.reachable &&
          last.feed.rubs == w.rubs) {
        last.feed.to = w.to;
        ++last.steps;
        continue;
      }
    }
    out.push_back({w, 1});
  }
  return out;
}

const Columns<std::vector<FeedRow>>& feed_columns() {
  using F = const std::vector<FeedRow>&;
  const auto of = [](auto get) {
    return [get](F rows, std::size_t i) { return get(rows[i].feed); };
  };
  using W = const engagement::WantedFeed&;
  static const Columns<std::vector<FeedRow>> all{
      "feeds.csv",
      [](F rows) { return rows.size(); },
      {{"line", "of the program as it is", of([](W w) { return w.line; })},
       {"from_mm", "along its straight or circular piece of the path",
        of([](W w) { return given(w.from); })},
       {"to_mm", "the same", of([](W w) { return given(w.to); })},
       {"steps", "of the program as it is, alike",
        [](F rows, std::size_t i) { return rows[i].steps; }},
       {"programmed_feed_mm_per_min", "as it is",
        of([](W w) { return given(w.programmed); })},
       {"feed_mm_per_min", "the largest within the limits",
        of([](W w) { return given(w.feed); })},
       {"held_by",
        "what keeps it from being larger: `air` (the flank cuts nothing, as in a plunge: "
        "the feed of the program), `factor`, `machine`, or a limit: `peak_force`, `peak_tooth`, "
        "`torque`, `power`, `moment`, `deflection`, `chip`",
        of([](W w) { return name_of(w.held); })},
       {"reachable", "0: even the lowest feed breaks a limit",
        of([](W w) { return w.reachable ? 1 : 0; })},
       {"rubs", "1: the largest chip is below the lower number of `chip_mm`",
        of([](W w) { return w.rubs ? 1 : 0; })}}};
  return all;
}

}  // namespace

std::vector<base::Table> tables_of_forces(const ProgramResult& result) {
  const ProgramForces& all = *result.forces;
  const auto& tools = result.program.tools;
  std::vector<base::Table> out{
      line_columns().table({all, tools}),
      step_columns().table({all.steps,
                            {},
                            all.teeth,
                            tools,
                            all.chatter ? &*all.chatter : nullptr,
                            all.walls ? &*all.walls : nullptr}),
      step_arc_columns().table(arcs_of(all.steps, false))};
  if (all.record) out.push_back(table_of_record(all.steps, *all.record));
  if (all.feed) out.push_back(feed_columns().table(feed_rows(all.feed->steps)));
  if (!all.places.empty()) {
    out.push_back(place_columns().table({all.places, all.asked, all.teeth, tools}));
    out.push_back(place_arc_columns().table(arcs_of(all.places, true)));
  }
  return out;
}

void add_texts_of_forces(std::vector<ColumnText>& out) {
  line_columns().add_texts(out);
  step_columns().add_texts(out);
  step_arc_columns().add_texts(out);
  add_texts_of_record(out);
  feed_columns().add_texts(out);
  place_columns().add_texts(out);
  place_arc_columns().add_texts(out);
}

}  // namespace trochoid::results
