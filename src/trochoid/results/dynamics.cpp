#include <trochoid/results/descriptions.h>
#include <trochoid/results/dynamics.h>
#include <trochoid/results/process_damping.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

namespace trochoid::results {

namespace {

using dynamics::Bounded;
using dynamics::FluteMotion;
using dynamics::Growing;
using dynamics::Motion;
using dynamics::Periodic;
using dynamics::WallLocation;

bool at_the_tip(const WallLocation& wall) {
  return !(wall.height > 0);  // higher up, they are in surface_location.csv
}

std::string_view name_of_wall(const WallLocation& wall) {
  return wall.sigma < 0 ? "up" : "down";
}

/// A flute of the last turn.
struct FluteOfMotion {
  std::size_t number;
  double entry;  ///< [rad]
  const FluteMotion& motion;
};

const Fields<FluteOfMotion>& flute_fields() {
  using Of = const FluteOfMotion&;
  static const Fields<FluteOfMotion> all{
      {"tooth", "number, from 1", &FluteOfMotion::number},
      {"enters_deg", "the spindle angle at which its tip enters the stock",
       [](Of f) { return given(f.entry); }},
      {"peak_Fx_N", "largest |Fx| while its turn lasts",
       [](Of f) { return f.motion.peak_x; }},
      {"peak_Fy_N", "largest |Fy| while its turn lasts",
       [](Of f) { return f.motion.peak_y; }},
      {"chip_area_mm_rad", "at the tip", [](Of f) { return f.motion.chip_area; }},
      {"peak_chip_mm", "at the tip", [](Of f) { return f.motion.peak_chip; }}};
  return all;
}

std::vector<FluteOfMotion> flutes_of(const MotionResult& r) {
  std::vector<FluteOfMotion> flutes;
  for (const FluteMotion& flute : r.steady->motion.flutes) {
    flutes.push_back({flutes.size() + 1, r.entry[flutes.size()], flute});
  }
  return flutes;
}

const Fields<WallLocation>& wall_fields() {
  static const Fields<WallLocation> all{
      {"wall", "`up`: at y = D/2, `down`: at y = -D/2; a slot has both", name_of_wall},
      Field<WallLocation>{"flutes", "what each would leave at the tip",
                          [](const WallLocation& wall) {
                            Array flutes;
                            for (std::size_t j = 0; j < wall.teeth.size(); ++j) {
                              flutes.push_back(Object{{"tooth", j + 1},
                                                      {"surface_location_error_um",
                                                       wall.teeth[j] / unit::um}});
                            }
                            return flutes;
                          }}
          .with({{"[].tooth", "number, from 1"},
                 {"[].surface_location_error_um", "positive where material is left"}}),
      {"surface_location_error_um", "the one that remains (T-10)",
       &WallLocation::remains}};
  return all;
}

std::vector<WallLocation> walls_at_the_tip(const MotionResult& r) {
  std::vector<WallLocation> walls;
  std::copy_if(r.walls.begin(), r.walls.end(), std::back_inserter(walls), at_the_tip);
  return walls;
}

const Fields<MotionResult>& period_fields() {
  using R = const MotionResult&;
  const auto periodic = [](R r) { return std::get<Periodic>(r.steady->verdict); };
  static const Fields<MotionResult> all{
      {"teeth", "after so many", [periodic](R r) { return periodic(r).passes; }},
      {"turns", "the same in turns",
       [periodic](R r) {
         return periodic(r).passes /
                static_cast<double>(r.steady->motion.flutes.size());
       }},
      {"teeth_of_cut", "after how many the cut without vibration does (T-15)",
       [periodic](R r) { return periodic(r).passes_of_cut; }}};
  return all;
}

const Fields<Bounded>& vibration_fields() {
  using Line = const dynamics::VibrationLine&;
  static const Fields<dynamics::VibrationLine> line{
      {"frequency_Hz", "of the line", [](Line l) { return l.frequency; }},
      {"x_um", "amplitude", [](Line l) { return l.amplitude[0]; }},
      {"y_um", "amplitude", [](Line l) { return l.amplitude[1]; }},
      {"spindle_harmonic", "which it is, or `null`",
       [](Line l) { return l.harmonic > 0 ? Value(l.harmonic) : Value(); }}};
  static const Fields<Bounded> all{
      {"turns", "that were looked at, the last ones", &Bounded::turns},
      {"x_um", "half of the range of tool minus work",
       [](const Bounded& b) { return b.amplitude[0]; }},
      {"y_um", "the same along y", [](const Bounded& b) { return b.amplitude[1]; }},
      {"chatter_frequency_Hz",
       "the strongest line that is no harmonic of the spindle, or `null`",
       [](const Bounded& b) {
         const auto* own = dynamics::chatter_line(b);
         return own != nullptr ? Value(own->frequency) : Value();
       }},
      {"lines", "of spectrum.csv, strongest first (T-13, T-14)", line,
       &Bounded::lines}};
  return all;
}

/// The chatter of a motion that stays bounded and does not fade; null: it does otherwise.
const Bounded* bounded_chatter(const MotionResult& r) {
  const auto* bounded = std::get_if<Bounded>(&r.steady->verdict);
  return bounded != nullptr && !bounded->fades ? bounded : nullptr;
}

const Fields<MotionResult>& motion_fields() {
  using R = const MotionResult&;
  const auto growing = [](R r) { return std::get_if<Growing>(&r.steady->verdict); };
  const auto followed = [growing](R r) { return growing(r) == nullptr; };
  static const Fields<MotionResult> all{
      {"verdict",
       "`periodic`: the motion repeats; `bounded`: it does not repeat and does not grow; "
       "`growing`: it grows, or the tool left the cut for good. Growing is status failed "
       "and has none of the numbers of a turn",
       [](R r) { return name_of(r.steady->verdict); }},
      {"periodic", "whether it repeats",
       [](R r) { return std::holds_alternative<Periodic>(r.steady->verdict); }},
      {"chatter",
       "whether the cut feeds a vibration: `growing`, `bounded` unless it settles, and "
       "`periodic` with a period longer than the cut's. Chatter that does not grow "
       "is answered, with the warning `chatter`",
       [](R r) { return dynamics::chatters(r.steady->verdict); }},
      {"settles",
       "of a bounded motion: `true` where transients still die out (warning "
       "`not_periodic`), `false` where it chatters; else `null`",
       [](R r) {
         const auto* bounded = std::get_if<Bounded>(&r.steady->verdict);
         return bounded != nullptr ? Value(bounded->fades) : Value();
       }},
      {"period", "of a motion that repeats, else `null`", period_fields(),
       [](R r) {
         return std::holds_alternative<Periodic>(r.steady->verdict) ? &r : nullptr;
       }},
      {"turns",
       "how far the motion was followed: at least `revolutions`, more until the steady "
       "state",
       [](R r) { return r.steady->motion.turns_done; }},
      {"steps_per_tooth", "how finely", &MotionResult::steps_per_tooth},
      {"linear_growth_per_turn",
       "the Floquet multiplier over a turn: what a turn makes of a small vibration, from "
       "the linearised cut as in `stability`; `null` where a period of the cut "
       "contains more than 400 vibrations of the fastest mode",
       &MotionResult::linear_growth},
      {"growth_per_turn",
       "the same read from the motion (T-11), or `null` where it shows none",
       [growing](R r) {
         return growing(r) != nullptr ? growing(r)->per_turn : r.steady->motion.growth;
       }},
      {"change_N",
       "largest change of a component of the force from the turn before; a steady state "
       "(the motion repeats) where that is below 1/300 of the peak",
       [growing](R r) {
         return growing(r) != nullptr ? Value() : Value(r.steady->motion.last_change);
       }},
      {"engagement_deg", "theta at which a tip enters and leaves the stock",
       [](R r) {
         return all_given(Array{r.engagement.from, r.engagement.to});
       },
       followed},
      {"flutes",
       "each in the last turn, of bounded chatter in its last `vibration.turns` (largest "
       "peaks, mean areas)",
       flute_fields(), flutes_of, followed},
      {"difference", "of the largest and smallest `peak_Fy_N`, over the largest",
       [](R r) { return dynamics::peak_difference(r.steady->motion); }, followed},
      {"peak_xy_N", "largest force in the plane of the table",
       [](R r) { return r.steady->motion.peak; }, followed},
      {"vibration", "of bounded chatter, over the last `turns`; else `null`",
       vibration_fields(), bounded_chatter, followed},
      {"surface_location",
       "for each finished wall; empty where the motion does not repeat with every turn",
       wall_fields(), walls_at_the_tip, followed},
      {"process_damping", "where a flank is worn", process_damping_fields(),
       [](R r) { return &r.damping; }, [](R r) { return r.damping.acts(); }}};
  return all;
}

std::string verdict_text(const MotionResult& r) {
  if (const auto* periodic = std::get_if<Periodic>(&r.steady->verdict)) {
    return "it repeats " + dynamics::period_text(*periodic, r.entry.size());
  }
  const auto& bounded = std::get<Bounded>(r.steady->verdict);
  return bounded.fades ? "it does not repeat yet"
                       : "it stays bounded, and does not repeat";
}

std::string vibration_text(const Bounded& bounded) {
  std::string text = fmt::format(
      "chatter within {:.4g} um along x and {:.4g} um along y of the middle, last {} "
      "turns\n",
      bounded.amplitude[0] / unit::um, bounded.amplitude[1] / unit::um, bounded.turns);
  if (const auto* line = dynamics::chatter_line(bounded)) {
    text += fmt::format("chatter frequency {:.5g} Hz\n", line->frequency);
  }
  return text;
}

std::string short_table(const MotionResult& r) {
  const Motion& m = r.steady->motion;
  std::string text =
      fmt::format("  {:>5} {:>14} {:>14} {:>18} {:>14}\n", "tooth", "peak |Fx| N",
                  "peak |Fy| N", "chip area mm rad", "thickest mm");
  for (std::size_t j = 0; j < m.flutes.size(); ++j) {
    const FluteMotion& f = m.flutes[j];
    text +=
        fmt::format("  {:>5} {:>14.3f} {:>14.3f} {:>18.5f} {:>14.5f}\n", j + 1,
                    f.peak_x, f.peak_y, f.chip_area / unit::mm, f.peak_chip / unit::mm);
  }
  text += fmt::format("difference of the peaks of Fy: {:.2f} % of the larger\n",
                      100 * dynamics::peak_difference(m));
  text += fmt::format("the force changed by {:.3g} N in the last of {} turns: {}\n",
                      m.last_change, m.turns_done, verdict_text(r));
  if (const Bounded* bounded = bounded_chatter(r)) {
    text += vibration_text(*bounded);
  }
  if (r.damping.acts()) {
    text += "with " + process_damping_text(r.damping) + '\n';
  }
  for (const WallLocation& wall : r.walls) {
    if (at_the_tip(wall)) {
      text += fmt::format("{}-milled wall {:.3f} um off at the tip ({})\n",
                          name_of_wall(wall), wall.remains / unit::um,
                          "positive: material is left");
    }
  }
  return text;
}

enum class Along { x, y };

/// Place of tool or table: the sum of the modes that move it.
std::vector<double> place_of(bool table, Along axis, const dynamics::System& system,
                             const Motion& m) {
  std::vector<double> place(m.time.size(), 0.0);
  for (std::size_t r = 0; r < system.modes.size(); ++r) {
    const dynamics::ChipMode& mode = system.modes[r];
    const double along = axis == Along::x ? mode.x : mode.y;
    if (mode.of_table == table) {
      for (std::size_t i = 0; i < place.size(); ++i) {
        place[i] += (table ? -along : along) * m.mode[r][i];
      }
    }
  }
  return place;
}

/// What motion.csv shows.
struct Displacements {
  const Motion& motion;
  std::array<std::vector<double>, 4> places;  ///< of tool and table, along x and y

  Displacements(const dynamics::System& system, const Motion& m)
      : motion(m),
        places{
            place_of(false, Along::x, system, m), place_of(false, Along::y, system, m),
            place_of(true, Along::x, system, m), place_of(true, Along::y, system, m)} {}
};

const Columns<Displacements>& motion_columns() {
  using Of = const Displacements&;
  const auto place = [](std::size_t of) {
    return [of](Of d, std::size_t i) { return d.places[of][i]; };
  };
  static const Columns<Displacements> all{
      "motion.csv",
      [](Of d) { return d.motion.time.size(); },
      {{"angle_deg", "of tooth 1 since the start, over the last two turns",
        [](Of d, std::size_t i) { return given(d.motion.angle[i]); }},
       {"time_s", "since the start",
        [](Of d, std::size_t i) { return d.motion.time[i]; }},
       {"x_tool_um", "place of the tool along x", place(0)},
       {"y_tool_um", "along y", place(1)},
       {"x_table_um", "place of the table along x", place(2)},
       {"y_table_um", "along y", place(3)},
       {"x_actuator_um", "place of the actuator",
        [](Of d, std::size_t i) { return d.motion.actuator[i]; }},
       {"command_um", "to the actuator",
        [](Of d, std::size_t i) { return d.motion.command[i]; }}}};
  return all;
}

const Columns<Motion>& motion_force_columns() {
  using Of = const Motion&;
  static const Columns<Motion> all{
      "forces.csv",
      [](Of m) { return m.time.size(); },
      {{"angle_deg", "of the moments of motion.csv; not where it grows",
        [](Of m, std::size_t i) { return given(m.angle[i]); }},
       {"time_s", "since the start", [](Of m, std::size_t i) { return m.time[i]; }},
       {"F*_N", "force on the tool along x, y, z",
        [](Of) {
          return std::vector<std::string>{"x", "y", "z"};
        },
        [](Of m, std::size_t i, std::size_t q) { return m.force[i][q]; }}}};
  return all;
}

const Columns<Motion>& once_columns() {
  using Of = const Motion&;
  static const Columns<Motion> all{
      "once_per_turn.csv",
      [](Of m) { return m.once.size(); },
      {{"turn", "from the start: the once-per-revolution section (Poincaré)",
        [](Of, std::size_t i) { return i; }},
       {"x_um", "tool minus work as the tip of tooth 1 passes theta = 0",
        [](Of m, std::size_t i) { return m.once[i][0]; }},
       {"y_um", "the same along y", [](Of m, std::size_t i) { return m.once[i][1]; }}}};
  return all;
}

const Columns<Bounded>& spectrum_columns() {
  using Of = const Bounded&;
  static const Columns<Bounded> all{
      "spectrum.csv",
      [](Of b) { return b.spectrum.size(); },
      {{"frequency_Hz", "of bounded chatter only",
        [](Of b, std::size_t i) { return static_cast<double>(i) * b.spectrum_step; }},
       {"x_um", "amplitude of tool minus work",
        [](Of b, std::size_t i) { return b.spectrum[i][0]; }},
       {"y_um", "the same along y",
        [](Of b, std::size_t i) { return b.spectrum[i][1]; }}}};
  return all;
}

/// The flutes of all walls, one after the other.
struct WallRows {
  struct Row {
    const WallLocation* wall;
    std::size_t tooth;
  };
  std::vector<Row> rows = {};

  explicit WallRows(const std::vector<WallLocation>& walls) {
    for (const WallLocation& wall : walls) {
      for (std::size_t j = 0; j < wall.teeth.size(); ++j) rows.push_back({&wall, j});
    }
  }
};

const Columns<WallRows>& surface_location_columns() {
  using Of = const WallRows&;
  static const Columns<WallRows> all{
      "surface_location.csv",
      [](Of of) { return of.rows.size(); },
      {{"sigma", "+1 at the wall y = -D/2, -1 at y = D/2",
        [](Of of, std::size_t i) { return of.rows[i].wall->sigma; }},
       {"height_mm", "above the tip, where there is a helix",
        [](Of of, std::size_t i) { return given(of.rows[i].wall->height); }},
       {"tooth", "number, from 1",
        [](Of of, std::size_t i) { return of.rows[i].tooth + 1; }},
       {"error_um", "the surface location error", [](Of of, std::size_t i) {
          return of.rows[i].wall->teeth[of.rows[i].tooth];
        }}}};
  return all;
}

}  // namespace

Answer answer_of(const MotionResult& r) {
  Answer answer{.command = "dynamics", .heading = r.heading};
  if (!r.steady) {
    return answer;
  }
  const Motion& m = r.steady->motion;
  answer.result = motion_fields().object(r);
  answer.tables = {once_columns().table(m)};
  // Of a motion that grows they would be those of the moment at which it was left.
  if (!std::holds_alternative<Growing>(r.steady->verdict)) {
    answer.short_table = short_table(r);
    answer.tables.push_back(surface_location_columns().table(WallRows(r.walls)));
    answer.tables.push_back(motion_columns().table(Displacements(r.system, m)));
    answer.tables.push_back(motion_force_columns().table(m));
  }
  if (const Bounded* bounded = bounded_chatter(r)) {
    answer.tables.push_back(spectrum_columns().table(*bounded));
  }
  return answer;
}

Description description_of_dynamics() {
  Description all{.command = "dynamics", .keys = motion_fields().texts()};
  once_columns().add_texts(all.columns);
  surface_location_columns().add_texts(all.columns);
  motion_columns().add_texts(all.columns);
  motion_force_columns().add_texts(all.columns);
  spectrum_columns().add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
