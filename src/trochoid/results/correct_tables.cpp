#include <trochoid/results/correct_tables.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::results {

namespace {

using base::add_column;
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

}  // namespace

base::Table command_table(const correction::Plan& plan) {
  base::Table table{"command.csv", {}};
  const auto command = command_over_turn(plan, command_points);
  const auto motion = motion_over_turn(plan, command_points);
  add_column(table, "angle_deg", command.size(), [](std::size_t i) {
    return 360.0 * static_cast<double>(i) / command_points;
  });
  add_column(table, "command_um", command.size(),
             [&](std::size_t i) { return command[i] / unit::um; });
  add_column(table, "table_wanted_um", motion.size(),
             [&](std::size_t i) { return motion[i] / unit::um; });
  return table;
}

base::Table before_after_table(const Correction& c) {
  base::Table table{"forces.csv", {}};
  const Motion& before = c.cuts.before.motion;
  const Motion& after = c.cuts.after.motion;
  const std::size_t n = std::min(before.angle.size(), after.angle.size());
  add_column(table, "angle_deg", n, [&](std::size_t i) {
    return unit::in(before.angle[i] - before.angle.front(), unit::deg);
  });
  add_column(table, "time_s", n,
             [&](std::size_t i) { return before.time[i] - before.time.front(); });
  const std::size_t driven = c.setting.cut.tool.size();
  const auto add = [&](const Motion& m, const char* when) {
    constexpr const char* names[] = {"Fx", "Fy", "Fz"};
    for (std::size_t q = 0; q < 3; ++q) {
      add_column(table, fmt::format("{}_{}_N", names[q], when), n,
                 [&](std::size_t i) { return m.force[i][q]; });
    }
    add_column(table, fmt::format("table_{}_um", when), n,
               [&](std::size_t i) { return m.mode[driven][i] / unit::um; });
  };
  add(before, "before");
  add(after, "after");
  return table;
}

base::Table speeds_table(const correction::SpeedMap& map) {
  base::Table table{"speeds.csv", {}};
  const std::size_t n = map.Omega.size();
  add_column(table, "spindle_rpm", n,
             [&](std::size_t i) { return unit::in(map.Omega[i], unit::rpm); });
  for (const correction::Curve& curve : map.curves) {
    const std::string& name = curve.name;
    add_column(table, name + "_difference", n,
               [&](std::size_t i) { return curve.points[i].peak_difference; });
    add_column(table, name + "_command_um", n,
               [&](std::size_t i) { return curve.points[i].command_range / unit::um; });
    if (!curve.chosen.empty()) {
      add_column(table, name + "_transition_deg", n,
                 [&](std::size_t i) { return curve.chosen[i].width / unit::deg; });
      add_column(table, name + "_harmonics", n,
                 [&](std::size_t i) { return curve.chosen[i].harmonics; });
    }
  }
  return table;
}

base::Table spindle_table(const correction::SpeedModulation& m) {
  base::Table table{"spindle.csv", {}};
  const std::size_t n = m.angle.size();
  add_column(table, "angle_deg", n,
             [&](std::size_t i) { return unit::in(m.angle[i], unit::deg); });
  add_column(table, "spindle_rpm", n,
             [&](std::size_t i) { return unit::in(m.speed[i], unit::rpm); });
  add_column(table, "torque_Nm", n, [&](std::size_t i) { return m.torque_at[i]; });
  return table;
}

base::Table estimator_table(const TrochoidEstimatorConfig& model) {
  base::Table table{"estimator.csv", {}};
  const auto n = static_cast<std::size_t>(model.teeth);
  const auto add = [&](const std::string& name, const auto& value) {
    add_column(table, name, n, value);
  };
  add("flute", [](std::size_t j) { return static_cast<double>(j + 1); });
  add("window_start_turns", [&](std::size_t j) { return model.start_rev[j]; });
  add("wait_turns", [&](std::size_t) { return model.wait_turns; });
  for (int k = 0; k < 2 * model.harmonics; ++k) {
    add(fmt::format("{}{}_per_um", k % 2 == 0 ? "cosine" : "sine", k / 2 + 1),
        [&](std::size_t j) { return model.wave_model[j][k] * unit::um; });
  }
  for (std::size_t i = 0; i < n; ++i) {
    add(fmt::format("tooth{}_per_um", i + 1),
        [&](std::size_t j) { return model.runout_model[j][i] * unit::um; });
  }
  return table;
}

base::Table controller_table(const correction::ControllerInLoop& run) {
  base::Table table{"controller.csv", {}};
  const auto& samples = run.samples;
  const std::size_t n = samples.size();
  add_column(table, "time_s", n, [&](std::size_t i) { return samples[i].time; });
  add_column(table, "command_um", n,
             [&](std::size_t i) { return samples[i].command / unit::um; });
  add_column(table, "table_um", n,
             [&](std::size_t i) { return samples[i].table / unit::um; });
  add_column(table, "gain", n, [&](std::size_t i) { return samples[i].gain; });
  add_column(table, "state", n, [&](std::size_t i) { return samples[i].state; });
  return table;
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
