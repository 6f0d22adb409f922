// Writes a result folder with its report for each kind of page: write_samples DIR
#include <trochoid/report/report.h>
#include <trochoid/results/compared.h>
#include <trochoid/results/folder.h>
#include <trochoid/results/json.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>

#include "machine_samples.h"
#include "sample_cut.h"
#include "wall_samples.h"

namespace {

using trochoid::base::Table;
using trochoid::results::Answer;
using trochoid::results::json_value;

const std::string axes = "xyz";
const sample::Cut slot{{0.0, -0.008}, 0.04};

const std::string case_toml = R"(title = "St 52-3 slot, 8 mm HSS"

[tool]
shape = "cylinder"
teeth = 2
diameter_mm = 8
helix_deg = 30
pitch_deg = [180, 180]

[cut]
engagement = "slot"
axial_depth_mm = 2
feed_per_tooth_mm = 0.04
spindle_rpm = 875

[[measurement]]
file = "st52.csv"
columns = ["Fx", "Fy", "Fz"]
)";

const std::string identify_result = R"({
 "fits": [
  {"chip_model": "none", "lookback": "all", "ok": true, "message": "",
   "coefficients": {
    "K_tc_MPa": {"value": 2391.23, "se": 61.2, "low": 2271.3, "high": 2511.2},
    "K_rc_MPa": {"value": 1422.8, "se": 61.2, "low": 1302.8, "high": 1542.7},
    "K_ac_MPa": {"value": 302.0, "se": 48.1, "low": 207.7, "high": 396.3},
    "K_te_N_per_mm": {"value": 13.12, "se": 2.21, "low": 8.79, "high": 17.45},
    "K_re_N_per_mm": {"value": 6.61, "se": 2.21, "low": 2.28, "high": 10.94},
    "K_ae_N_per_mm": {"value": 1.72, "se": 1.72, "low": -1.65, "high": 5.09}},
   "runout": null, "phase_deg": [36.9], "phase_se_deg": [0.41],
   "rms_N": 33.41, "rms_axis_N": [24.1, 21.3, 9.1], "condition": 6.2, "rank": 6,
   "identifiable": {}},
  {"chip_model": "feed", "lookback": "all", "ok": true, "message": "",
   "coefficients": {
    "K_tc_MPa": {"value": 2583.1, "se": 26.1, "low": 2531.9, "high": 2634.3},
    "K_rc_MPa": {"value": 1539.4, "se": 26.1, "low": 1488.2, "high": 1590.6},
    "K_ac_MPa": {"value": 326.0, "se": 20.0, "low": 286.8, "high": 365.2},
    "K_te_N_per_mm": {"value": 8.02, "se": 0.95, "low": 6.16, "high": 9.88},
    "K_re_N_per_mm": {"value": 3.55, "se": 0.95, "low": 1.69, "high": 5.41},
    "K_ae_N_per_mm": null},
   "runout": {"radial_offsets_mm": [0, -0.0074], "radial_offsets_se_mm": [0, 0.00031],
              "eccentricity_mm": 0, "angle_deg": 0},
   "phase_deg": [37.15], "rms_N": 14.02, "rms_axis_N": [9.4, 9.1, 4.9],
   "condition": 6.3, "rank": 6,
   "identifiable": {"K_ae_N_per_mm": "the axial edge force cannot be told from the drift"}},
  {"chip_model": "trochoidal", "lookback": "all", "ok": true, "message": "",
   "coefficients": {
    "K_tc_MPa": {"value": 2618.21, "se": 21.2, "low": 2576.6, "high": 2659.8},
    "K_rc_MPa": {"value": 1561.7, "se": 21.2, "low": 1520.1, "high": 1603.3},
    "K_ac_MPa": {"value": 330.2, "se": 16.6, "low": 297.6, "high": 362.8},
    "K_te_N_per_mm": {"value": 7.06, "se": 0.77, "low": 5.55, "high": 8.57},
    "K_re_N_per_mm": {"value": 2.97, "se": 0.77, "low": 1.46, "high": 4.48},
    "K_ae_N_per_mm": null},
   "runout": {"radial_offsets_mm": [0, -0.00803], "radial_offsets_se_mm": [0, 0.00025],
              "eccentricity_mm": 0, "angle_deg": 0},
   "phase_deg": [37.04], "rms_N": 11.63, "rms_axis_N": [7.1, 7.0, 6.0],
   "condition": 6.4, "rank": 6,
   "identifiable": {"K_ae_N_per_mm": "the axial edge force cannot be told from the drift"}}],
 "chosen": "trochoidal",
 "signal": {"spindle_rpm": [874.92], "stated_spindle_rpm": [875], "axes": ["-x", "-y", "-z"],
            "revolutions": [4], "drift_N_per_s": [1.31, -0.42, 0.08]}
})";

Table identify_table(const std::string& file, int revolutions, bool residual) {
  const std::array<std::string, 3> models = {"none", "feed", "trochoidal"};
  const std::array<sample::Cut, 3> cuts = {sample::Cut{{0.0, 0.0}, 0.04},
                                           sample::Cut{{0.0, -0.0074}, 0.04}, slot};
  Table table{file, {{"run", {}}, {"angle_deg", {}}}};
  const auto add_columns = [&](const std::string& name) {
    for (const char axis : axes) {
      table.columns.push_back({std::string("F") + axis + "_" + name + "_N", {}});
    }
  };
  if (!residual) add_columns("measured");
  for (const auto& model : models) add_columns(model);

  std::uint32_t state = 7;
  for (int i = 0; i < 720 * revolutions; ++i) {
    const double phi = 0.5 * i;
    std::array<double, 3> measured = sample::force(slot, phi + 37.0);
    for (double& f : measured) f += 12.0 * sample::scatter(state);
    std::size_t column = 0;
    table.columns[column++].values.push_back(1);
    table.columns[column++].values.push_back(phi);
    if (!residual) {
      for (const double f : measured) table.columns[column++].values.push_back(f);
    }
    for (const auto& cut : cuts) {
      const auto fitted = sample::force(cut, phi + 37.0);
      for (std::size_t q = 0; q < 3; ++q) {
        table.columns[column++].values.push_back(residual ? measured[q] - fitted[q]
                                                          : fitted[q]);
      }
    }
  }
  return table;
}

Table sweep() {
  Table table{"sweep.csv",
              {{"offset_um", {}},
               {"rms_none_N", {}},
               {"rms_feed_N", {}},
               {"rms_trochoidal_N", {}}}};
  for (int offset = -20; offset <= 20; ++offset) {
    table.columns[0].values.push_back(offset);
    table.columns[1].values.push_back(33.41);
    table.columns[2].values.push_back(std::hypot(14.0, 3.6 * (offset + 7.4)));
    table.columns[3].values.push_back(std::hypot(11.6, 3.9 * (offset + 8.03)));
  }
  return table;
}

Table chip_curve(const sample::Cut& cut) {
  Table table{"chip_curve.csv", {{"theta_deg", {}}}};
  for (std::size_t k = 0; k < cut.offsets_mm.size(); ++k) {
    table.columns.push_back({"h_tooth" + std::to_string(k + 1) + "_mm", {}});
  }
  for (int theta = 0; theta <= 180; ++theta) {
    table.columns[0].values.push_back(theta);
    for (std::size_t k = 0; k < cut.offsets_mm.size(); ++k) {
      table.columns[k + 1].values.push_back(sample::chip(cut, k, theta));
    }
  }
  return table;
}

Answer identify() {
  Answer answer;
  answer.command = "identify";
  answer.heading.title = "St 52-3 slot, 8 mm HSS";
  answer.heading.message =
      "The trochoidal chip with runout explains the record best: 11.6 N rms remain.";
  answer.heading.warnings = {
      {"not_identifiable",
       "K_ae cannot be told from the drift of the z channel; it is left out."},
      {"correlated_residuals",
       "Neighbouring residuals are alike (0.61): the intervals are too narrow."}};
  answer.result = json_value(identify_result);
  answer.short_table = "K_tc  2618 MPa\n";
  answer.heading.case_toml = case_toml;
  answer.tables = {identify_table("fitted.csv", 4, false),
                   identify_table("residual.csv", 4, true), sweep(), chip_curve(slot)};
  return answer;
}

Answer simulate() {
  const sample::Cut cut{{0.0, -0.05, 0.012, 0.004}, 0.04};
  Answer answer;
  answer.command = "simulate";
  answer.heading.title =
      "Up milling with runout <b> & \"quotes\" \xC2\xB5 \xE2\x80\x93 \xE5\x88\x80";
  answer.heading.message = "Three of four teeth cut; the peak force is 1412 N.";
  answer.heading.warnings = {{"idle_tooth",
                              "Tooth 2 cuts nothing: its neighbours reach further "
                              "by more than the feed. </script><b>&"}};
  answer.result =
      json_value(R"({"mean_N": [-220.3, 164.8, -41.2], "min_N": [-812.1, -103, -98.4],
    "max_N": [45.3, 1240.7, 0], "rms_N": [318.2, 402, 52.7], "peak_xy_N": 1412.3,
    "torque_mean_Nm": 1.934, "torque_peak_Nm": 4.71, "power_W": 177.2,
    "bending_peak_Nm": 84.7, "bending_gauge_length_mm": 60,
    "volume_check": {"removed_mm3_per_rev": 2.56, "fed_mm3_per_rev": 2.56,
                     "relative_difference": 3.1e-9},
    "teeth": [{"tooth": 1, "intervals_deg": [[0, 180]], "peak_chip_mm": 0.0413},
              {"tooth": 2, "intervals_deg": [], "peak_chip_mm": 0},
              {"tooth": 3, "intervals_deg": [[-9.1, 189.1]], "peak_chip_mm": 0.0921},
              {"tooth": 4, "intervals_deg": [[-1.2, 12.1], [14, 168.9]],
               "peak_chip_mm": 0.0322}]})");
  answer.heading.case_toml = case_toml + "# </pre></script>\n";
  Table forces{"forces.csv",
               {{"angle_deg", {}},
                {"time_s", {}},
                {"Fx_N", {}},
                {"Fy_N", {}},
                {"Fz_N", {}},
                {"channel1_N", {}},
                {"channel2_N", {}},
                {"channel3_N", {}}}};
  for (int i = 0; i < 1440; ++i) {
    const auto f = sample::force(cut, 0.5 * i);
    const std::array<double, 8> row = {0.5 * i,  i * 9.5e-5, 4 * f[0],  4 * f[1],
                                       4 * f[2], -4 * f[0],  -4 * f[1], -4 * f[2]};
    for (std::size_t c = 0; c < row.size(); ++c) {
      forces.columns[c].values.push_back(row[c]);
    }
  }
  answer.tables = {forces, chip_curve(cut)};
  return answer;
}

Answer failed() {
  Answer answer;
  answer.command = "identify";
  answer.heading.title = "Twelve samples of a slot";
  answer.heading.ok = false;
  answer.heading.message =
      "The coefficients cannot be told apart: the record covers 6\xC2\xB0 of the "
      "revolution, so the six columns have rank 3. Measure at least one revolution.";
  answer.result = json_value(
      R"({"fits": [{"chip_model": "trochoidal", "lookback": "all", "ok": false,
    "message": "rank 3 of 6", "coefficients": {"K_tc_MPa": null, "K_rc_MPa": null},
    "runout": null, "rms_N": null, "rank": 3,
    "identifiable": {"K_tc_MPa": "parallel to K_te"}}], "chosen": null})");
  answer.heading.case_toml = case_toml;
  return answer;
}

/// The same answer with three states of wear, and an eccentricity of tool and holder.
Answer worn() {
  Answer answer = identify();
  trochoid::results::Array groups;
  for (const int state : {0, 1, 2}) {
    trochoid::results::Object K;
    const auto add = [&](const char* key, double value, double half) {
      set(K, key,
          trochoid::results::Object{{"value", value},
                                    {"se", half / 2},
                                    {"low", value - half},
                                    {"high", value + half}});
    };
    add("K_tc_MPa", 2618.2 + 12 * state, 41);
    add("K_te_N_per_mm", 7.1 + 6.4 * state, 1.5);
    set(K, "K_ae_N_per_mm", nullptr);
    groups.emplace_back(trochoid::results::Object{
        {"group", state == 0 ? trochoid::results::Value()
                             : "after " + std::to_string(10 * state) + " min <b>"},
        {"coefficients", std::move(K)},
        {"files", std::vector<std::string>{"a.csv", "b.csv"}}});
  }
  auto& result = std::get<trochoid::results::Object>(answer.result.data);
  set(result, "groups", std::move(groups));
  const std::string part =
      R"({"eccentricity_mm": {"value": 0.006, "se": 1e-4, "low": 0.0058, "high": 0.0062},
          "angle_deg": 50, "angle_se_deg": 1})";
  set(result, "clocking",
      json_value(R"({"total_indicator_reading_um": {"value": 29.2, "se": 0.1, "low": 29,
                     "high": 29.4}, "height_mm": 1, "longest_tooth": 2, "best_turn_deg": 130,
                     "least_eccentricity_mm": 0.004, "tool": )" +
                 part + R"(, "holder": )" + part + "}"));
  return answer;
}

/// The same answer with numbers that must not be used.
Answer doubtful() {
  Answer answer = identify();
  const std::string verdict =
      "Do not use these numbers: 80 % of the force (rms) is not explained.";
  answer.heading.message = verdict + " " + answer.heading.message;
  answer.heading.warnings.insert(answer.heading.warnings.begin(),
                                 {"do_not_use", verdict});
  answer.heading.warnings.push_back({"part_of_record", std::string(120, 'x')});
  answer.heading.warnings.push_back(
      {"cross_talk", "Corrected K_tc_MPa = 1885 and K_rc_MPa = 812.5. Check it."});
  set(std::get<trochoid::results::Object>(answer.result.data), "do_not_use",
      std::vector<std::string>{"80 % of the force (rms) is not explained"});
  return answer;
}

/// A command without a page of its own, with a table too long to be drawn whole.
Answer other() {
  Answer answer;
  answer.command = "listen";
  answer.heading.title = "Motion of a slender tool";
  answer.heading.message = "The motion is periodic after 14 revolutions.";
  answer.result = json_value(R"({"periodic": true, "peaks_um": [12.1, 9.7],
    "chip_area_mm2": {"before": 0.021, "after": 0.02}})");
  answer.heading.case_toml = case_toml;
  Table motion{"motion.csv",
               {{"time_s", {}}, {"x_um", {}}, {"y_um", {}}, {"Fx_N", {}}}};
  constexpr int count = 240'000;
  for (int i = 0; i < count; ++i) {
    const double t = 5e-6 * i;
    const bool spike = i == 170'001;
    motion.columns[0].values.push_back(t);
    motion.columns[1].values.push_back(12 * std::sin(600 * t) + (spike ? 40 : 0));
    motion.columns[2].values.push_back(9 * std::cos(610 * t));
    motion.columns[3].values.push_back(200 * std::sin(91.6 * t));
  }
  answer.tables = {motion,
                   {"surface.csv", {{"x_mm", {0, 0, 1}}, {"error_mm", {0.1, 0, 1}}}}};
  return answer;
}

/// Of two feeds.
Answer two_cuts() {
  Answer faster = simulate();
  faster.heading.title = "faster";
  for (auto& column : faster.tables.at(0).columns) {
    const bool force = column.name.starts_with("F");
    for (double& value : column.values) value *= force ? 1.25 : 1.0;
  }
  return trochoid::results::compared({"slow", simulate()}, {"fast", faster});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const std::filesystem::path root = argv[1];
  const auto cases = root / "cases";
  try {
    for (const auto& [name, answer] :
         {std::pair{"identify", identify()},
          std::pair{"simulate", simulate()},
          std::pair{"failed", failed()},
          std::pair{"doubtful", doubtful()},
          std::pair{"worn", worn()},
          std::pair{"other", other()},
          std::pair{"surface", sample::wall("envelope", cases / "envelope")},
          std::pair{"marks", sample::wall("imprint", cases / "imprint")},
          std::pair{"pulse", sample::wall("quasi_static", cases / "pulse")},
          std::pair{"calibrate",
                    sample::calibration("envelope", false, cases / "calibrate")},
          std::pair{"stability", sample::lobes(cases / "stability")},
          std::pair{"tool_point", sample::tool_point()},
          std::pair{"modes", sample::modes()},
          std::pair{"shared_modes", sample::shared_modes()},
          std::pair{"actuator", sample::actuator()},
          std::pair{"dynamics", sample::motion()},
          std::pair{"correct", sample::correction()},
          std::pair{"plan", sample::plan()},
          std::pair{"chatter", sample::chatter()},
          std::pair{"teeth", sample::calibration("imprint", true, cases / "teeth")},
          std::pair{"program", sample::along_program()},
          std::pair{"wall_plan", sample::wall_plan(cases / "wall_plan")},
          std::pair{"one_height", sample::one_height(cases / "one_height")}}) {
      const std::string summary = trochoid::results::summary_json(answer);
      trochoid::results::write_folder(root / name, answer,
                                      trochoid::report::html(answer, summary));
    }
    const Answer both = two_cuts();  // a page alone
    std::filesystem::create_directories(root / "compared");
    std::ofstream(root / "compared/report.html")
        << trochoid::report::html(both, trochoid::results::summary_json(both));
  } catch (const std::exception& error) {
    std::fputs(error.what(), stderr);
    return 1;
  }
  return 0;
}
