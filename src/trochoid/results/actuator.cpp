#include <trochoid/results/actuator.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

using structure::ActuatorDynamics;
using structure::ActuatorFit;

const Columns<ActuatorResult>& step_columns() {
  using R = const ActuatorResult&;
  static const Columns<ActuatorResult> all{
      "fitted.csv",
      [](R r) { return r.record.time.size(); },
      {{"time_s", "as recorded", [](R r, std::size_t i) { return r.record.time[i]; }},
       {"command_um", "as recorded, where it was",
        [](R r, std::size_t i) { return given(r.command[i]); },
        [](R r) { return !r.command.empty(); }},
       {"position_um", "as recorded",
        [](R r, std::size_t i) { return given(r.record.position[i]); }},
       {"fitted_um", "the motion as fitted",
        [](R r, std::size_t i) { return given(r.fit.fitted[i]); },
        [](R r) { return r.fit.ok; }}}};
  return all;
}

const Fields<ActuatorFit>& actuator_error_fields() {
  static const Fields<ActuatorFit> all{
      {"gain", "of the same key", &ActuatorFit::gain_se},
      {"frequency_Hz", "of the same key", &ActuatorFit::frequency_se},
      {"damping_ratio", "of the same key", &ActuatorFit::damping_ratio_se},
      {"time_constants_s", "of the same key, or `null`",
       [](const ActuatorFit& f) {
         return f.time_constants ? Value(f.time_constants_se) : Value();
       }},
      {"sum_s", "of the same key", &ActuatorFit::sum_se},
      {"product_s2", "of the same key", &ActuatorFit::product_se},
      {"start_s", "of the same key; 0 where it is given", &ActuatorFit::start_se}};
  return all;
}

const Fields<ActuatorResult>& actuator_fields() {
  using R = const ActuatorResult&;
  const auto ok = [](R r) { return r.fit.ok; };
  const auto found = [](auto get) {
    return [get](R r) { return r.fit.ok ? Value(get(r.fit.dynamics)) : Value(); };
  };
  static const Fields<ActuatorResult> all{
      {"gain", "M-8; `null` with status failed",
       found([](const ActuatorDynamics& d) { return d.gain; })},
      {"frequency_Hz", "natural frequency", found([](const ActuatorDynamics& d) {
         return natural_frequency(d) / unit::Hz;
       })},
      {"damping_ratio", "of critical damping",
       found([](const ActuatorDynamics& d) { return damping_ratio(d); })},
      {"time_constants_s",
       "the longer one first, or `null` with the reason in `identifiable` (M-14)",
       [](R r) { return r.fit.ok ? Value(r.fit.time_constants) : Value(); }},
      {"sum_s", "of the two time constants, always well determined",
       [](R r) { return r.fit.dynamics.sum; }, ok},
      {"product_s2", "of the two, likewise", [](R r) { return r.fit.dynamics.product; },
       ok},
      {"se", "standard errors of all of these", actuator_error_fields(),
       [](R r) { return &r.fit; }, ok},
      Field<ActuatorResult>{
          "identifiable", "empty, or",
          [](R r) {
            Object why;
            if (!r.fit.time_constants) {
              why.push_back({"time_constants_s", r.fit.time_constants_reason});
            }
            return why;
          },
          ok}
          .with({{".time_constants_s", "why there are none"}}),
      {"start_s", "of the step, as fitted, or as given",
       [](R r) { return r.fit.start; }, ok},
      {"step_um", "of the command", [](R r) { return given(r.record.step); }, ok},
      {"half_power_frequency_Hz", "bandwidth (-3 dB), by the transfer function",
       [](R r) { return half_power_frequency(r.fit.dynamics); }, ok},
      {"low_frequency_delay_s", "of slow commands",
       [](R r) { return low_frequency_delay(r.fit.dynamics); }, ok},
      {"rise_time_10_90_s", "of a step",
       [](R r) {
         const ActuatorDynamics& d = r.fit.dynamics;
         return rise_time(d, 0.9) - rise_time(d, 0.1);
       },
       ok},
      {"rms_um", "that the fit leaves", [](R r) { return r.fit.rms; }, ok},
      {"explained",
       "1 less the sum of squares of the residual over the sum of squares of the "
       "motion",
       [](R r) { return r.fit.explained; }, ok}};
  return all;
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
                .result = actuator_fields().object(r),
                .tables = {step_columns().table(r)}};
  if (r.fit.ok) {
    answer.short_table = short_table(r.fit);
    if (r.fit.dynamics.gain > 0) {
      answer.texts.push_back({"actuator.toml", actuator_toml(r.fit)});
    }
  }
  return answer;
}

Description description_of_actuator() {
  Description all{.command = "actuator", .keys = actuator_fields().texts()};
  step_columns().add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
