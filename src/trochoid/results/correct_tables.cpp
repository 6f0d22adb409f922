#include <trochoid/results/correct_tables.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::results {

namespace {

using correction::Correction;
using dynamics::Motion;

/// Points of a command over one turn, in command.csv and command.h.
constexpr int command_points = 720;

/// A text that cannot end a comment.
std::string harmless(std::string text) {
  for (char& c : text) {
    if (c == '*' || c == '\n' || c == '\r' || c == '\\') {
      c = ' ';
    }
  }
  return text;
}

/// A command and the motion that it is for, over a turn.
struct CommandOfTurn {
  std::vector<double> command;
  std::vector<double> motion;
};

const Columns<CommandOfTurn>& command_columns() {
  using Of = const CommandOfTurn&;
  static const Columns<CommandOfTurn> all{
      "command.csv",
      [](Of c) { return c.command.size(); },
      {{"angle_deg", "spindle angle of tooth 1",
        [](Of, std::size_t i) {
          return as_named(360.0 * static_cast<double>(i) / command_points);
        }},
       {"command_um", "the feedforward command; the middle of the stroke is added",
        [](Of c, std::size_t i) { return c.command[i]; }},
       {"table_wanted_um", "what the table should do",
        [](Of c, std::size_t i) { return c.motion[i]; }}}};
  return all;
}

/// Force or table in the last turn.
double of_turn(const Correction& c, const Motion& m, std::size_t i, std::size_t which) {
  return which < 3 ? m.force[i][which] : m.mode[c.setting.cut.tool.size()][i];
}

const Columns<Correction>& before_after_columns() {
  using Of = const Correction&;
  const auto force = [](const char* when) {
    return [when](Of) {
      std::vector<std::string> names;
      for (const char* axis : {"Fx", "Fy", "Fz"}) {
        names.push_back(fmt::format("{}_{}", axis, when));
      }
      return names;
    };
  };
  static const Columns<Correction> all{
      "forces.csv",
      [](Of c) {
        return std::min(c.cuts.before.motion.angle.size(),
                        c.cuts.after.motion.angle.size());
      },
      {{"angle_deg", "of the last turn",
        [](Of c, std::size_t i) {
          const auto& angle = c.cuts.before.motion.angle;
          return given(angle[i] - angle.front());
        }},
       {"time_s", "from its beginning",
        [](Of c, std::size_t i) {
          const auto& time = c.cuts.before.motion.time;
          return time[i] - time.front();
        }},
       {"*_N", "`Fx_before_N`, ...: force on the tool without the command",
        force("before"),
        [](Of c, std::size_t i, std::size_t q) {
          return of_turn(c, c.cuts.before.motion, i, q);
        }},
       {"table_before_um", "place of the table",
        [](Of c, std::size_t i) { return of_turn(c, c.cuts.before.motion, i, 3); }},
       {"*_N", "`Fx_after_N`, ...: force with it", force("after"),
        [](Of c, std::size_t i, std::size_t q) {
          return of_turn(c, c.cuts.after.motion, i, q);
        }},
       {"table_after_um", "place of the table",
        [](Of c, std::size_t i) { return of_turn(c, c.cuts.after.motion, i, 3); }}}};
  return all;
}

const Columns<correction::SpeedModulation>& spindle_columns() {
  using Of = const correction::SpeedModulation&;
  static const Columns<correction::SpeedModulation> all{
      "spindle.csv",
      [](Of m) { return m.angle.size(); },
      {{"angle_deg", "with `[spindle]`: spindle angle",
        [](Of m, std::size_t i) { return given(m.angle[i]); }},
       {"spindle_rpm", "within the turn, in place of the table",
        [](Of m, std::size_t i) { return given(m.speed[i]); }},
       {"torque_Nm", "of the drive",
        [](Of m, std::size_t i) { return m.torque_at[i]; }}}};
  return all;
}

const Columns<TrochoidEstimatorConfig>& estimator_columns() {
  using Of = const TrochoidEstimatorConfig&;
  static const Columns<TrochoidEstimatorConfig> all{
      "estimator.csv",
      [](Of model) { return static_cast<std::size_t>(model.teeth); },
      {{"flute", "of at most eight teeth: number, from 1",
        [](Of, std::size_t j) { return j + 1; }},
       {"window_start_turns", "where its window begins",
        [](Of model, std::size_t j) { return model.start_rev[j]; }},
       {"wait_turns", "after a change",
        [](Of model, std::size_t) { return model.wait_turns; }},
       {"*_per_um",
        "`cosine1_per_um`, `sine1_per_um`, ...: by how much waves of the command change "
        "the flute's peak over the mean (R-31), for the "
        "[component](../../linuxcnc/README.md)",
        [](Of model) {
          std::vector<std::string> names;
          for (int k = 0; k < 2 * model.harmonics; ++k) {
            names.push_back(
                fmt::format("{}{}", k % 2 == 0 ? "cosine" : "sine", k / 2 + 1));
          }
          return names;
        },
        [](Of model, std::size_t j, std::size_t k) {
          return as_named(model.wave_model[j][k] * unit::um);
        }},
       {"tooth*_per_um", "the same of what a tooth stands out",
        [](Of model) {
          std::vector<std::string> names;
          for (int i = 0; i < model.teeth; ++i) names.push_back(std::to_string(i + 1));
          return names;
        },
        [](Of model, std::size_t j, std::size_t i) {
          return as_named(model.runout_model[j][i] * unit::um);
        }}}};
  return all;
}

const Columns<correction::ControllerInLoop>& controller_columns() {
  using Of = const correction::ControllerInLoop&;
  static const Columns<correction::ControllerInLoop> all{
      "controller.csv",
      [](Of run) { return run.samples.size(); },
      {{"time_s", "with `--simulate-controller`: every step",
        [](Of run, std::size_t i) { return run.samples[i].time; }},
       {"command_um", "from mid-stroke",
        [](Of run, std::size_t i) { return run.samples[i].command; }},
       {"table_um", "from mid-stroke",
        [](Of run, std::size_t i) { return run.samples[i].table; }},
       {"gain", "of the command",
        [](Of run, std::size_t i) { return run.samples[i].gain; }},
       {"state", "number of TrochoidState",
        [](Of run, std::size_t i) { return run.samples[i].state; }}}};
  return all;
}

/// A column of one strategy in speeds.csv.
struct OfStrategy {
  const correction::Curve& curve;
  const char* what;
  ColumnValue (*cell)(const correction::Curve& curve, std::size_t i);
};

std::vector<OfStrategy> columns_of_strategies(const correction::SpeedMap& map) {
  using Of = const correction::Curve&;
  std::vector<OfStrategy> all;
  for (const correction::Curve& curve : map.curves) {
    all.push_back({curve, "difference", [](Of c, std::size_t i) -> ColumnValue {
                     return c.points[i].peak_difference;
                   }});
    all.push_back({curve, "command_um", [](Of c, std::size_t i) -> ColumnValue {
                     return c.points[i].command_range;
                   }});
    if (curve.chosen.empty()) continue;
    all.push_back({curve, "transition_deg", [](Of c, std::size_t i) -> ColumnValue {
                     return c.chosen[i].width;
                   }});
    all.push_back({curve, "harmonics", [](Of c, std::size_t i) -> ColumnValue {
                     return c.chosen[i].harmonics;
                   }});
  }
  return all;
}

const Columns<correction::SpeedMap>& speed_columns() {
  using Of = const correction::SpeedMap&;
  static const Columns<correction::SpeedMap> all{
      "speeds.csv",
      [](Of map) { return map.Omega.size(); },
      {{"spindle_rpm", "on the cut of `map_cut`",
        [](Of map, std::size_t i) { return given(map.Omega[i]); }},
       {"*",
        "for each strategy `..._difference` of the peaks and `..._command_um` peak to "
        "peak; `quintic_chosen_transition_deg` and `..._harmonics` as chosen",
        [](Of map) {
          std::vector<std::string> names;
          for (const OfStrategy& one : columns_of_strategies(map)) {
            names.push_back(fmt::format("{}_{}", one.curve.name, one.what));
          }
          return names;
        },
        [](Of map, std::size_t i, std::size_t k) {
          const OfStrategy one = columns_of_strategies(map)[k];
          return one.cell(one.curve, i);
        }}}};
  return all;
}

}  // namespace

base::Table command_table(const correction::Plan& plan) {
  return command_columns().table({command_over_turn(plan, command_points),
                                  motion_over_turn(plan, command_points)});
}

base::Table before_after_table(const Correction& c) {
  return before_after_columns().table(c);
}

base::Table speeds_table(const correction::SpeedMap& map) {
  return speed_columns().table(map);
}

base::Table spindle_table(const correction::SpeedModulation& m) {
  return spindle_columns().table(m);
}

base::Table estimator_table(const TrochoidEstimatorConfig& model) {
  return estimator_columns().table(model);
}

base::Table controller_table(const correction::ControllerInLoop& run) {
  return controller_columns().table(run);
}

void add_texts_of_correct_tables(std::vector<ColumnText>& out) {
  command_columns().add_texts(out);
  before_after_columns().add_texts(out);
  speed_columns().add_texts(out);
  spindle_columns().add_texts(out);
  estimator_columns().add_texts(out);
  controller_columns().add_texts(out);
}

std::string command_header(const Correction& c, const std::string& title) {
  const geometry::Cut& cut = c.setting.cut.setup.cut;
  std::string text = fmt::format(
      "/* Command of the actuator over one turn of the spindle. {}\n"
      "   Made by trochoid correct for {:.6g} rpm: at another speed it is wrong.\n"
      "   Entry i is for the spindle angle i * 360/{} deg "
      "of the tip of tooth 1, which\n"
      "   is the recorded angle plus trochoid_command_offset_deg.\n"
      "   Already in it: what actuator and table are late. */\n"
      "#ifndef TROCHOID_COMMAND_H\n#define TROCHOID_COMMAND_H\n\n"
      "#define TROCHOID_COMMAND_POINTS {}\n\n"
      "static const double trochoid_command_rpm = {};\n"
      "static const double trochoid_command_offset_deg = {};\n"
      "static const double trochoid_command_middle_um = {};\n\n"
      "static const double trochoid_command_um[TROCHOID_COMMAND_POINTS] = {{\n",
      harmless(title), cut.Omega / unit::rpm, command_points, command_points,
      unit::in(cut.Omega, unit::rpm), unit::in(c.setting.angle_offset, unit::deg),
      c.plan.limits.offset / unit::um);
  const std::vector<double> values = command_over_turn(c.plan, command_points);
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("{}{:.4f}{}", i % 8 == 0 ? "    " : " ", values[i] / unit::um,
                        i + 1 == values.size() ? "\n" : (i % 8 == 7 ? ",\n" : ","));
  }
  return text + "};\n\n#endif\n";
}

}  // namespace trochoid::results
