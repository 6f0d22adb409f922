#include <trochoid/results/calibrate.h>

#include <trochoid/base/units.h>
#include <trochoid/results/calibrate_text.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/joint.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::results {

namespace {

using base::Estimate;
using surface::CoefficientFit;
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
struct WayToRead {
  const force::Law& law;
  const CoefficientFit& fit;
};

const Fields<WayToRead>& way_fields() {
  using Of = const WayToRead&;
  static const Fields<WayToRead> combination{
      {"K_tc_weight", "of K_tc", [](Of w) { return w.fit.known[0]; }},
      {"K_rc_weight", "of K_rc", [](Of w) { return w.fit.known[1]; }},
      Field<WayToRead>{
          "value_MPa", "of the weighted sum",
          [](Of w) { return as_named(estimate_value(w.fit.combination, unit::MPa)); }}
          .with(below_estimate())};
  static const Fields<WayToRead> all{
      {"model", "as in `[surface] model`",
       [](Of w) { return surface::name_of(w.fit.model); }},
      {"feedback", "as in `[surface] feedback`",
       [](Of w) { return surface::name_of(w.fit.feedback); }},
      Field<WayToRead>{"coefficients", "`null` where they are not known",
                       [](Of w) {
                         return coefficients_value(w.law, w.fit.ok, w.fit.K_tc,
                                                   w.fit.K_rc);
                       }}
          .with(below_estimate(".*.")),
      {"correlation", "of the two",
       [](Of w) { return w.fit.ok ? Value(w.fit.correlation) : Value(); }},
      {"rank", "of the equations", [](Of w) { return w.fit.rank; }},
      {"condition", "condition number of the same",
       [](Of w) { return w.fit.condition; }},
      {"rms_mm", "that it leaves of the means",
       [](Of w) { return w.fit.ok ? Value(w.fit.rms) : Value(); }},
      {"message", "where it could not be fitted, why",
       [](Of w) { return w.fit.message; }, [](Of w) { return !w.fit.ok; }},
      {"combination", "where only a sum of the coefficients is known", combination,
       [](Of w) { return &w; },
       [](Of w) { return w.fit.known[0] != 0 || w.fit.known[1] != 0; }}};
  return all;
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

const Fields<CalibrateResult>& wall_runout_fields() {
  using R = const CalibrateResult&;
  const auto found = [](R r) { return r.calibration.runout.ok; };
  const auto of = [](auto get) {
    return [get](R r) { return get(r.calibration.runout); };
  };
  using Runout = const RunoutFit&;
  static const Fields<CalibrateResult> all{
      {"eccentricity_mm", "`null` where it is not known",
       [](R r) {
         const RunoutFit& f = r.calibration.runout;
         return f.ok ? Value(f.eccentricity.value) : Value();
       }},
      {"eccentricity_se_mm", "standard error",
       of([](Runout f) { return f.eccentricity.se; }), found},
      {"angle_deg", "from the tip of tooth 1 towards tooth 2, or `null`",
       [](R r) {
         const RunoutFit& f = r.calibration.runout;
         return f.ok ? Value(f.angle.value) : Value();
       }},
      {"identifiable", "why it is not known", of([](Runout f) { return f.message; }),
       [](R r) { return !r.calibration.runout.ok; }},
      {"angle_se_deg", "standard error", of([](Runout f) { return f.angle.se; }),
       found},
      {"angle_known_up_to_deg", "where teeth are not numbered, else `null`",
       [](R r) {
         return as_named(r.calibration.runout.labelled ? Value()
                                                       : Value(360.0 / r.teeth));
       },
       found},
      Field<CalibrateResult>{"coefficients", "found with the runout",
                             [](R r) {
                               const RunoutFit& f = r.calibration.runout;
                               return coefficients_value(r.law, true, f.K_tc, f.K_rc);
                             },
                             found}
          .with(below_estimate(".*.")),
      {"correlation", "of them", of([](Runout f) { return f.correlation; }), found},
      {"rms_without_mm", "that is left of all readings without runout",
       of([](Runout f) { return f.rms_without; }), found},
      {"rms_mm", "that is left with it", of([](Runout f) { return f.rms; }), found},
      {"turn_begins_mm", "envelope: where a turn begins along the wall",
       of([](Runout f) { return f.start.value; }), [](R r) {
         return r.calibration.runout.ok &&
                chosen_fit(r.calibration.models).model == surface::Model::envelope;
       }}};
  return all;
}

/// What material.toml holds, with its covariance; a runout only where it was found
/// together with the coefficients.
Joint joint_of_wall(const CalibrateResult& r) {
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
const Fields<CalibrateResult>& reading_fields() {
  using R = const CalibrateResult&;
  static const Fields<CalibrateResult> all{
      {"used", "how many", [](R r) { return r.readings.size(); }},
      {"skipped",
       "rows or points left out, without a value or, of a map, outside the cut",
       &CalibrateResult::skipped},
      {"repeats", "readings averaged with another of their place",
       &CalibrateResult::repeats},
      {"repeatability_mm",
       "standard deviation of one by its repeats, pooled over places and files, or `null`",
       &CalibrateResult::repeatability}};
  return all;
}

/// A part of the calibration, and the result that it is of.
template <class Part>
struct OfCalibration {
  const CalibrateResult& r;
  const Part& part;
};

template <class Part>
std::vector<OfCalibration<Part>> all_of(const CalibrateResult& r,
                                        const std::vector<Part>& parts) {
  std::vector<OfCalibration<Part>> out;
  for (const Part& part : parts) out.push_back({r, part});
  return out;
}

/// One way to explain the readings.
const Fields<OfCalibration<surface::Explanation>>& explanation_fields() {
  using Of = const OfCalibration<surface::Explanation>&;
  using Explained = OfCalibration<surface::Explanation>;
  static const Fields<Explained> all{
      {"form", "of the readings", [](Of e) { return surface::name_of(e.part.form); }},
      {"feedback", "of the cut",
       [](Of e) { return surface::name_of(e.part.feedback); }},
      {"weight", "its probability", [](Of e) { return e.part.weight; }},
      Field<Explained>{"coefficients", "by it",
                       [](Of e) {
                         return coefficients_value(e.r.law, true, e.part.K_tc,
                                                   e.part.K_rc);
                       }}
          .with(below_estimate(".*.")),
      {"eccentricity_mm", "by it, or `null`",
       [](Of e) {
         return e.r.calibration.with_runout ? Value(e.part.eccentricity.value)
                                            : Value();
       }},
      {"rms_mm", "that it leaves", [](Of e) { return e.part.rms; }}};
  return all;
}

const Fields<OfCalibration<surface::Outlier>>& outlier_fields() {
  using Of = const OfCalibration<surface::Outlier>&;
  static const Fields<OfCalibration<surface::Outlier>> all{
      {"reading", "number, from 1", [](Of out) { return out.part.reading + 1; }},
      {"x_mm", "along the feed",
       [](Of out) { return given(out.r.readings[out.part.reading].travel); }},
      {"height_mm", "above the tip",
       [](Of out) { return given(out.r.readings[out.part.reading].height); }},
      {"off_mm", "from what the others say", [](Of out) { return out.part.residual; }}};
  return all;
}

/// Whether the coefficients are of all readings, and not of the means of one way.
bool of_all_readings(const CalibrateResult& r) {
  return r.calibration.with_runout || !r.calibration.explanations.empty();
}

/// The coefficients that count: the keys of the chosen way, some of them of all readings.
Object counting_value(const CalibrateResult& r) {
  const surface::Calibration& c = r.calibration;
  Object result = way_fields().object({r.law, chosen_fit(c.models)});
  if (of_all_readings(r)) {
    const surface::FoundCoefficients& found = c.coefficients;
    set(result, "coefficients",
        coefficients_value(r.law, true, found.K_tc, found.K_rc));
    set(result, "correlation", found.correlation);
    set(result, "rms_mm", found.rms / unit::mm);
  }
  if (!c.explanations.empty()) {
    set(result, "feedback", surface::name_of(c.explanations.front().feedback));
  }
  return result;
}

bool has_offset(const surface::Calibration& c) {
  return !c.coefficients.datum.empty() && !c.datum_parts.empty() &&
         c.datum_parts.front().set == 0 &&
         c.datum_parts.front().kind == surface::DatumPart::Kind::offset;
}

std::vector<KeyText> datum_texts() {
  std::vector<KeyText> out;
  const auto add = [&](const std::string& key, const std::string& each,
                       std::string_view what) {
    out.push_back({key, what});
    for (const KeyText& text : below_estimate(each)) out.push_back(text);
  };
  add("[].offset_mm", "[].offset_mm.", "by which all its readings lie high");
  add("[].curvature_mm", "[].curvature_mm.", "over the height");
  add("[].slopes_mm_per_mm", "[].slopes_mm_per_mm[].",
      "along the feed, then over the height");
  return out;
}

const Fields<CalibrateResult>& calibrate_fields() {
  using R = const CalibrateResult&;
  const auto ok = [](R r) { return r.calibration.ok; };
  const auto decided = [](R r) { return !r.calibration.explanations.empty(); };
  static const Fields<CalibrateResult> scatter{
      {"own_mm", "standard deviation of each reading's own scatter",
       [](R r) { return r.calibration.own_scatter; }},
      {"shared_mm", "of what readings of a height or a place share",
       [](R r) { return r.calibration.shared_scatter; }}};
  static const Fields<CalibrateResult> all{
      Field<CalibrateResult>{"", "", counting_value}.with(way_fields().texts(".")),
      {"covariance", "what `[sweep] covariance` draws from", joint_fields(),
       [](R r) { return found_or_none(joint_of_wall(r)); }, ok},
      {"offset_mm", "of the first measurement, where asked for",
       [](R r) {
         return has_offset(r.calibration)
                    ? Value(r.calibration.coefficients.datum.front().value)
                    : Value();
       }},
      Field<CalibrateResult>{
          "datum", "of each measurement, where asked for", datum_value,
          [](R r) { return !r.calibration.coefficients.datum.empty(); }}
          .with(datum_texts()),
      {"noise_mm", "standard deviation of one reading",
       [](R r) {
         return r.calibration.ok ? Value(chosen_fit(r.calibration.models).noise)
                                 : Value();
       }},
      {"means", "how many there are of the readings",
       [](R r) { return r.calibration.models.nominal.size(); }},
      {"readings", "how many there are, and what became of the others",
       reading_fields(), [](R r) { return &r; }},
      {"answers", "every way to read the profile, side by side", way_fields(),
       [](R r) {
         std::vector<WayToRead> ways;
         for (const CoefficientFit& fit : r.calibration.models.fits) {
           ways.push_back({r.law, fit});
         }
         return ways;
       }},
      Field<CalibrateResult>{"ten_more_readings",
                             "standard errors with ten more readings at a height, best "
                             "first",
                             advice_value}
          .with({{"[].height_mm", "above the tip"},
                 {"[].se_*", "of either coefficient, by its key"}}),
      {"runout", "with standard errors, or why it is not known", wall_runout_fields(),
       [](R r) { return &r; }, ok},
      {"with_runout",
       "whether `coefficients` are from the fit to all readings together with the "
       "runout",
       [](R r) { return r.calibration.with_runout; },
       [](R r) { return r.calibration.runout.ok; }},
      {"outliers", "readings left out", outlier_fields(),
       [](R r) { return all_of(r, r.calibration.outliers); }},
      {"form", "where the readings decide: the likeliest form",
       [](R r) { return surface::name_of(r.calibration.explanations.front().form); },
       decided},
      {"explanations",
       "every form and feedback tried, likeliest first. The answer is the mean over "
       "them. `datum` and `residual.csv` are from the likeliest one",
       explanation_fields(), [](R r) { return all_of(r, r.calibration.explanations); },
       decided},
      {"scatter", "of the readings", scatter, [](R r) { return &r; }, decided}};
  return all;
}

/// Measured and fitted errors of every reading; a mean stands for all its readings.
const Columns<CalibrateResult>& reading_columns() {
  using R = const CalibrateResult&;
  static const Columns<CalibrateResult> all{
      "residual.csv",
      [](R r) { return r.readings.size(); },
      {{"x_mm", "of every reading, along the wall",
        [](R r, std::size_t i) { return given(r.readings[i].x); }},
       {"feed_mm", "of the feed within the pass",
        [](R r, std::size_t i) { return given(r.readings[i].travel); }},
       {"height_mm", "above the tip",
        [](R r, std::size_t i) { return given(r.readings[i].height); }},
       {"tooth", "that made it, from 1; 0: not known",
        [](R r, std::size_t i) { return r.readings[i].tooth + 1; }},
       {"measured_mm", "error, positive where material is left",
        [](R r, std::size_t i) { return given(r.readings[i].error); }},
       {"fitted_mm", "the same by the fit",
        [](R r, std::size_t i) { return r.calibration.predicted[i]; }},
       {"residual_mm", "measured less fitted", [](R r, std::size_t i) {
          return r.readings[i].error - r.calibration.predicted[i];
        }}}};
  return all;
}

/// The fits that have something to show.
std::vector<const CoefficientFit*> fitted_ways(const surface::ModelFits& models) {
  std::vector<const CoefficientFit*> ways;
  for (const CoefficientFit& fit : models.fits) {
    if (fit.ok) ways.push_back(&fit);
  }
  return ways;
}

/// The means and what each way to read them makes of them.
const Columns<surface::ModelFits>& mean_columns() {
  using Of = const surface::ModelFits&;
  static const Columns<surface::ModelFits> all{
      "fitted.csv",
      [](Of m) { return m.nominal.size(); },
      {{"x_mm", "of each mean, along the wall",
        [](Of m, std::size_t i) { return given(m.nominal[i].x); }},
       {"feed_mm", "of the feed within the pass",
        [](Of m, std::size_t i) { return given(m.nominal[i].travel); }},
       {"height_mm", "above the tip",
        [](Of m, std::size_t i) { return given(m.nominal[i].height); }},
       {"readings", "that it is of",
        [](Of m, std::size_t i) { return m.nominal[i].readings.size(); }},
       {"mean_mm", "error, positive where material is left",
        [](Of m, std::size_t i) { return m.nominal[i].error; }},
       {"*_mm", "what each answer makes of them: `imprint_mm`, `envelope_mm`, ...",
        [](Of m) {
          std::vector<std::string> names;
          for (const CoefficientFit* fit : fitted_ways(m)) {
            const bool none = fit->feedback == surface::Feedback::none;
            names.push_back(fmt::format("{}{}{}", surface::name_of(fit->model),
                                        none ? "" : "_",
                                        none ? "" : surface::name_of(fit->feedback)));
          }
          return names;
        },
        [](Of m, std::size_t i, std::size_t k) {
          return fitted_ways(m)[k]->predicted[i];
        }}}};
  return all;
}

}  // namespace

Answer answer_of(const CalibrateResult& r) {
  if (!r.traces.empty()) return answer_of_finish(r);
  Answer answer{.command = "calibrate",
                .heading = r.heading,
                .result = calibrate_fields().object(r)};
  if (r.calibration.ok) {
    answer.short_table = r.heading.message + "\n\n" + calibration_table(r);
    answer.tables.push_back(reading_columns().table(r));
    answer.tables.push_back(mean_columns().table(r.calibration.models));
    answer.texts = {{"material.toml", calibrated_material(r)}};
  }
  return answer;
}

Description description_of_calibrate() {
  Description all{.command = "calibrate", .keys = calibrate_fields().texts()};
  reading_columns().add_texts(all.columns);
  mean_columns().add_texts(all.columns);
  add_finish_description(all);
  return all;
}

}  // namespace trochoid::results
