#include <trochoid/results/json.h>
#include <trochoid/run/simulate.h>

#include <trochoid/base/units.h>
#include <trochoid/force/closed_form.h>
#include <trochoid/force/forces.h>
#include <trochoid/run/angles.h>
#include <trochoid/run/chip_answer.h>
#include <trochoid/run/compare.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using Forces = std::vector<force::Vector3>;

/// A removed volume this much above what there is means a wrong chip model.
constexpr double volume_slack = 1e-3;

struct Statistics {
  force::Vector3 mean{};
  force::Vector3 min{};
  force::Vector3 max{};
  force::Vector3 rms{};
  double peak_xy = 0.0;
};

Statistics statistics(const Forces& forces) {
  Statistics s{.min = forces.front(), .max = forces.front()};
  const double n = static_cast<double>(forces.size());
  for (const force::Vector3& F : forces) {
    for (std::size_t q = 0; q < 3; ++q) {
      s.mean[q] += F[q] / n;
      s.rms[q] += F[q] * F[q] / n;
      s.min[q] = std::min(s.min[q], F[q]);
      s.max[q] = std::max(s.max[q], F[q]);
    }
    s.peak_xy = std::max(s.peak_xy, std::hypot(F[0], F[1]));
  }
  for (double& value : s.rms) {
    value = std::sqrt(value);
  }
  return s;
}

base::Table force_table(const inputs::Case& given, std::span<const double> phi,
                        const Forces& forces) {
  base::Table table{
      "forces.csv",
      {{"angle_deg", {}}, {"time_s", {}}, {"Fx_N", {}}, {"Fy_N", {}}, {"Fz_N", {}}}};
  const bool channels = given.dynamometer && !given.dynamometer->automatic;
  if (channels) {
    for (const char* name : {"channel1_N", "channel2_N", "channel3_N"}) {
      table.columns.push_back({name, {}});
    }
  }
  for (std::size_t i = 0; i < phi.size(); ++i) {
    table.columns[0].values.push_back(unit::in(phi[i], unit::deg));
    table.columns[1].values.push_back(phi[i] / given.setup.cut.Omega);
    for (std::size_t q = 0; q < 3; ++q) {
      table.columns[2 + q].values.push_back(forces[i][q]);
    }
    for (std::size_t q = 0; channels && q < 3; ++q) {
      const auto& row = given.dynamometer->matrix[q];
      table.columns[5 + q].values.push_back(
          row[0] * forces[i][0] + row[1] * forces[i][1] + row[2] * forces[i][2]);
    }
  }
  return table;
}

void add_loads(const inputs::Case& given, std::span<const force::Loads> loads,
               Json& result) {
  double mean = 0.0;
  double peak = 0.0;
  double bending = 0.0;
  for (const force::Loads& load : loads) {
    mean += load.torque / static_cast<double>(loads.size());
    peak = std::max(peak, load.torque);
    bending = std::max(bending, load.bending);
  }
  result["torque_mean_Nm"] = mean;
  result["torque_peak_Nm"] = peak;
  result["power_W"] = mean * given.setup.cut.Omega;
  if (given.gauge_length) {
    result["gauge_length_mm"] = unit::in(*given.gauge_length, unit::mm);
    result["bending_peak_Nm"] = bending;
  }
}

/// Teeth of a slice, idle ones as a warning.
void add_teeth(const SliceAnswer& slice, double height, results::Answer& answer,
               Json& result) {
  Json teeth = Json::array();
  const bool some_cut =
      std::any_of(slice.teeth.begin(), slice.teeth.end(),
                  [](const ToothEngagement& tooth) { return !tooth.arcs.empty(); });
  for (std::size_t j = 0; j < slice.teeth.size(); ++j) {
    const ToothEngagement& tooth = slice.teeth[j];
    Json arcs = Json::array();
    for (const chip::Arc& arc : tooth.arcs) {
      arcs.push_back({arc.from / unit::deg, arc.to / unit::deg});
    }
    teeth.push_back({{"tooth", j + 1},
                     {"intervals_deg", arcs},
                     {"peak_chip_mm", tooth.peak_chip / unit::mm}});
    if (tooth.arcs.empty() && some_cut) {
      answer.heading.warnings.push_back(
          {"idle_tooth",
           fmt::format("Tooth {} cuts nothing at {:g} mm above the tip: the runout "
                       "keeps it behind what the others leave.",
                       j + 1, height / unit::mm)});
    }
  }
  if (!some_cut) {
    answer.heading.warnings.push_back(
        {"no_cut", fmt::format("No tooth cuts anything at {:g} mm above the tip.",
                               height / unit::mm)});
  }
  result["teeth"] = teeth;
  result["teeth_height_mm"] = unit::in(height, unit::mm);
}

/// The chips of a turn against the material there is (C-8).
void add_volume(const force::Setup& setup, const SliceAnswer& slice,
                results::Answer& answer, Json& result) {
  if (slice.removal.available <= 0) {
    return;
  }
  const double ratio = slice.removal.removed / slice.removal.available;
  result["volume_check"] = {{"removed_mm2_per_rev", slice.removal.removed * 1e6},
                            {"feed_times_width_mm2", slice.removal.available * 1e6},
                            {"ratio", ratio}};
  if (std::abs(ratio - 1) > volume_slack) {
    const bool exact = setup.chip.model == chip::Model::trochoidal &&
                       setup.chip.lookback == chip::Lookback::all;
    answer.heading.warnings.push_back(
        {"volume",
         fmt::format(
             "The chips of one turn add up to {:.4f} times the feed times the width "
             "of cut. {}",
             ratio,
             exact ? "At this feed the cusps between the turns are no longer small."
                   : "Only model = \"trochoidal\" with lookback = \"all\" conserves "
                     "the material.")});
  }
}

std::string short_table(const Statistics& s, const Json& result) {
  std::string text = "force on the tool [N]      Fx         Fy         Fz\n";
  const auto row = [&](const char* name, const force::Vector3& v) {
    text +=
        fmt::format("  {:<16} {:>10.3f} {:>10.3f} {:>10.3f}\n", name, v[0], v[1], v[2]);
  };
  row("mean", s.mean);
  row("least", s.min);
  row("largest", s.max);
  row("rms", s.rms);
  text += fmt::format("  largest in the plane of the table: {:.3f} N\n", s.peak_xy);
  text += fmt::format("torque {:.4g} N m (peak {:.4g}), power {:.4g} W\n",
                      result["torque_mean_Nm"].get<double>(),
                      result["torque_peak_Nm"].get<double>(),
                      result["power_W"].get<double>());
  for (const Json& tooth : result["teeth"]) {
    text += fmt::format("tooth {}: ", tooth["tooth"].get<int>());
    if (tooth["intervals_deg"].empty()) {
      text += "cuts nothing\n";
      continue;
    }
    text +=
        fmt::format("chip up to {:.5f} mm, cuts", tooth["peak_chip_mm"].get<double>());
    for (const Json& arc : tooth["intervals_deg"]) {
      text += fmt::format(" {:.3f}..{:.3f} deg", arc[0].get<double>(),
                          arc[1].get<double>());
    }
    text += '\n';
  }
  if (result.contains("volume_check")) {
    text += fmt::format("self-check: the chips of a turn are {:.6f} of feed x width\n",
                        result["volume_check"]["ratio"].get<double>());
  }
  return text;
}

}  // namespace

std::vector<double> sampled_angles(const inputs::Sampling& sampling) {
  if (!sampling.angles.empty()) {
    return sampling.angles;
  }
  const auto count = static_cast<std::size_t>(
      std::max(1L, std::lround(sampling.samples_per_rev * sampling.revolutions)));
  std::vector<double> phi(count);
  for (std::size_t i = 0; i < count; ++i) {
    phi[i] = sampling.start +
             static_cast<double>(i) * (360.0 / sampling.samples_per_rev) * unit::deg;
  }
  return phi;
}

results::Answer simulate(const inputs::Case& given) {
  const force::Setup& setup = given.setup;
  results::Answer answer{
      .command = "simulate",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const std::vector<double> phi = sampled_angles(given.sampling);
  const std::vector<force::Loads> loads =
      force::loads(setup, given.law, phi, given.gauge_length.value_or(0.0),
                   given.sampling.tolerance);
  Forces forces(loads.size());
  std::transform(loads.begin(), loads.end(), forces.begin(),
                 [](const force::Loads& load) { return load.force; });
  const Statistics s = statistics(forces);
  Json result{{"mean_N", s.mean},
              {"min_N", s.min},
              {"max_N", s.max},
              {"rms_N", s.rms},
              {"peak_xy_N", s.peak_xy}};
  if (const auto mean = force::closed_form_mean(setup, given.law)) {
    result["closed_form_mean_N"] = *mean;
  }
  add_loads(given, loads, result);
  const auto& heights = given.sampling.edge_heights;
  const double height = heights.empty() ? default_height(setup) : heights.front();
  for (const double z : heights) {
    if (z > setup.cut.a_p) {
      answer.heading.warnings.push_back(
          {"height_above_cut",
           fmt::format("edge_heights_mm: {:g} mm lies above the axial depth; the chip "
                       "there is what a deeper cut would give.",
                       z / unit::mm)});
    }
  }
  const SliceAnswer slice = slice_answer(setup, height);
  add_teeth(slice, height, answer, result);
  add_volume(setup, slice, answer, result);
  if (setup.cut.f_z == 0) {
    answer.heading.warnings.push_back(
        {"zero_feed", "The feed is zero: nothing is cut."});
  }
  answer.tables.push_back(force_table(given, phi, forces));
  const std::vector<double> tip = {height};
  answer.tables.push_back(
      chip_table(setup, given.sampling.edge_angles, heights.empty() ? tip : heights));
  answer.tables.push_back(chip_curve(setup, height));
  if (!given.measurements.empty()) {
    compare(given, answer, result);
  }
  answer.heading.message =
      fmt::format("{} samples of the force on the tool.", phi.size());
  answer.short_table += short_table(s, result);
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace trochoid::run
