#include <trochoid/run/stability_tables.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/chatter.h>
#include <trochoid/numerics/parallel.h>

#include <cmath>

namespace trochoid::run {

base::Table lobes_table(const dynamics::LobeGrid& grid) {
  base::Table table{"lobes.csv",
                    {{"spindle_rpm", {}}, {"axial_depth_mm", {}}, {"multiplier", {}}}};
  for (std::size_t i = 0; i < grid.Omega.size(); ++i) {
    for (std::size_t k = 0; k < grid.depth.size(); ++k) {
      table.columns[0].values.push_back(unit::in(grid.Omega[i], unit::rpm));
      table.columns[1].values.push_back(unit::in(grid.depth[k], unit::mm));
      table.columns[2].values.push_back(
          std::abs(grid.multiplier[i * grid.depth.size() + k]));
    }
  }
  return table;
}

base::Table limit_table(const dynamics::DirectionalModel& model,
                        const dynamics::System& system,
                        std::span<const dynamics::Limit> limits) {
  base::Table table{"limit.csv",
                    {{"spindle_rpm", {}},
                     {"limit_depth_mm", {}},
                     {"argument_deg", {}},
                     {"chatter_frequency_Hz", {}}}};
  std::vector<double> strongest(limits.size());
  numerics::for_each_index(limits.size(), [&](std::size_t i) {
    const auto lines = dynamics::chatter_lines(model.at_depth(limits[i].depth), system,
                                               limits[i].Omega, limits[i].factor, 0.9);
    strongest[i] = lines.empty() ? 0.0 : lines.front().frequency;
  });
  for (std::size_t i = 0; i < limits.size(); ++i) {
    table.columns[0].values.push_back(unit::in(limits[i].Omega, unit::rpm));
    table.columns[1].values.push_back(unit::in(limits[i].depth, unit::mm));
    table.columns[2].values.push_back(std::arg(limits[i].multiplier) / unit::deg);
    table.columns[3].values.push_back(strongest[i]);
  }
  return table;
}

}  // namespace trochoid::run
