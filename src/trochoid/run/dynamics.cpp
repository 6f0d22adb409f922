#include <trochoid/run/dynamics.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/run/chip_modes.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

constexpr double turn = 2 * std::numbers::pi;
/// A force that changes by less than this part of its peak from turn to turn repeats.
constexpr double repeats = 0.01;
/// Growth from turn to turn beyond which a motion that does not repeat is chatter.
constexpr double grows = 1.02;

/// The command over one turn, from -1 to 1.
double shape_at(inputs::CommandShape shape, double angle) {
  const double u = angle / turn - std::floor(angle / turn);
  constexpr double ramp = 1.0 / 6;  // of a turn
  switch (shape) {
    case inputs::CommandShape::square:
      return u < 0.5 ? 1.0 : -1.0;
    case inputs::CommandShape::trapezoid: {
      const double near_zero = u < 0.25 ? u : (u < 0.75 ? 0.5 - u : u - 1);
      return std::clamp(2 * near_zero / ramp, -1.0, 1.0);
    }
    default:
      return std::sin(angle);
  }
}

std::optional<dynamics::Drive> drive_of(const inputs::MachineTables& machine,
                                        const dynamics::System& system) {
  if (!machine.actuator) {
    return std::nullopt;
  }
  const inputs::Actuator& a = *machine.actuator;
  double sum = 0.0;
  double product = 0.0;
  if (a.frequency) {
    const double omega = turn * *a.frequency;
    sum = 2 * *a.damping_ratio / omega;
    product = 1 / (omega * omega);
  } else {
    sum = a.time_constants[0] + a.time_constants[1];
    product = a.time_constants[0] * a.time_constants[1];
  }
  const auto table =
      std::find_if(system.modes.begin(), system.modes.end(),
                   [](const dynamics::ChipMode& mode) { return mode.x < 0; });
  const double k_s = a.coupling_stiffness.value_or(table->stiffness);
  return dynamics::Drive{static_cast<std::size_t>(table - system.modes.begin()),
                         1 / a.gain,
                         sum / a.gain,
                         product / a.gain,
                         k_s,
                         table->damping * k_s / table->stiffness};
}

dynamics::MotionProblem problem_of(const inputs::Case& given) {
  dynamics::MotionProblem p{.setup = given.setup,
                            .law = given.law,
                            .system = chip_modes(given.machine.modes)};
  p.drive = drive_of(given.machine, p.system);
  const double omega = given.setup.cut.Omega;
  if (given.machine.command) {
    const inputs::ImposedCommand& c = *given.machine.command;
    p.command = [c, omega](double t) {
      return 0.5 * c.peak_to_peak * shape_at(c.shape, omega * (t + c.lead));
    };
  }
  p.grid.steps_per_tooth = dynamics::steps_needed(p);
  p.revolutions = static_cast<int>(given.sampling.revolutions);
  p.kept = std::min(p.revolutions, 2);
  p.samples_per_rev = given.sampling.samples_per_rev;
  return p;
}

/// Displacements of tool and table along x and y, from their modes.
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

base::Table force_table(const dynamics::Motion& m) {
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

/// Tool minus work at the start of every turn.
base::Table once_table(const dynamics::Motion& m) {
  base::Table table{"once_per_turn.csv", {{"turn", {}}, {"x_um", {}}, {"y_um", {}}}};
  for (std::size_t n = 0; n < m.once.size(); ++n) {
    table.columns[0].values.push_back(static_cast<double>(n));
    table.columns[1].values.push_back(m.once[n][0] / unit::um);
    table.columns[2].values.push_back(m.once[n][1] / unit::um);
  }
  return table;
}

struct Verdict {
  double peak = 0.0;  ///< largest force in the plane of the table [N]
  bool periodic = true;
  bool chatter = false;
};

Verdict verdict_of(const dynamics::Motion& m) {
  Verdict v;
  for (const auto& F : m.force) {
    v.peak = std::max(v.peak, std::hypot(F[0], F[1]));
  }
  v.periodic = m.finite && m.last_change <= repeats * v.peak;
  v.chatter = !m.finite || (!v.periodic && m.growth > grows);
  return v;
}

Json flutes_json(const dynamics::Motion& m) {
  Json flutes = Json::array();
  for (std::size_t j = 0; j < m.flutes.size(); ++j) {
    const dynamics::FluteMotion& f = m.flutes[j];
    flutes.push_back({{"tooth", j + 1},
                      {"peak_Fx_N", f.peak_x},
                      {"peak_Fy_N", f.peak_y},
                      {"chip_area_mm_rad", f.chip_area / unit::mm},
                      {"peak_chip_mm", f.peak_chip / unit::mm}});
  }
  return flutes;
}

double difference_of(const dynamics::Motion& m) {
  const auto [low, high] = std::minmax_element(
      m.flutes.begin(), m.flutes.end(),
      [](const auto& a, const auto& b) { return a.peak_y < b.peak_y; });
  return high->peak_y > 0 ? (high->peak_y - low->peak_y) / high->peak_y : 0.0;
}

std::string short_table(const Json& result) {
  std::string text =
      fmt::format("  {:>5} {:>14} {:>14} {:>18} {:>14}\n", "tooth", "peak |Fx| N",
                  "peak |Fy| N", "chip area mm rad", "thickest mm");
  for (const Json& f : result["flutes"]) {
    text += fmt::format(
        "  {:>5} {:>14.3f} {:>14.3f} {:>18.5f} {:>14.5f}\n", f["tooth"].get<int>(),
        f["peak_Fx_N"].get<double>(), f["peak_Fy_N"].get<double>(),
        f["chip_area_mm_rad"].get<double>(), f["peak_chip_mm"].get<double>());
  }
  text += fmt::format("difference of the peaks of Fy: {:.2f} % of the larger\n",
                      100 * result["difference"].get<double>());
  text +=
      fmt::format("the force changed by {:.3g} N in the last of {} turns: {}\n",
                  result["change_N"].get<double>(), result["turns"].get<int>(),
                  result["periodic"].get<bool>() ? "it repeats" : "it does not repeat");
  return text;
}

}  // namespace

base::Answer dynamics(const inputs::Case& given, const Progress& progress) {
  base::Answer answer{
      .command = "dynamics", .title = given.title, .case_toml = given.as_understood};
  if (progress) {
    progress("Cutting");
  }
  const dynamics::MotionProblem problem = problem_of(given);
  const dynamics::Motion m = dynamics::motion(problem);
  const Verdict verdict = verdict_of(m);
  Json result{{"turns", m.turns_done},
              {"steps_per_tooth", problem.grid.steps_per_tooth},
              {"periodic", verdict.periodic},
              {"change_N", m.finite ? Json(m.last_change) : Json(nullptr)},
              {"growth_per_turn", m.growth}};
  answer.tables.push_back(once_table(m));
  if (verdict.chatter) {
    answer.ok = false;
    answer.message =
        m.finite ? fmt::format(
                       "chatter: the motion grows by a factor {:.3g} from turn "
                       "to turn, and does not settle",
                       m.growth)
                 : fmt::format(
                       "chatter: after {} turns the motion had grown beyond all "
                       "bounds",
                       m.turns_done);
    answer.result = result.dump();
    return answer;
  }
  result["flutes"] = flutes_json(m);
  result["difference"] = difference_of(m);
  result["peak_xy_N"] = verdict.peak;
  if (!verdict.periodic) {
    answer.warnings.push_back(
        {"not_periodic",
         fmt::format("The force still changes by {:.3g} N from turn to turn: more "
                     "revolutions, or a motion that never repeats. Peaks are those of "
                     "the last turn.",
                     m.last_change)});
  }
  answer.tables.push_back(motion_table(problem, m));
  answer.tables.push_back(force_table(m));
  answer.message = fmt::format("{} turns.", m.turns_done);
  answer.short_table = short_table(result);
  answer.result = result.dump();
  return answer;
}

}  // namespace trochoid::run
