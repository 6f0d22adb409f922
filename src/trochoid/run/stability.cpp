#include <trochoid/results/json.h>
#include <trochoid/run/stability.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/chatter.h>
#include <trochoid/dynamics/lobes.h>
#include <trochoid/run/chip_modes.h>
#include <trochoid/run/stability_tables.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

/// Of the directional matrices: far below any tolerance of a multiplier.
constexpr double matrix_tolerance = 1e-10;
/// Of the multipliers in lobes.csv and of the depths in limit.csv.
constexpr double map_tolerance = 1e-5;
/// Frequencies with less than this part of the strongest are not listed.
constexpr double least_line = 0.1;
/// How many depths up to the greatest are looked at for the limit of the case.
constexpr int depths_looked_at = 100;

/// The case, ready to be asked.
struct Point {
  const inputs::Case& given;
  const inputs::Stability& options;
  dynamics::System system;
  dynamics::DirectionalModel model;
  dynamics::Directional directional;  ///< at the depth of the case
  dynamics::Multiplier multiplier;
};

Point point_of(const inputs::Case& given) {
  const inputs::Stability& options = *given.machine.stability;
  dynamics::System system = chip_modes(given.machine.modes);
  dynamics::DirectionalModel model(given.setup, given.law, options.chip_floor,
                                   matrix_tolerance);
  dynamics::Directional directional = model.at_depth(given.setup.cut.a_p);
  const dynamics::Multiplier mu = dynamics::multiplier(
      directional, system, given.setup.cut.Omega, options.tolerance);
  return {given, options, std::move(system), std::move(model), std::move(directional),
          mu};
}

const char* name_of(dynamics::Bifurcation kind) {
  switch (kind) {
    case dynamics::Bifurcation::hopf:
      return "hopf";
    case dynamics::Bifurcation::period_doubling:
      return "period_doubling";
    default:
      return "period_one";
  }
}

const char* verdict_of(double growth, double margin) {
  if (std::abs(growth - 1) <= margin) {
    return "marginal";
  }
  return growth < 1 ? "stable" : "unstable";
}

bool cuts(const dynamics::Directional& directional) {
  return std::any_of(directional.elements.begin(), directional.elements.end(),
                     [](const dynamics::DirectionalElement& e) {
                       return std::any_of(e.matrices.begin(), e.matrices.end(),
                                          [](const auto& m) { return !m.empty(); });
                     });
}

/// |mu| with another floor of the chip.
double with_floor(const Point& point, double floor) {
  const dynamics::DirectionalModel model(point.given.setup, point.given.law, floor,
                                         matrix_tolerance);
  const force::Setup& setup = point.given.setup;
  return std::abs(dynamics::multiplier(model.at_depth(setup.cut.a_p), point.system,
                                       setup.cut.Omega, point.options.tolerance)
                      .value);
}

/// A power law has no slope at h = 0: does the verdict hang on the floor?
void add_floor(const Point& point, std::string& verdict, results::Answer& answer,
               Json& result) {
  if (!force::form(point.given.law).power) {
    return;
  }
  const double half = with_floor(point, 0.5 * point.options.chip_floor);
  const double twice = with_floor(point, 2 * point.options.chip_floor);
  result["chip_floor"] = {
      {"chip_floor_um", unit::in(point.options.chip_floor, unit::um)},
      {"multiplier_at_half", half},
      {"multiplier_at_twice", twice}};
  const bool decided = verdict == verdict_of(half, point.options.margin) &&
                       verdict == verdict_of(twice, point.options.margin);
  if (!decided) {
    verdict = "marginal";
    answer.heading.warnings.push_back(
        {"chip_floor",
         fmt::format(
             "The slope of a power law grows without limit where the chip begins: "
             "with half and twice chip_floor_um the multiplier is {:.4f} and "
             "{:.4f}. Take the verdict as open.",
             half, twice)});
  }
}

void add_multiplier(const Point& point, Json& result) {
  const dynamics::Multiplier& mu = point.multiplier;
  const auto lines =
      dynamics::chatter_lines(point.directional, point.system,
                              point.given.setup.cut.Omega, mu.factor, least_line);
  Json frequencies = Json::array();
  Json shares = Json::array();
  for (const dynamics::ChatterLine& line : lines) {
    frequencies.push_back(line.frequency);
    shares.push_back(line.share);
  }
  result["multiplier"] = {
      {"absolute", std::abs(mu.value)},
      {"argument_deg", std::arg(mu.value) / unit::deg},
      {"type", name_of(dynamics::bifurcation_of(mu.value))},
      {"chatter_frequencies_Hz", frequencies},
      {"chatter_shares", shares},
      {"period", point.directional.period < 6.28 ? "tooth" : "revolution"},
      {"period_s", point.directional.period / point.given.setup.cut.Omega},
      {"error", mu.error}};
}

void add_limit(const Point& point, const std::vector<double>& depth, Json& result) {
  const double greatest = std::max(depth.back(), point.given.setup.cut.a_p);
  std::vector<double> looked_at;
  for (int i = 1; i <= depths_looked_at; ++i) {
    looked_at.push_back(greatest * i / depths_looked_at);
  }
  const auto limit =
      dynamics::limit_depth(point.model, point.system, point.given.setup.cut.Omega,
                            looked_at, point.options.tolerance);
  result["limit_depth_mm"] = nullptr;
  if (limit) {
    result["limit_depth_mm"] = limit->depth / unit::mm;
    result["limit"] = {{"type", name_of(dynamics::bifurcation_of(limit->multiplier))},
                       {"argument_deg", std::arg(limit->multiplier) / unit::deg},
                       {"chatter_frequencies_Hz", Json::array()}};
    for (const auto& line : dynamics::chatter_lines(
             point.model.at_depth(limit->depth), point.system,
             point.given.setup.cut.Omega, point.multiplier.factor, least_line)) {
      result["limit"]["chatter_frequencies_Hz"].push_back(line.frequency);
    }
  }
  result["greatest_depth_mm"] = unit::in(greatest, unit::mm);
}

void add_modes(const Point& point, results::Answer& answer, Json& result) {
  Json modes = Json::array();
  for (const dynamics::ChipMode& mode : point.system.modes) {
    const double omega = std::sqrt(mode.stiffness / mode.mass);
    modes.push_back({{"direction", {mode.x, mode.y}},
                     {"frequency_Hz", omega / unit::turn},
                     {"damping_ratio", 0.5 * mode.damping / (mode.mass * omega)},
                     {"mass_kg", mode.mass},
                     {"stiffness_N_per_m", mode.stiffness},
                     {"damping_Ns_per_m", mode.damping}});
  }
  result["modes"] = modes;
  const std::size_t left_out = point.given.machine.modes.size() - modes.size();
  if (left_out > 0) {
    answer.heading.warnings.push_back(
        {"mode_along_z",
         fmt::format("{} of the modes move along z, which the chip does "
                     "not feel: left out.",
                     left_out)});
  }
}

void add_lobes(const Point& point, const std::vector<double>& depth,
               const Progress& progress, results::Answer& answer) {
  const auto told = [&progress](const char* what) {
    return [&progress, what](double share) {
      if (progress) {
        progress(fmt::format("{}: {:.0f} %", what, 100 * share));
      }
    };
  };
  const auto grid = dynamics::lobe_grid(
      point.model, point.system, base::values(*point.options.spindle_speed), depth,
      dynamics::LobeAccuracy{.near = map_tolerance}, told("lobes"));
  const auto limits = dynamics::limit_curve(point.model, point.system, grid,
                                            map_tolerance, told("limit"));
  answer.tables.push_back(lobes_table(grid));
  answer.tables.push_back(limit_table(point.model, point.system, limits));
}

std::string short_table(const Point& point, const Json& result) {
  const Json& mu = result["multiplier"];
  std::string text =
      fmt::format("{}: a small vibration {} to {:.6f} of itself in each {} ({})\n",
                  result["verdict"].get<std::string>(),
                  mu["absolute"].get<double>() < 1 ? "fades" : "grows",
                  mu["absolute"].get<double>(), mu["period"].get<std::string>(),
                  mu["type"].get<std::string>());
  text += "frequencies [Hz], strongest first:";
  for (const Json& f : mu["chatter_frequencies_Hz"]) {
    text += fmt::format(" {:.2f}", f.get<double>());
  }
  text += '\n';
  const double speed = unit::in(point.given.setup.cut.Omega, unit::rpm);
  if (result["limit_depth_mm"].is_null()) {
    text += fmt::format("at {:g} rpm no axial depth up to {:g} mm is unstable\n", speed,
                        result["greatest_depth_mm"].get<double>());
  } else {
    text += fmt::format(
        "at {:g} rpm unstable from {:.5g} mm axial depth on; here {:g} mm\n", speed,
        result["limit_depth_mm"].get<double>(),
        unit::in(point.given.setup.cut.a_p, unit::mm));
  }
  return text;
}

}  // namespace

results::Answer stability(const inputs::Case& given, const Progress& progress) {
  results::Answer answer{
      .command = "stability",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const Point point = point_of(given);
  const double growth = std::abs(point.multiplier.value);
  const std::vector<double> depth = base::values(*point.options.axial_depth);
  std::string verdict = verdict_of(growth, point.options.margin);
  Json result;
  add_multiplier(point, result);
  result["stable"] = growth < 1;
  add_floor(point, verdict, answer, result);
  result["verdict"] = verdict;
  add_limit(point, depth, result);
  result["spindle_rpm"] = unit::in(given.setup.cut.Omega, unit::rpm);
  result["axial_depth_mm"] = unit::in(given.setup.cut.a_p, unit::mm);
  add_modes(point, answer, result);
  if (!cuts(point.directional)) {
    answer.heading.warnings.push_back(
        {"no_cut", "No tooth cuts anything: nothing but damping is left."});
  }
  if (point.multiplier.error > point.options.tolerance * std::max(1.0, growth)) {
    answer.heading.warnings.push_back(
        {"tolerance", fmt::format("The multiplier is good to {:.1e} only.",
                                  point.multiplier.error)});
  }
  add_lobes(point, depth, progress, answer);
  answer.heading.message = fmt::format("The cut is {}.", verdict);
  answer.short_table = short_table(point, result);
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace trochoid::run
