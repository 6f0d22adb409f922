#include <trochoid/results/calibrate.h>

#include <trochoid/base/units.h>
#include <trochoid/results/calibrate_text.h>
#include <trochoid/results/estimate_value.h>
#include <trochoid/results/joint.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

using base::add_column;
using base::Estimate;
using surface::CoefficientFit;
using surface::Nominal;
using surface::Reading;
using surface::RunoutFit;

/// null where they are not known.
Object coefficients_value(const force::Law& law, bool known, const Estimate& K_tc,
                          const Estimate& K_rc) {
  const auto names = force::coefficient_quantities(law);
  Object value;
  set(value, names[0].key, known ? estimate_value(K_tc, names[0].unit) : Value());
  set(value, names[1].key, known ? estimate_value(K_rc, names[1].unit) : Value());
  return value;
}

/// One way to read the means.
Object model_value(const force::Law& law, const CoefficientFit& fit) {
  Object value{{"model", surface::name_of(fit.model)},
               {"feedback", surface::name_of(fit.feedback)},
               {"coefficients", coefficients_value(law, fit.ok, fit.K_tc, fit.K_rc)},
               {"correlation", fit.ok ? Value(fit.correlation) : Value()},
               {"rank", fit.rank},
               {"condition", fit.condition},
               {"rms_mm", fit.ok ? Value(fit.rms / unit::mm) : Value()}};
  if (!fit.ok) {
    value.push_back({"message", fit.message});
  }
  if (fit.known[0] != 0 || fit.known[1] != 0) {
    value.push_back({"combination", Object{{"K_tc_weight", fit.known[0]},
                                           {"K_rc_weight", fit.known[1]},
                                           {"value_MPa", estimate_value(fit.combination,
                                                                        unit::MPa)}}});
  }
  return value;
}

/// The parameters of each file's datum.
Array datum_value(const CalibrateResult& r) {
  using Kind = surface::DatumPart::Kind;
  const std::vector<Estimate>& found = r.calibration.coefficients.datum;
  const auto& parts = r.calibration.datum_parts;
  Array all;
  for (std::size_t set = 0; set < r.datum.size(); ++set) {
    Object one;
    Array slopes;
    for (std::size_t k = 0; k < std::min(parts.size(), found.size()); ++k) {
      if (parts[k].set != set) {
        continue;
      }
      switch (parts[k].kind) {
        case Kind::offset:
          one.push_back({"offset_mm", estimate_value(found[k], unit::mm)});
          break;
        case Kind::curvature:
          one.push_back({"curvature_mm", estimate_value(found[k], unit::mm)});
          break;
        default:
          slopes.push_back(estimate_value(found[k], 1.0));
      }
    }
    if (!slopes.empty()) {
      one.push_back({"slopes_mm_per_mm", std::move(slopes)});
    }
    all.emplace_back(std::move(one));
  }
  return all;
}

Array advice_value(const CalibrateResult& r) {
  const auto names = force::coefficient_quantities(r.law);
  Array all;
  for (const surface::Advice& a : r.calibration.models.advice) {
    all.push_back(
        Object{{"height_mm", a.height / unit::mm},
               {fmt::format("se_{}", names[0].key), a.se_K_tc / names[0].unit},
               {fmt::format("se_{}", names[1].key), a.se_K_rc / names[1].unit}});
  }
  return all;
}

Object runout_value(const CalibrateResult& r) {
  const RunoutFit& runout = r.calibration.runout;
  if (!runout.ok) {
    return {{"eccentricity_mm", nullptr},
            {"angle_deg", nullptr},
            {"identifiable", runout.message}};
  }
  Object value{
      {"eccentricity_mm", runout.eccentricity.value / unit::mm},
      {"eccentricity_se_mm", runout.eccentricity.se / unit::mm},
      {"angle_deg", runout.angle.value / unit::deg},
      {"angle_se_deg", runout.angle.se / unit::deg},
      {"angle_known_up_to_deg", runout.labelled ? Value() : Value(360.0 / r.teeth)},
      {"coefficients", coefficients_value(r.law, true, runout.K_tc, runout.K_rc)},
      {"correlation", runout.correlation},
      {"rms_without_mm", runout.rms_without / unit::mm},
      {"rms_mm", runout.rms / unit::mm}};
  if (chosen_fit(r.calibration.models).model == surface::Model::envelope) {
    value.push_back({"turn_begins_mm", runout.start.value / unit::mm});
  }
  return value;
}

/// What material.toml holds, with its covariance; a runout only where it was found
/// together with the coefficients.
Joint joint_of(const CalibrateResult& r) {
  const surface::FoundCoefficients& found = r.calibration.coefficients;
  const RunoutFit& runout = r.calibration.runout;
  const auto names = force::coefficient_quantities(r.law);
  Joint joint{.law = std::string(force::name_of(r.law))};
  std::vector<double> units;
  const auto add = [&](std::string name, double value, const Estimate& like,
                       double unit) {
    add_found(joint, std::move(name), value / unit, interval_factor(like));
    units.push_back(unit);
  };
  const double tr = found.correlation * found.K_tc.se * found.K_rc.se;
  std::vector<double> covariance = {found.K_tc.se * found.K_tc.se, tr, tr,
                                    found.K_rc.se * found.K_rc.se};
  if (r.calibration.with_runout && r.teeth > 1) {
    const double rho = runout.eccentricity.value;
    joint.teeth = static_cast<std::size_t>(r.teeth);
    add("runout.e_x_mm", rho * std::cos(runout.angle.value), runout.eccentricity,
        unit::mm);
    add("runout.e_y_mm", rho * std::sin(runout.angle.value), runout.eccentricity,
        unit::mm);
    covariance.assign(runout.covariance.begin(), runout.covariance.end());
  } else if (runout.ok) {
    joint.not_found.emplace_back("runout.eccentricity_mm",
                                 "found apart from the coefficients");
  }
  add(fmt::format("force.{}", names[0].key), found.K_tc.value, found.K_tc,
      names[0].unit);
  add(fmt::format("force.{}", names[1].key), found.K_rc.value, found.K_rc,
      names[1].unit);
  const bool known = std::isfinite(found.K_tc.se) && std::isfinite(found.K_rc.se);
  set_covariance(joint, known ? covariance : std::vector<double>{}, units);
  return joint;
}

/// How many readings there are, and what became of the others.
Object readings_value(const CalibrateResult& r) {
  return {{"used", r.readings.size()},
          {"skipped", r.skipped},
          {"repeats", r.repeats},
          {"repeatability_mm",
           r.repeatability ? Value(*r.repeatability / unit::mm) : Value()}};
}

/// One way to explain the readings.
Object explanation_value(const CalibrateResult& r, const surface::Explanation& e) {
  return {
      {"form", surface::name_of(e.form)},
      {"feedback", surface::name_of(e.feedback)},
      {"weight", e.weight},
      {"coefficients", coefficients_value(r.law, true, e.K_tc, e.K_rc)},
      {"eccentricity_mm",
       r.calibration.with_runout ? Value(e.eccentricity.value / unit::mm) : Value()},
      {"rms_mm", e.rms / unit::mm}};
}

/// What the readings decided, how they scatter, and which were left out.
void add_decisions(const CalibrateResult& r, Object& result) {
  const surface::Calibration& c = r.calibration;
  Array outliers;
  for (const surface::Outlier& out : c.outliers) {
    const Reading& one = r.readings[out.reading];
    outliers.emplace_back(Object{{"reading", out.reading + 1},
                                 {"x_mm", unit::in(one.travel, unit::mm)},
                                 {"height_mm", unit::in(one.height, unit::mm)},
                                 {"off_mm", out.residual / unit::mm}});
  }
  result.push_back({"outliers", std::move(outliers)});
  if (c.explanations.empty()) {
    return;
  }
  Array tried;
  for (const surface::Explanation& e : c.explanations) {
    tried.emplace_back(explanation_value(r, e));
  }
  result.push_back({"form", surface::name_of(c.explanations.front().form)});
  result.push_back({"explanations", std::move(tried)});
  result.push_back({"scatter", Object{{"own_mm", c.own_scatter / unit::mm},
                                      {"shared_mm", c.shared_scatter / unit::mm}}});
}

Object result_of(const CalibrateResult& r) {
  const surface::Calibration& c = r.calibration;
  const CoefficientFit& chosen = chosen_fit(c.models);
  Object result = model_value(r.law, chosen);
  if (c.with_runout || !c.explanations.empty()) {
    const surface::FoundCoefficients& found = c.coefficients;
    set(result, "coefficients",
        coefficients_value(r.law, true, found.K_tc, found.K_rc));
    set(result, "correlation", found.correlation);
    set(result, "rms_mm", found.rms / unit::mm);
  }
  if (!c.explanations.empty()) {
    set(result, "feedback", surface::name_of(c.explanations.front().feedback));
  }
  const auto add = [&](const char* key, Value value) {
    result.push_back({key, std::move(value)});
  };
  const std::vector<Estimate>& datum = c.coefficients.datum;
  const bool offset = !datum.empty() && !c.datum_parts.empty() &&
                      c.datum_parts.front().set == 0 &&
                      c.datum_parts.front().kind == surface::DatumPart::Kind::offset;
  if (c.ok) {
    add("covariance", joint_value(joint_of(r)));
  }
  add("offset_mm", offset ? Value(datum.front().value / unit::mm) : Value());
  if (!datum.empty()) {
    add("datum", datum_value(r));
  }
  add("noise_mm", c.ok ? Value(chosen.noise / unit::mm) : Value());
  add("means", c.models.nominal.size());
  add("readings", readings_value(r));
  Array fits;
  for (const CoefficientFit& fit : c.models.fits) {
    fits.emplace_back(model_value(r.law, fit));
  }
  add("answers", std::move(fits));
  add("ten_more_readings", advice_value(r));
  if (c.ok) {
    add("runout", runout_value(r));
  }
  if (c.runout.ok) {
    add("with_runout", c.with_runout);
  }
  add_decisions(r, result);
  return result;
}

/// Measured and fitted errors of every reading; a mean stands for all its readings.
base::Table residual_table(const CalibrateResult& r) {
  base::Table table{"residual.csv", {}};
  const std::vector<double>& predicted = r.calibration.predicted;
  const std::size_t n = r.readings.size();
  const auto add = [&](const char* name, const auto& value) {
    add_column(table, name, n, [&](std::size_t i) { return value(r.readings[i]); });
  };
  add("x_mm", [](const Reading& one) { return unit::in(one.x, unit::mm); });
  add("feed_mm", [](const Reading& one) { return unit::in(one.travel, unit::mm); });
  add("height_mm", [](const Reading& one) { return unit::in(one.height, unit::mm); });
  add("tooth", [](const Reading& one) { return one.tooth + 1; });
  add("measured_mm", [](const Reading& one) { return unit::in(one.error, unit::mm); });
  add_column(table, "fitted_mm", n,
             [&](std::size_t i) { return predicted[i] / unit::mm; });
  add_column(table, "residual_mm", n, [&](std::size_t i) {
    return (r.readings[i].error - predicted[i]) / unit::mm;
  });
  return table;
}

/// The means and what each way to read them makes of them.
base::Table fitted_table(const surface::ModelFits& models) {
  base::Table table{"fitted.csv", {}};
  const std::size_t n = models.nominal.size();
  const auto add = [&](const char* name, const auto& value) {
    add_column(table, name, n, [&](std::size_t i) { return value(models.nominal[i]); });
  };
  add("x_mm", [](const Nominal& mean) { return unit::in(mean.x, unit::mm); });
  add("feed_mm", [](const Nominal& mean) { return unit::in(mean.travel, unit::mm); });
  add("height_mm", [](const Nominal& mean) { return unit::in(mean.height, unit::mm); });
  add("readings", [](const Nominal& mean) { return mean.readings.size(); });
  add("mean_mm", [](const Nominal& mean) { return mean.error / unit::mm; });
  for (const CoefficientFit& fit : models.fits) {
    if (fit.ok) {
      const std::string with = fit.feedback == surface::Feedback::none
                                   ? ""
                                   : fmt::format("_{}", surface::name_of(fit.feedback));
      add_column(table, fmt::format("{}{}_mm", surface::name_of(fit.model), with), n,
                 [&](std::size_t i) { return fit.predicted[i] / unit::mm; });
    }
  }
  return table;
}

}  // namespace

Answer answer_of(const CalibrateResult& r) {
  Answer answer{.command = "calibrate", .heading = r.heading, .result = result_of(r)};
  if (r.calibration.ok) {
    answer.short_table = r.heading.message + "\n\n" + calibration_table(r);
    answer.tables.push_back(residual_table(r));
    answer.tables.push_back(fitted_table(r.calibration.models));
    answer.texts = {{"material.toml", calibrated_material(r)}};
  }
  return answer;
}

}  // namespace trochoid::results
