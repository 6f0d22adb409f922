#include <trochoid/results/program_steps.h>

#include <trochoid/base/units.h>
#include <trochoid/results/fit_value.h>
#include <trochoid/results/material.h>

#include <fmt/core.h>

#include <limits>

namespace trochoid::results {

namespace {

using engagement::Reads;

constexpr double not_recorded = std::numeric_limits<double>::quiet_NaN();

/// A coefficient in the unit of its key.
struct InUnit {
  const RecordCoefficient& one;
  double factor;
};

const Fields<InUnit>& coefficient_fields() {
  using C = const InUnit&;
  static const Fields<InUnit> all{
      {"key", "of [force]", [](C c) { return c.one.key; }},
      {"stated", "by the case, in the unit of the key",
       [](C c) { return as_named(c.one.stated / c.one.unit); }},
      {"found", "the same, from the record; left out: the record does not tell it",
       [](C c) { return as_named(c.one.found / c.one.unit); },
       [](C c) { return c.one.se.has_value(); }},
      {"se", "one standard error",
       [](C c) { return as_named(c.one.se.value_or(0.0) / c.one.unit); },
       [](C c) { return c.one.se.has_value(); }},
      {"low", "of the 95 % confidence interval",
       [](C c) {
         return as_named((c.one.found - c.factor * c.one.se.value_or(0.0)) /
                         c.one.unit);
       },
       [](C c) { return c.one.se.has_value(); }},
      {"high", "the same",
       [](C c) {
         return as_named((c.one.found + c.factor * c.one.se.value_or(0.0)) /
                         c.one.unit);
       },
       [](C c) { return c.one.se.has_value(); }}};
  return all;
}

std::vector<InUnit> coefficients_of(const ProgramRecord& record) {
  std::vector<InUnit> out;
  for (const RecordCoefficient& one : record.coefficients) {
    out.push_back({one, record.factor});
  }
  return out;
}

const Fields<engagement::SteadyCut>& cut_fields() {
  using C = const engagement::SteadyCut&;
  static const Fields<engagement::SteadyCut> all{
      {"line", "of the text", [](C c) { return c.line; }},
      {"turns", "of the spindle", [](C c) { return given(c.turns); }},
      {"spindle_rpm", "as found in the record", [](C c) { return c.run.cut.Omega; }},
      {"feed_per_tooth_mm", "that the machine made",
       [](C c) { return c.run.cut.f_z; }}};
  return all;
}

bool has_forces(const ProgramRecord& record) {
  return record.reads == engagement::Reads::forces;
}

/// Coefficients from the means of a record.
std::string means_text(const ProgramRecord& record) {
  if (record.coefficients.empty()) return {};
  std::string out = fmt::format("{:<18}{:>12}{:>12}{:>11}\n", "from the means",
                                "stated", "found", "+- (95 %)");
  for (const RecordCoefficient& one : record.coefficients) {
    out += fmt::format("{:<18}{:>12.4g}", one.key, one.stated / one.unit);
    out += one.se ? fmt::format("{:>12.4g}{:>11.2g}\n", one.found / one.unit,
                                record.factor * *one.se / one.unit)
                  : fmt::format("{:>12}\n", "not told");
  }
  return out;
}

/// Coefficients and runout from the forces in steady cuts.
std::string fit_text(const ProgramRecord& record) {
  if (!record.fit) return {};
  const identification::Fit& fit = *record.fit;
  if (!fit.ok) return fmt::format("no fit of steady cuts: {}\n", fit.message);
  std::string out = fmt::format(
      "from the forces in {} steady cuts; {:.1f} % of them not "
      "explained (rms)\n",
      record.cuts.size(), 100 * fit.unexplained.all);
  const auto row = [&](std::string_view key, double value, std::optional<double> se) {
    out += fmt::format("{:<30}{:>12.4g}", key, value);
    out += se ? fmt::format("{:>11.2g}\n", fit.interval_factor * *se) : "\n";
  };
  const auto quantities = force::coefficient_quantities(fit.law);
  for (std::size_t k = 0; k < quantities.size(); ++k) {
    const auto& one = fit.coefficients[k];
    if (one)
      row(quantities[k].key, one->value / quantities[k].unit,
          one->se / quantities[k].unit);
  }
  const auto& offsets = fit.runout.radial_offsets;
  for (std::size_t j = 1; j < offsets.size() && finds_offsets(fit.options.runout);
       ++j) {
    if (unidentifiable(fit, fmt::format("radial_offsets_mm[{}]", j + 1))) continue;
    const auto se =
        j < fit.radial_offsets_se.size() ? fit.radial_offsets_se[j] : std::nullopt;
    row(fmt::format("radial_offsets_um[{}]", j + 1), offsets[j] / unit::um,
        se ? std::optional(*se / unit::um) : std::nullopt);
  }
  if (finds_eccentricity(fit.options.runout)) {
    row("eccentricity_um", fit.runout.eccentricity / unit::um,
        fit.eccentricity_se ? std::optional(*fit.eccentricity_se / unit::um)
                            : std::nullopt);
  }
  return out;
}

/// Steps beside their record.
struct RecordRows {
  const std::vector<engagement::Step>& steps;
  const ProgramRecord& record;
};

const Columns<RecordRows>& record_columns() {
  using R = const RecordRows&;
  const auto of_record = [](auto get) {
    return [get](R r, std::size_t i) {
      const engagement::StepRecord& one = r.record.recorded.steps[i];
      return one.there ? get(one) : not_recorded;
    };
  };
  using S = const engagement::StepRecord&;
  const auto of_forces = [](R r) { return r.record.reads == Reads::forces; };
  const auto of_power = [](R r) { return r.record.reads == Reads::power; };
  const auto of_torque = [](R r) { return r.record.reads == Reads::torque; };
  static const Columns<RecordRows> all{
      "measured_steps.csv",
      [](R r) { return r.steps.size(); },
      {{"step", "as in steps.csv", [](R r, std::size_t i) { return r.steps[i].step; }},
       {"line", "of the text, from 1",
        [](R r, std::size_t i) { return r.steps[i].line; }},
       {"time_s", "of the program", [](R r, std::size_t i) { return r.steps[i].time; }},
       {"record_time_s", "of the record",
        [](R r, std::size_t i) { return r.record.recorded.steps[i].time; }},
       {"Fx_mean_N",
        "as measured, mean of the step in the axes of the program; empty: "
        "not in the record",
        of_record([](S s) { return s.mean[0]; }), of_forces},
       {"Fy_mean_N", "the same", of_record([](S s) { return s.mean[1]; }), of_forces},
       {"Fz_mean_N", "the same", of_record([](S s) { return s.mean[2]; }), of_forces},
       {"peak_xy_N", "largest force across the axis, as measured",
        of_record([](S s) { return s.peak_xy; }), of_forces},
       {"computed_Fx_mean_N", "as in steps.csv",
        [](R r, std::size_t i) { return r.steps[i].forces.mean[0]; }, of_forces},
       {"computed_Fy_mean_N", "the same",
        [](R r, std::size_t i) { return r.steps[i].forces.mean[1]; }, of_forces},
       {"computed_Fz_mean_N", "the same",
        [](R r, std::size_t i) { return r.steps[i].forces.mean[2]; }, of_forces},
       {"computed_peak_xy_N", "the same",
        [](R r, std::size_t i) { return r.steps[i].forces.peak_xy; }, of_forces},
       {"power_W", "of a record of power: as measured, less what air takes",
        of_record([](S s) { return s.mean[0]; }), of_power},
       {"computed_power_W", "the same, as in steps.csv",
        [](R r, std::size_t i) { return r.steps[i].forces.power; }, of_power},
       {"torque_Nm", "of a record of torque: as measured, less what air takes",
        of_record([](S s) { return s.mean[0]; }), of_torque},
       {"computed_torque_Nm", "the same, mean of the step as in steps.csv",
        [](R r, std::size_t i) { return r.steps[i].forces.torque_mean; }, of_torque}}};
  return all;
}

}  // namespace

const Fields<ProgramRecord>& record_fields() {
  using R = const ProgramRecord&;
  static const Fields<ProgramRecord> all{
      {"file", "the record", [](R r) { return r.file; }},
      {"numbers",
       "what `line_column` counts, `line` of the text or `block` (N): the record has the "
       "times of the program then, and `start_s` and `stretch` are what is left; else `null`",
       [](R r) { return r.numbers ? Value(name_of(*r.numbers)) : Value(); }},
      {"start_s", "of the program, in the time of the record",
       [](R r) { return r.alignment.start; }},
      {"stretch",
       "seconds of the record for a second of the program; where feeds were turned, for a second of its feed moves",
       [](R r) { return r.alignment.stretch; }},
      {"scatter_s", "of parts of the program about that, rms",
       [](R r) { return r.alignment.scatter; }},
      {"correlation", "of measured and computed mean forces; 1: alike but for a factor",
       [](R r) { return r.alignment.correlation; }},
      {"whole_correlation",
       "the same of the whole record in short times: before and after the program it should "
       "read air",
       [](R r) { return r.alignment.whole_correlation; }},
      {"covered", "part of the feed moves that the record has",
       [](R r) { return r.alignment.covered; }},
      {"reads", "`forces`, `power` or `torque`", [](R r) { return name_of(r.reads); }},
      {"steps", "in cut that the record has", [](R r) { return r.covered; }},
      {"mean_ratio", "measured over computed mean, median of these steps",
       [](R r) { return r.mean_ratio; }},
      {"peak_ratio", "the same of the largest force across the axis",
       [](R r) { return r.peak_ratio; }, has_forces},
      {"fitted_steps", "steady ones, from which the coefficients are found; 0: too few",
       [](R r) { return r.fitted_steps; }},
      {"rms_N", "of the mean forces that the coefficients found leave",
       [](R r) { return r.rms; },
       [](R r) { return r.fitted_steps > 0 && r.reads == Reads::forces; }},
      {"rms_W", "the same of a record of power", [](R r) { return r.rms; },
       [](R r) { return r.fitted_steps > 0 && r.reads == Reads::power; }},
      {"rms_Nm", "the same of a record of torque", [](R r) { return r.rms; },
       [](R r) { return r.fitted_steps > 0 && r.reads == Reads::torque; }},
      {"coefficients", "from the means of the steps", coefficient_fields(),
       [](R r) { return coefficients_of(r); }},
      {"cuts", "steady cuts whose forces tell the runout; none: too few samples",
       cut_fields(), [](R r) { return r.cuts; }, has_forces},
      {"fit", "of the forces in these cuts, as an entry of `fits` of `identify`",
       fit_fields(), [](R r) { return FitOfRecords{*r.fit}; },
       [](R r) { return r.fit.has_value(); }}};
  return all;
}

std::string record_text(const ProgramRecord& record) {
  std::string out =
      fmt::format("\nrecord {}: the program starts at {:.4g} s, {} steps in cut\n",
                  record.file, record.alignment.start, record.covered);
  out += has_forces(record)
             ? fmt::format(
                   "measured over computed: {:.3f} of the mean force, {:.3f} of "
                   "the largest\n",
                   record.mean_ratio, record.peak_ratio)
             : fmt::format("measured over computed {}: {:.3f}\n", name_of(record.reads),
                           record.mean_ratio);
  return out + means_text(record) + fit_text(record);
}

std::optional<std::string> material_of(const ProgramRecord& record) {
  if (!record.fit || !record.fit->ok) return std::nullopt;
  return material_toml(*record.fit, record.edge_length, "program");
}

base::Table table_of_record(const std::vector<engagement::Step>& steps,
                            const ProgramRecord& record) {
  return record_columns().table({steps, record});
}

void add_texts_of_record(std::vector<ColumnText>& out) {
  record_columns().add_texts(out);
}

}  // namespace trochoid::results
