#include <trochoid/run/correction_tables.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

double angle_at(int i) {
  return unit::turn * i / command_points;
}

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

std::vector<double> command_values(const CorrectionPlan& plan) {
  std::vector<double> values;
  for (int i = 0; i < command_points; ++i) {
    values.push_back(plan.limits.offset +
                     correction::place_at(plan.command.wave, angle_at(i)));
  }
  return values;
}

base::Table command_table(const CorrectionPlan& plan) {
  base::Table table{"command.csv",
                    {{"angle_deg", {}}, {"command_um", {}}, {"table_wanted_um", {}}}};
  const std::vector<double> values = command_values(plan);
  for (int i = 0; i < command_points; ++i) {
    table.columns[0].values.push_back(360.0 * i / command_points);
    table.columns[1].values.push_back(values[static_cast<std::size_t>(i)] / unit::um);
    table.columns[2].values.push_back(
        (plan.limits.offset + correction::place_at(plan.motion, angle_at(i))) /
        unit::um);
  }
  return table;
}

base::Table before_after_table(const CorrectionSetting& setting,
                               const BeforeAfter& moved) {
  base::Table table{"forces.csv", {{"angle_deg", {}}, {"time_s", {}}}};
  const std::size_t n = std::min(moved.before.angle.size(), moved.after.angle.size());
  for (std::size_t i = 0; i < n; ++i) {
    table.columns[0].values.push_back(
        unit::in(moved.before.angle[i] - moved.before.angle.front(), unit::deg));
    table.columns[1].values.push_back(moved.before.time[i] - moved.before.time.front());
  }
  const std::size_t driven = setting.cut.tool.size();
  const auto add = [&](const dynamics::Motion& m, const std::string& when) {
    constexpr const char* names[] = {"Fx", "Fy", "Fz"};
    for (std::size_t q = 0; q < 3; ++q) {
      base::Table::Column column{fmt::format("{}_{}_N", names[q], when), {}};
      for (std::size_t i = 0; i < n; ++i) column.values.push_back(m.force[i][q]);
      table.columns.push_back(std::move(column));
    }
    base::Table::Column place{fmt::format("table_{}_um", when), {}};
    for (std::size_t i = 0; i < n; ++i) {
      place.values.push_back(m.mode[driven][i] / unit::um);
    }
    table.columns.push_back(std::move(place));
  };
  add(moved.before, "before");
  add(moved.after, "after");
  return table;
}

base::Table map_table(const SpeedMap& map) {
  base::Table table{"speeds.csv", {{"spindle_rpm", {}}}};
  for (const double Omega : map.Omega) {
    table.columns[0].values.push_back(unit::in(Omega, unit::rpm));
  }
  const std::size_t n = map.Omega.size();
  for (std::size_t s = 0; s < map.strategies.size(); ++s) {
    base::Table::Column left{map.strategies[s].name + "_difference", {}};
    base::Table::Column range{map.strategies[s].name + "_command_um", {}};
    for (std::size_t i = 0; i < n; ++i) {
      left.values.push_back(map.points[s * n + i].peak_difference);
      range.values.push_back(map.points[s * n + i].command_range / unit::um);
    }
    table.columns.push_back(std::move(left));
    table.columns.push_back(std::move(range));
  }
  return table;
}

std::string command_header(const CorrectionSetting& setting, const CorrectionPlan& plan,
                           const std::string& title) {
  const geometry::Cut& cut = setting.cut.setup.cut;
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
      unit::in(cut.Omega, unit::rpm), unit::in(setting.angle_offset, unit::deg),
      plan.limits.offset / unit::um);
  const std::vector<double> values = command_values(plan);
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += fmt::format("{}{:.4f}{}", i % 8 == 0 ? "    " : " ", values[i] / unit::um,
                        i + 1 == values.size() ? "\n" : (i % 8 == 7 ? ",\n" : ","));
  }
  return text + "};\n\n#endif\n";
}

}  // namespace trochoid::run
