#include <trochoid/results/actuator.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

using base::add_column;
using structure::ActuatorDynamics;
using structure::ActuatorFit;

/// fitted.csv: command and motion as recorded, and the motion as fitted.
base::Table fitted_table(const ActuatorResult& r) {
  base::Table table{"fitted.csv", {}};
  add_column(table, "time_s", r.record.time.size(),
             [&](std::size_t i) { return r.record.time[i]; });
  const auto add = [&](const char* name, const std::vector<double>& values) {
    add_column(table, name, values.size(),
               [&](std::size_t i) { return unit::in(values[i], unit::um); });
  };
  if (!r.command.empty()) {
    add("command_um", r.command);
  }
  add("position_um", r.record.position);
  if (r.fit.ok) {
    add("fitted_um", r.fit.fitted);
  }
  return table;
}

Object errors_value(const ActuatorFit& fit) {
  return {
      {"gain", fit.gain_se},
      {"frequency_Hz", fit.frequency_se},
      {"damping_ratio", fit.damping_ratio_se},
      {"time_constants_s", fit.time_constants ? Value(fit.time_constants_se) : Value()},
      {"sum_s", fit.sum_se},
      {"product_s2", fit.product_se},
      {"start_s", fit.start_se}};
}

Object result_of(const ActuatorResult& r) {
  const ActuatorFit& fit = r.fit;
  if (!fit.ok) {
    return {{"gain", nullptr},
            {"frequency_Hz", nullptr},
            {"damping_ratio", nullptr},
            {"time_constants_s", nullptr}};
  }
  const ActuatorDynamics& d = fit.dynamics;
  Object identifiable;
  if (!fit.time_constants) {
    identifiable.push_back({"time_constants_s", fit.time_constants_reason});
  }
  return {{"gain", d.gain},
          {"frequency_Hz", natural_frequency(d) / unit::Hz},
          {"damping_ratio", damping_ratio(d)},
          {"time_constants_s", fit.time_constants},
          {"sum_s", d.sum},
          {"product_s2", d.product},
          {"se", errors_value(fit)},
          {"identifiable", std::move(identifiable)},
          {"start_s", fit.start},
          {"step_um", unit::in(r.record.step, unit::um)},
          {"half_power_frequency_Hz", half_power_frequency(d)},
          {"low_frequency_delay_s", low_frequency_delay(d)},
          {"rise_time_10_90_s", rise_time(d, 0.9) - rise_time(d, 0.1)},
          {"rms_um", fit.rms / unit::um},
          {"explained", fit.explained}};
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
    text += fmt::format("{:<34} {:>12.6g} +- {:.2g}\n", name, value,
                        base::normal_interval * error);
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

Answer answer_of(const ActuatorResult& r) {
  Answer answer{.command = "actuator",
                .heading = r.heading,
                .result = result_of(r),
                .tables = {fitted_table(r)}};
  if (r.fit.ok) {
    answer.short_table = short_table(r.fit);
    if (r.fit.dynamics.gain > 0) {
      answer.texts.push_back({"actuator.toml", actuator_toml(r.fit)});
    }
  }
  return answer;
}

}  // namespace trochoid::results
