#include <trochoid/results/json.h>
#include <trochoid/run/calibrate.h>

#include <trochoid/base/units.h>
#include <trochoid/run/calibration_answer.h>
#include <trochoid/run/calibration_warnings.h>
#include <trochoid/run/measured_wall.h>
#include <trochoid/run/wall/setting.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;

/// Measured and fitted errors of every reading; a mean stands for all its readings.
base::Table residual_table(const MeasuredWall& wall,
                           const surface::ModelFits& calibration,
                           const surface::RunoutFit& runout) {
  base::Table table{"residual.csv",
                    {{"x_mm", {}},
                     {"feed_mm", {}},
                     {"height_mm", {}},
                     {"tooth", {}},
                     {"measured_mm", {}},
                     {"fitted_mm", {}},
                     {"residual_mm", {}}}};
  std::vector<double> fitted(wall.readings.size());
  const surface::CoefficientFit& chosen = calibration.fits[calibration.chosen];
  for (std::size_t i = 0; i < calibration.nominal.size(); ++i) {
    for (const std::size_t k : calibration.nominal[i].readings) {
      fitted[k] = chosen.predicted[i];
    }
  }
  if (runout.ok) {
    fitted = runout.predicted;
  }
  for (std::size_t i = 0; i < wall.readings.size(); ++i) {
    const surface::Reading& r = wall.readings[i];
    const double row[] = {
        unit::in(r.x, unit::mm),         unit::in(r.travel, unit::mm),
        unit::in(r.height, unit::mm),    static_cast<double>(r.tooth + 1),
        unit::in(r.error, unit::mm),     fitted[i] / unit::mm,
        (r.error - fitted[i]) / unit::mm};
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      table.columns[c].values.push_back(row[c]);
    }
  }
  return table;
}

/// The means and what each reading of the profile makes of them.
base::Table fitted_table(const surface::ModelFits& calibration) {
  base::Table table{"fitted.csv",
                    {{"x_mm", {}},
                     {"feed_mm", {}},
                     {"height_mm", {}},
                     {"readings", {}},
                     {"mean_mm", {}}}};
  for (const surface::CoefficientFit& answer : calibration.fits) {
    if (answer.ok) {
      table.columns.push_back(
          {fmt::format("{}{}_mm", surface::name_of(answer.model),
                       answer.feedback == surface::Feedback::none
                           ? ""
                           : fmt::format("_{}", surface::name_of(answer.feedback))),
           {}});
    }
  }
  for (std::size_t i = 0; i < calibration.nominal.size(); ++i) {
    const surface::Nominal& n = calibration.nominal[i];
    std::vector<double> row = {unit::in(n.x, unit::mm), unit::in(n.travel, unit::mm),
                               unit::in(n.height, unit::mm),
                               static_cast<double>(n.readings.size()),
                               n.error / unit::mm};
    for (const surface::CoefficientFit& answer : calibration.fits) {
      if (answer.ok) {
        row.push_back(answer.predicted[i] / unit::mm);
      }
    }
    for (std::size_t c = 0; c < row.size(); ++c) {
      table.columns[c].values.push_back(row[c]);
    }
  }
  return table;
}

results::Answer failed(results::Answer answer, const std::string& why,
                       const Json& result) {
  answer.heading.ok = false;
  answer.heading.message = why;
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace

results::Answer calibrate(const inputs::Case& given, const Progress& progress) {
  results::Answer answer{
      .command = "calibrate",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const MeasuredWall wall = measured_wall(given);
  const surface::Setting setting = wall_setting(given);
  if (progress) {
    progress("Fitting the coefficients");
  }
  const surface::ModelFits calibration =
      surface::fit_models(setting, wall.readings, wall.datum, wall_feedback(given));
  const surface::CoefficientFit& chosen =
      calibration.fits[std::min(calibration.chosen, calibration.fits.size() - 1)];
  Json result = calibration_json(given, calibration);
  const bool empty =
      std::all_of(wall.readings.begin(), wall.readings.end(),
                  [](const surface::Reading& r) { return r.error == 0; });
  if (!chosen.ok) {
    return failed(std::move(answer), refusal(given, chosen), result);
  }
  surface::RunoutFit runout;
  if (empty) {
    runout.message = "all readings are zero";
  } else {
    if (progress) {
      progress("Looking for runout");
    }
    runout = surface::find_runout(setting, wall.readings, wall.datum, calibration);
  }
  add_runout(runout, given, result);
  add_calibration_warnings(given, wall, calibration, runout, answer.heading.warnings);
  answer.tables = {residual_table(wall, calibration, runout),
                   fitted_table(calibration)};
  answer.texts = {{"material.toml", calibrated_material(given, calibration, runout)}};
  answer.short_table = calibration_table(given, calibration, runout);
  answer.heading.message = fmt::format("{} readings, {} means.", wall.readings.size(),
                                       calibration.nominal.size());
  answer.result = results::json_value(result.dump());
  return answer;
}

}  // namespace trochoid::run
