#include <trochoid/results/json.h>
#include <trochoid/run/actuator.h>

#include <trochoid/base/units.h>
#include <trochoid/inputs/step_file.h>
#include <trochoid/structure/identify_actuator.h>

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace trochoid::run {

namespace {

using Json = nlohmann::ordered_json;
using structure::ActuatorDynamics;
using structure::ActuatorFit;

constexpr double half_interval = 1.96;  ///< of 95 %, in standard errors
constexpr double margin = 3.0;          ///< in standard errors

base::Table fitted_table(const inputs::StepFile& file, const ActuatorFit& fit) {
  base::Table table{"fitted.csv", {{"time_s", file.record.time}}};
  const auto add = [&](const char* name, const std::vector<double>& values) {
    base::Table::Column column{name, {}};
    for (const double value : values) {
      column.values.push_back(unit::in(value, unit::um));
    }
    table.columns.push_back(std::move(column));
  };
  if (!file.command.empty()) {
    add("command_um", file.command);
  }
  add("position_um", file.record.position);
  if (fit.ok) {
    add("fitted_um", fit.fitted);
  }
  return table;
}

Json errors_of(const ActuatorFit& fit) {
  Json se{{"gain", fit.gain_se},
          {"frequency_Hz", fit.frequency_se},
          {"damping_ratio", fit.damping_ratio_se},
          {"time_constants_s", nullptr},
          {"sum_s", fit.sum_se},
          {"product_s2", fit.product_se},
          {"start_s", fit.start_se}};
  if (fit.time_constants) {
    se["time_constants_s"] = fit.time_constants_se;
  }
  return se;
}

Json result_of(const ActuatorFit& fit, double step) {
  Json result{{"gain", nullptr},
              {"frequency_Hz", nullptr},
              {"damping_ratio", nullptr},
              {"time_constants_s", nullptr}};
  if (!fit.ok) {
    return result;
  }
  const ActuatorDynamics& d = fit.dynamics;
  result["gain"] = d.gain;
  result["frequency_Hz"] = natural_frequency(d) / unit::Hz;
  result["damping_ratio"] = damping_ratio(d);
  if (fit.time_constants) {
    result["time_constants_s"] = *fit.time_constants;
  }
  result["sum_s"] = d.sum;
  result["product_s2"] = d.product;
  result["se"] = errors_of(fit);
  Json known = Json::object();
  if (!fit.time_constants) {
    known["time_constants_s"] = fit.time_constants_reason;
  }
  result["identifiable"] = known;
  result["start_s"] = fit.start;
  result["step_um"] = unit::in(step, unit::um);
  result["half_power_frequency_Hz"] = half_power_frequency(d);
  result["low_frequency_delay_s"] = low_frequency_delay(d);
  result["rise_time_10_90_s"] = rise_time(d, 0.9) - rise_time(d, 0.1);
  result["rms_um"] = fit.rms / unit::um;
  result["explained"] = fit.explained;
  return result;
}

void add_warnings(const inputs::StepFile& file, const ActuatorFit& fit,
                  results::Answer& answer) {
  if (fit.dynamics.gain < 0) {
    answer.heading.warnings.push_back(
        {"negative_gain",
         "The actuator moves against its command: is the sensor reversed? "
         "actuator.toml is not written."});
  }
  const auto& change = file.record.change;
  if (!change || file.record.start) {
    return;
  }
  const double late = fit.start - (*change)[1];
  const double early = (*change)[0] - fit.start;
  if (std::max(late, early) > margin * fit.start_se) {
    answer.heading.warnings.push_back(
        {"start_differs",
         fmt::format("The motion fits a step {:.3g} ms {} than the command shows it{}",
                     1e3 * std::max(late, early), late > early ? "later" : "earlier",
                     late > early
                         ? ": a dead time, or a third pole, which the two poles "
                           "of the model do not have."
                         : ": check the times of the record.")});
  }
}

std::string actuator_toml(const ActuatorFit& fit) {
  const ActuatorDynamics& d = fit.dynamics;
  return fmt::format(
      "# Found by trochoid actuator. Use it in another case with\n"
      "#   include = \"<this file>\"\n\n"
      "[actuator]\n"
      "gain = {}  # standard error {:.2g}\n"
      "frequency_Hz = {}  # {:.2g}\n"
      "damping_ratio = {}  # {:.2g}\n",
      d.gain, fit.gain_se, natural_frequency(d) / unit::Hz, fit.frequency_se,
      damping_ratio(d), fit.damping_ratio_se);
}

std::string short_table(const ActuatorFit& fit) {
  const ActuatorDynamics& d = fit.dynamics;
  std::string text;
  const auto row = [&](const char* name, double value, double error) {
    text +=
        fmt::format("{:<34} {:>12.6g} +- {:.2g}\n", name, value, half_interval * error);
  };
  row("gain", d.gain, fit.gain_se);
  row("natural frequency [Hz]", natural_frequency(d) / unit::Hz, fit.frequency_se);
  row("damping ratio", damping_ratio(d), fit.damping_ratio_se);
  row("sum of the time constants [ms]", 1e3 * d.sum, 1e3 * fit.sum_se);
  row("product of the time constants [ms2]", 1e6 * d.product, 1e6 * fit.product_se);
  if (fit.time_constants) {
    row("longer time constant [ms]", 1e3 * (*fit.time_constants)[0],
        1e3 * fit.time_constants_se[0]);
    row("shorter time constant [ms]", 1e3 * (*fit.time_constants)[1],
        1e3 * fit.time_constants_se[1]);
  } else {
    text += "time constants: not given, " + fit.time_constants_reason + '\n';
  }
  if (fit.start_se > 0) {
    row("start of the step [ms]", 1e3 * fit.start, 1e3 * fit.start_se);
  }
  text += fmt::format(
      "(+-: half of a 95 % interval) gain down by 3 dB at {:.4g} Hz, slow commands "
      "late by "
      "{:.4g} ms\nthe fit leaves {:.3g} um (rms)\n",
      half_power_frequency(d), 1e3 * low_frequency_delay(d), fit.rms / unit::um);
  return text;
}

}  // namespace

inputs::StepSource step_source(const inputs::StepTables& step) {
  return {.file = step.file,
          .location = step.location,
          .step = step.step,
          .start = step.start};
}

results::Answer actuator(const inputs::Case& given) {
  const inputs::StepTables& step = *given.machine.step;
  results::Answer answer{
      .command = "actuator",
      .heading = {.title = given.title, .case_toml = given.as_understood}};
  const inputs::StepFile file = inputs::read_step(step_source(step));
  const ActuatorFit fit = structure::identify_actuator(file.record);
  answer.heading.warnings = file.notes;
  answer.heading.ok = fit.ok;
  answer.tables.push_back(fitted_table(file, fit));
  answer.result = results::json_value(result_of(fit, file.record.step).dump());
  if (!fit.ok) {
    answer.heading.message = fit.reason;
    return answer;
  }
  add_warnings(file, fit, answer);
  answer.short_table = short_table(fit);
  if (fit.dynamics.gain > 0) {
    answer.texts.push_back({"actuator.toml", actuator_toml(fit)});
  }
  answer.heading.message = fmt::format("Gain and two poles from {} samples of a step.",
                                       file.record.time.size());
  return answer;
}

}  // namespace trochoid::run
