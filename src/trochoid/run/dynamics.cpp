#include <trochoid/results/json.h>
#include <trochoid/run/dynamics.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/run/motion_problem.h>
#include <trochoid/run/motion_tables.h>
#include <trochoid/run/motion_verdict.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <array>
#include <optional>
#include <utility>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::array names = {"periodic", "not_periodic", "chatter"};

/// Where the tip of a nominal tooth enters and leaves the stock.
chip::Arc engagement_of(const force::Setup& setup) {
  const double D = setup.cutter.profile.D;
  return chip::tooth_arc(setup.cut.engagement, D, D / 2);
}

Json flutes_json(const dynamics::Motion& m, const force::Setup& setup) {
  Json flutes = Json::array();
  double psi = 0.0;
  for (std::size_t j = 0; j < m.flutes.size(); ++j) {
    const dynamics::FluteMotion& f = m.flutes[j];
    const double enters = psi + engagement_of(setup).from;
    psi += setup.cutter.pitch[j];
    flutes.push_back({{"tooth", j + 1},
                      {"enters_deg", unit::in(enters, unit::deg)},
                      {"peak_Fx_N", f.peak_x},
                      {"peak_Fy_N", f.peak_y},
                      {"chip_area_mm_rad", f.chip_area / unit::mm},
                      {"peak_chip_mm", f.peak_chip / unit::mm}});
  }
  return flutes;
}

Json surface_location_json(const std::vector<dynamics::WallLocation>& walls) {
  Json all = Json::array();
  for (const dynamics::WallLocation& wall : walls) {
    if (wall.height > 0) {
      continue;  // those are in surface_location.csv
    }
    Json flutes = Json::array();
    for (std::size_t j = 0; j < wall.teeth.size(); ++j) {
      flutes.push_back(
          {{"tooth", j + 1}, {"surface_location_error_um", wall.teeth[j] / unit::um}});
    }
    all.push_back({{"wall", wall.sigma < 0 ? "up" : "down"},
                   {"flutes", flutes},
                   {"surface_location_error_um", wall.remains / unit::um}});
  }
  return all;
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
  for (const Json& wall : result["surface_location"]) {
    text += fmt::format("{}-milled wall {:.3f} um off at the tip ({})\n",
                        wall["wall"].get<std::string>(),
                        wall["surface_location_error_um"].get<double>(),
                        "positive: material is left");
  }
  return text;
}

}  // namespace

results::Answer dynamics(const inputs::Case& given, const Progress& progress) {
  results::Answer answer{
      .command = "dynamics",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  dynamics::MotionProblem problem = motion_problem(given);
  const auto failed = [&answer](std::string why) {
    answer.heading.ok = false;
    answer.heading.message = std::move(why);
    return answer;
  };
  if (problem.grid.steps_per_tooth > dynamics::most_steps) {
    return failed(fmt::format(
        "the fastest mode would need {} steps a tooth, more than the {} that are "
        "computed: leave out modes far above the tooth frequency",
        problem.grid.steps_per_tooth, dynamics::most_steps));
  }
  const Moved all = settled(problem, progress);
  const dynamics::Motion& m = all.motion;
  if (m.finite && !m.solved) {
    return failed(
        "no force was found that agrees with the motion it makes: a mode is too "
        "soft, or too light, for this cut");
  }
  const std::optional<double> linear = linear_growth(given, problem.system);
  const bool chatter = all.verdict == Verdict::chatter;
  Json result{{"verdict", names[static_cast<std::size_t>(all.verdict)]},
              {"periodic", all.verdict == Verdict::periodic},
              {"turns", m.turns_done},
              {"steps_per_tooth", problem.grid.steps_per_tooth},
              {"linear_growth_per_turn", linear ? Json(*linear) : Json(nullptr)},
              {"growth_per_turn", all.growth ? Json(*all.growth) : Json(nullptr)},
              {"change_N", chatter ? Json(nullptr) : Json(m.last_change)}};
  answer.tables.push_back(once_table(m));
  if (chatter) {
    answer.result = results::json_value(result.dump());
    return failed(chatter_message(all, linear));
  }
  const auto engaged = engagement_of(problem.setup);
  result["engagement_deg"] = {unit::in(engaged.from, unit::deg),
                              unit::in(engaged.to, unit::deg)};
  result["flutes"] = flutes_json(m, problem.setup);
  result["difference"] = peak_difference(m);
  result["peak_xy_N"] = m.peak;
  if (all.verdict == Verdict::not_periodic) {
    answer.heading.warnings.push_back(
        {"not_periodic",
         fmt::format(
             "The force still changes by {:.3g} N from turn to turn, less and "
             "less: ask for more revolutions. Peaks are those of the last turn.",
             m.last_change)});
  }
  const auto walls =
      dynamics::surface_location(problem, m, wall_heights(problem.setup));
  result["surface_location"] = surface_location_json(walls);
  answer.tables.push_back(surface_location_table(walls));
  answer.tables.push_back(motion_table(problem, m));
  answer.tables.push_back(motion_forces_table(m));
  answer.heading.message = fmt::format(
      "After {} turns the motion {}.", m.turns_done,
      all.verdict == Verdict::periodic ? "repeats itself" : "has not settled");
  answer.short_table = short_table(result);
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace trochoid::run
