#include <trochoid/results/dynamics.h>
#include <trochoid/results/process_damping.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::results {

namespace {

using base::add_column;
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

Array flutes_value(const Motion& m, const std::vector<double>& entry) {
  Array flutes;
  for (std::size_t j = 0; j < m.flutes.size(); ++j) {
    const FluteMotion& f = m.flutes[j];
    flutes.push_back(Object{{"tooth", j + 1},
                            {"enters_deg", unit::in(entry[j], unit::deg)},
                            {"peak_Fx_N", f.peak_x},
                            {"peak_Fy_N", f.peak_y},
                            {"chip_area_mm_rad", f.chip_area / unit::mm},
                            {"peak_chip_mm", f.peak_chip / unit::mm}});
  }
  return flutes;
}

Array walls_value(const std::vector<WallLocation>& walls) {
  Array all;
  for (const WallLocation& wall : walls) {
    if (!at_the_tip(wall)) {
      continue;
    }
    Array flutes;
    for (std::size_t j = 0; j < wall.teeth.size(); ++j) {
      flutes.push_back(Object{{"tooth", j + 1},
                              {"surface_location_error_um", wall.teeth[j] / unit::um}});
    }
    all.push_back(Object{{"wall", name_of_wall(wall)},
                         {"flutes", std::move(flutes)},
                         {"surface_location_error_um", wall.remains / unit::um}});
  }
  return all;
}

Value period_value(const MotionResult& r) {
  const auto* periodic = std::get_if<Periodic>(&r.steady->verdict);
  if (periodic == nullptr) {
    return {};
  }
  const double teeth = static_cast<double>(r.steady->motion.flutes.size());
  return Object{{"teeth", periodic->passes},
                {"turns", periodic->passes / teeth},
                {"teeth_of_cut", periodic->passes_of_cut}};
}

Value vibration_value(const MotionResult& r) {
  const auto* bounded = std::get_if<Bounded>(&r.steady->verdict);
  if (bounded == nullptr || bounded->fades) {
    return {};
  }
  Array lines;
  for (const dynamics::VibrationLine& line : bounded->lines) {
    lines.push_back(Object{
        {"frequency_Hz", line.frequency},
        {"x_um", line.amplitude[0] / unit::um},
        {"y_um", line.amplitude[1] / unit::um},
        {"spindle_harmonic", line.harmonic > 0 ? Value(line.harmonic) : Value()}});
  }
  const auto* own = dynamics::chatter_line(*bounded);
  return Object{
      {"turns", bounded->turns},
      {"x_um", bounded->amplitude[0] / unit::um},
      {"y_um", bounded->amplitude[1] / unit::um},
      {"chatter_frequency_Hz", own != nullptr ? Value(own->frequency) : Value()},
      {"lines", std::move(lines)}};
}

Object result_of(const MotionResult& r) {
  const Motion& m = r.steady->motion;
  const dynamics::Verdict& verdict = r.steady->verdict;
  const auto* growing = std::get_if<Growing>(&verdict);
  const auto* bounded = std::get_if<Bounded>(&verdict);
  Object result{{"verdict", name_of(verdict)},
                {"periodic", std::holds_alternative<Periodic>(verdict)},
                {"chatter", dynamics::chatters(verdict)},
                {"settles", bounded != nullptr ? Value(bounded->fades) : Value()},
                {"period", period_value(r)},
                {"turns", m.turns_done},
                {"steps_per_tooth", r.steps_per_tooth},
                {"linear_growth_per_turn", r.linear_growth},
                {"growth_per_turn", growing != nullptr ? growing->per_turn : m.growth},
                {"change_N", growing != nullptr ? Value() : Value(m.last_change)}};
  if (growing == nullptr) {
    const Object followed{
        {"engagement_deg", Array{unit::in(r.engagement.from, unit::deg),
                                 unit::in(r.engagement.to, unit::deg)}},
        {"flutes", flutes_value(m, r.entry)},
        {"difference", dynamics::peak_difference(m)},
        {"peak_xy_N", m.peak},
        {"vibration", vibration_value(r)},
        {"surface_location", walls_value(r.walls)}};
    result.insert(result.end(), followed.begin(), followed.end());
  }
  if (r.damping.acts()) {
    result.push_back({"process_damping", process_damping_value(r.damping)});
  }
  return result;
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
  if (const auto* bounded = std::get_if<Bounded>(&r.steady->verdict);
      bounded != nullptr && !bounded->fades) {
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

void add_time_columns(base::Table& table, const Motion& m) {
  add_column(table, "angle_deg", m.time.size(),
             [&](std::size_t i) { return unit::in(m.angle[i], unit::deg); });
  add_column(table, "time_s", m.time.size(), [&](std::size_t i) { return m.time[i]; });
}

/// motion.csv: displacements of tool and table along x and y, actuator and command.
base::Table motion_table(const dynamics::System& system, const Motion& m) {
  base::Table table{"motion.csv", {}};
  add_time_columns(table, m);
  const auto add = [&](const char* name, const std::vector<double>& values) {
    add_column(table, name, values.size(),
               [&](std::size_t i) { return values[i] / unit::um; });
  };
  add("x_tool_um", place_of(false, Along::x, system, m));
  add("y_tool_um", place_of(false, Along::y, system, m));
  add("x_table_um", place_of(true, Along::x, system, m));
  add("y_table_um", place_of(true, Along::y, system, m));
  add("x_actuator_um", m.actuator);
  add("command_um", m.command);
  return table;
}

/// forces.csv of the same moments.
base::Table force_table(const Motion& m) {
  base::Table table{"forces.csv", {}};
  add_time_columns(table, m);
  constexpr const char* names[] = {"Fx_N", "Fy_N", "Fz_N"};
  for (std::size_t q = 0; q < 3; ++q) {
    add_column(table, names[q], m.time.size(),
               [&](std::size_t i) { return m.force[i][q]; });
  }
  return table;
}

/// once_per_turn.csv: tool minus work at the start of every turn.
base::Table once_table(const Motion& m) {
  base::Table table{"once_per_turn.csv", {}};
  const std::size_t n = m.once.size();
  add_column(table, "turn", n, [](std::size_t i) { return i; });
  add_column(table, "x_um", n, [&](std::size_t i) { return m.once[i][0] / unit::um; });
  add_column(table, "y_um", n, [&](std::size_t i) { return m.once[i][1] / unit::um; });
  return table;
}

/// spectrum.csv: amplitudes of tool minus work over the frequency.
base::Table spectrum_table(const Bounded& bounded) {
  base::Table table{"spectrum.csv", {}};
  const auto& a = bounded.spectrum;
  const std::size_t n = a.size();
  add_column(table, "frequency_Hz", n, [&](std::size_t i) {
    return static_cast<double>(i) * bounded.spectrum_step;
  });
  add_column(table, "x_um", n, [&](std::size_t i) { return a[i][0] / unit::um; });
  add_column(table, "y_um", n, [&](std::size_t i) { return a[i][1] / unit::um; });
  return table;
}

/// surface_location.csv: sigma of the wall, height, tooth and its error.
base::Table surface_location_table(const std::vector<WallLocation>& walls) {
  struct Row {
    const WallLocation* wall;
    std::size_t tooth;
  };
  std::vector<Row> rows;
  for (const WallLocation& wall : walls) {
    for (std::size_t j = 0; j < wall.teeth.size(); ++j) {
      rows.push_back({&wall, j});
    }
  }
  base::Table table{"surface_location.csv", {}};
  const std::size_t n = rows.size();
  add_column(table, "sigma", n, [&](std::size_t i) { return rows[i].wall->sigma; });
  add_column(table, "height_mm", n,
             [&](std::size_t i) { return unit::in(rows[i].wall->height, unit::mm); });
  add_column(table, "tooth", n, [&](std::size_t i) { return rows[i].tooth + 1; });
  add_column(table, "error_um", n, [&](std::size_t i) {
    return rows[i].wall->teeth[rows[i].tooth] / unit::um;
  });
  return table;
}

}  // namespace

Answer answer_of(const MotionResult& r) {
  Answer answer{.command = "dynamics", .heading = r.heading};
  if (!r.steady) {
    return answer;
  }
  const Motion& m = r.steady->motion;
  answer.result = result_of(r);
  answer.tables = {once_table(m)};
  // Of a motion that grows they would be those of the moment at which it was left.
  if (!std::holds_alternative<Growing>(r.steady->verdict)) {
    answer.short_table = short_table(r);
    answer.tables.push_back(surface_location_table(r.walls));
    answer.tables.push_back(motion_table(r.system, m));
    answer.tables.push_back(force_table(m));
  }
  if (const auto* bounded = std::get_if<Bounded>(&r.steady->verdict);
      bounded != nullptr && !bounded->fades) {
    answer.tables.push_back(spectrum_table(*bounded));
  }
  return answer;
}

}  // namespace trochoid::results
