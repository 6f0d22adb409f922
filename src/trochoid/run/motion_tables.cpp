#include <trochoid/run/motion_tables.h>

#include <trochoid/base/units.h>

#include <cmath>

namespace trochoid::run {

base::Table motion_table(const dynamics::MotionProblem& p, const dynamics::Motion& m) {
  base::Table table{"motion.csv",
                    {{"angle_deg", {}},
                     {"time_s", {}},
                     {"x_tool_um", {}},
                     {"y_tool_um", {}},
                     {"x_table_um", {}},
                     {"y_table_um", {}},
                     {"x_actuator_um", {}},
                     {"command_um", {}}}};
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    double place[4] = {};
    for (std::size_t r = 0; r < p.system.modes.size(); ++r) {
      const dynamics::ChipMode& mode = p.system.modes[r];
      const double along[2] = {mode.x, mode.y};
      for (std::size_t a = 0; a < 2; ++a) {
        place[along[a] < 0 ? 2 + a : a] += std::abs(along[a]) * m.mode[r][i];
      }
    }
    const double row[] = {unit::in(m.angle[i], unit::deg),
                          m.time[i],
                          place[0] / unit::um,
                          place[1] / unit::um,
                          place[2] / unit::um,
                          place[3] / unit::um,
                          m.actuator[i] / unit::um,
                          m.command[i] / unit::um};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      table.columns[c].values.push_back(row[c]);
    }
  }
  return table;
}

base::Table motion_forces_table(const dynamics::Motion& m) {
  base::Table table{
      "forces.csv",
      {{"angle_deg", {}}, {"time_s", {}}, {"Fx_N", {}}, {"Fy_N", {}}, {"Fz_N", {}}}};
  for (std::size_t i = 0; i < m.time.size(); ++i) {
    table.columns[0].values.push_back(unit::in(m.angle[i], unit::deg));
    table.columns[1].values.push_back(m.time[i]);
    for (std::size_t q = 0; q < 3; ++q) {
      table.columns[2 + q].values.push_back(m.force[i][q]);
    }
  }
  return table;
}

base::Table once_table(const dynamics::Motion& m) {
  base::Table table{"once_per_turn.csv", {{"turn", {}}, {"x_um", {}}, {"y_um", {}}}};
  for (std::size_t n = 0; n < m.once.size(); ++n) {
    table.columns[0].values.push_back(static_cast<double>(n));
    table.columns[1].values.push_back(m.once[n][0] / unit::um);
    table.columns[2].values.push_back(m.once[n][1] / unit::um);
  }
  return table;
}

std::vector<double> wall_heights(const force::Setup& setup) {
  constexpr int steps = 10;
  std::vector<double> heights = {0.0};
  for (int i = 1; setup.cutter.helix != 0 && i <= steps; ++i) {
    heights.push_back(setup.cut.a_p * i / steps);
  }
  return heights;
}

base::Table surface_location_table(const std::vector<dynamics::WallLocation>& walls) {
  base::Table table{
      "surface_location.csv",
      {{"sigma", {}}, {"height_mm", {}}, {"tooth", {}}, {"error_um", {}}}};
  for (const dynamics::WallLocation& wall : walls) {
    for (std::size_t j = 0; j < wall.teeth.size(); ++j) {
      table.columns[0].values.push_back(wall.sigma);
      table.columns[1].values.push_back(unit::in(wall.height, unit::mm));
      table.columns[2].values.push_back(static_cast<double>(j + 1));
      table.columns[3].values.push_back(wall.teeth[j] / unit::um);
    }
  }
  return table;
}

}  // namespace trochoid::run
