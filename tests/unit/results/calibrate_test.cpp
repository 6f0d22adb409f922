#include <trochoid/results/calibrate.h>
#include <trochoid/results/json.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace trochoid::results::calibrate_test {

using base::Estimate;

Estimate estimate(double value, double se) {
  return {value, se, value - 2 * se, value + 2 * se};
}

/// Two readings, one mean, two fits of which the second is chosen.
CalibrateResult made() {
  CalibrateResult r{
      .readings = {{.x = 1e-3, .height = 0.5e-3, .error = 4e-6, .tooth = 0},
                   {.x = 1e-3, .height = 0.5e-3, .error = 6e-6, .tooth = 1}},
      .datum = {{.offset = true}},
      .law = force::LinearEdge{0, 0, 0, 5e3, 0, 0},
      .teeth = 2};
  surface::Calibration& c = r.calibration;
  c.ok = true;
  c.models.nominal = {{.x = 1e-3, .height = 0.5e-3, .error = 5e-6, .readings = {0, 1}}};
  surface::CoefficientFit fit{.ok = true,
                              .K_tc = estimate(800e6, 20e6),
                              .K_rc = estimate(300e6, 10e6),
                              .correlation = 0.5,
                              .datum = {estimate(1e-6, 0.5e-6)},
                              .rank = 3,
                              .condition = 12,
                              .noise = 1e-6,
                              .rms = 2e-6,
                              .predicted = {5e-6}};
  c.models.fits.push_back(fit);
  fit.model = surface::Model::envelope;
  fit.K_tc = estimate(810e6, std::numeric_limits<double>::quiet_NaN());
  c.models.fits.push_back(fit);
  c.models.chosen = 1;
  c.coefficients = {fit.K_tc, fit.K_rc, fit.correlation, fit.datum, fit.rms};
  c.datum_parts = {{.set = 0, .kind = trochoid::surface::DatumPart::Kind::offset}};
  c.predicted = {5e-6, 5e-6};
  c.runout.message = "one tooth";
  return r;
}

/// The same with runout, which counts.
CalibrateResult with_runout() {
  CalibrateResult r = made();
  surface::Calibration& c = r.calibration;
  c.runout = {.ok = true,
              .eccentricity = estimate(4e-6, 1e-6),
              .angle = estimate(1.0, 0.1),
              .K_tc = estimate(790e6, 15e6),
              .K_rc = estimate(310e6, 15e6),
              .correlation = 0.25,
              .datum = {estimate(2e-6, 0.5e-6)},
              .rms = 1e-6,
              .predicted = {4e-6, 6e-6}};
  c.runout_seen = true;
  c.with_runout = true;
  c.coefficients = {c.runout.K_tc, c.runout.K_rc, c.runout.correlation, c.runout.datum,
                    c.runout.rms};
  c.predicted = c.runout.predicted;
  return r;
}

std::string text_at(const Value& value, const std::vector<std::string>& keys) {
  const Value* at = &value;
  for (const std::string& key : keys) {
    at = at == nullptr ? nullptr : find(*at, key);
  }
  return at == nullptr ? "none" : json_text(*at);
}

const base::Table& table_of(const Answer& answer, const std::string& file) {
  return *std::find_if(answer.tables.begin(), answer.tables.end(),
                       [&](const base::Table& t) { return t.file == file; });
}

TEST(CalibrateAnswer, UnknownIsNull) {
  const Value result = answer_of(made()).result;
  EXPECT_EQ(text_at(result, {"coefficients", "K_tc_MPa", "value"}), "810");
  EXPECT_EQ(text_at(result, {"coefficients", "K_tc_MPa", "se"}), "null");
  EXPECT_EQ(text_at(result, {"runout", "eccentricity_mm"}), "null");
  EXPECT_EQ(text_at(result, {"runout", "identifiable"}), "\"one tooth\"");
  EXPECT_EQ(text_at(result, {"with_runout"}), "none");
}

TEST(CalibrateAnswer, TheFitThatCountsStandsOnTop) {
  const Value means = answer_of(made()).result;
  EXPECT_EQ(text_at(means, {"model"}), "\"envelope\"");
  EXPECT_EQ(text_at(means, {"offset_mm"}), "0.001");
  const Value joint = answer_of(with_runout()).result;
  EXPECT_EQ(text_at(joint, {"coefficients", "K_tc_MPa", "value"}), "790");
  EXPECT_EQ(text_at(joint, {"correlation"}), "0.25");
  EXPECT_EQ(text_at(joint, {"rms_mm"}), "0.001");
  EXPECT_EQ(text_at(joint, {"offset_mm"}), "0.002");
  EXPECT_EQ(text_at(joint, {"with_runout"}), "true");
  EXPECT_EQ(text_at(joint, {"runout", "angle_known_up_to_deg"}), "180");
  // The means stay beside it as they were.
  const auto& fits = std::get<Array>(find(joint, "answers")->data);
  ASSERT_EQ(fits.size(), 2U);
  EXPECT_EQ(text_at(fits[1], {"coefficients", "K_tc_MPa", "value"}), "810");
}

TEST(CalibrateAnswer, SaysWhatBecameOfTheReadings) {
  CalibrateResult r = made();
  EXPECT_EQ(text_at(answer_of(r).result, {"readings", "used"}), "2");
  EXPECT_EQ(text_at(answer_of(r).result, {"readings", "repeatability_mm"}), "null");
  r.skipped = 3;
  r.repeats = 4;
  r.repeatability = 2e-6;
  const Value result = answer_of(r).result;
  EXPECT_EQ(text_at(result, {"readings", "skipped"}), "3");
  EXPECT_EQ(text_at(result, {"readings", "repeats"}), "4");
  EXPECT_EQ(text_at(result, {"readings", "repeatability_mm"}), "0.002");
}

TEST(CalibrateAnswer, DatumIsToldOfEachFile) {
  CalibrateResult r = made();
  r.datum = {{}, {.offset = true, .tilt = true}};
  using Kind = trochoid::surface::DatumPart::Kind;
  r.calibration.datum_parts = {{.set = 1, .kind = Kind::offset},
                               {.set = 1, .kind = Kind::lean},
                               {.set = 1, .kind = Kind::tilt}};
  r.calibration.coefficients.datum = {estimate(1e-6, 0), estimate(2e-3, 0),
                                      estimate(3e-3, 0)};
  const Value result = answer_of(r).result;
  EXPECT_EQ(text_at(result, {"offset_mm"}), "null") << "of the first file";
  const auto& datum = std::get<Array>(find(result, "datum")->data);
  ASSERT_EQ(datum.size(), 2U);
  EXPECT_EQ(json_text(datum[0]), "{}");
  EXPECT_EQ(text_at(datum[1], {"offset_mm", "value"}), "0.001");
  const auto& slopes = std::get<Array>(find(datum[1], "slopes_mm_per_mm")->data);
  ASSERT_EQ(slopes.size(), 2U);
  EXPECT_EQ(text_at(slopes[1], {"value"}), "0.003");
}

TEST(CalibrateAnswer, ColumnsCarryTheirNamesAndUnits) {
  const Answer answer = answer_of(made());
  const base::Table& residual = table_of(answer, "residual.csv");
  std::string names;
  for (const auto& column : residual.columns) names += column.name + ' ';
  EXPECT_EQ(names, "x_mm feed_mm height_mm tooth measured_mm fitted_mm residual_mm ");
  EXPECT_EQ(residual.columns[3].values, (std::vector<double>{1, 2}));
  EXPECT_NEAR(residual.columns[6].values[1], 1e-3, 1e-15);
  const base::Table& fitted = table_of(answer, "fitted.csv");
  names.clear();
  for (const auto& column : fitted.columns) names += column.name + ' ';
  EXPECT_EQ(names, "x_mm feed_mm height_mm readings mean_mm imprint_mm envelope_mm ");
  EXPECT_EQ(fitted.columns[3].values, std::vector<double>{2});
}

TEST(CalibrateAnswer, ThePrintedTableMarksWhatCounts) {
  const std::string means = answer_of(made()).short_table;
  EXPECT_NE(means.find("\n* envelope"), std::string::npos) << means;
  EXPECT_NE(means.find("\n  imprint"), std::string::npos) << means;
  EXPECT_NE(means.find("810.0 +- ?"), std::string::npos) << means;
  EXPECT_NE(means.find("runout: not known: one tooth\n"), std::string::npos) << means;
  const std::string joint = answer_of(with_runout()).short_table;
  EXPECT_NE(joint.find("\n  envelope"), std::string::npos) << joint;
  EXPECT_NE(joint.find("\n* all readings, with runout"), std::string::npos) << joint;
  EXPECT_NE(joint.find("(or 180 deg further"), std::string::npos) << joint;
}

TEST(CalibrateAnswer, MaterialHoldsWhatCountsAndWhatWasGiven) {
  const Answer answer = answer_of(with_runout());
  ASSERT_EQ(answer.texts.size(), 1U);
  const std::string& text = answer.texts.front().text;
  EXPECT_TRUE(text.starts_with("# Found by trochoid calibrate (envelope).")) << text;
  EXPECT_NE(text.find("K_tc_MPa = 790  # standard error 15\n"), std::string::npos)
      << text;
  EXPECT_NE(text.find("K_te_N_per_mm = 5  # as given"), std::string::npos) << text;
  EXPECT_NE(text.find("[runout]\neccentricity_mm = 0.004"), std::string::npos) << text;
  EXPECT_NE(answer_of(made()).texts.front().text.find("# [runout]: not seen"),
            std::string::npos);
}

TEST(CalibrateAnswer, ARefusalHoldsWhatIsKnownAllTheSame) {
  CalibrateResult r = made();
  surface::CoefficientFit& fit = r.calibration.models.fits[0];
  fit.ok = false;
  fit.message = "not told apart";
  fit.known = {0.8, 0.6};
  fit.combination = estimate(820e6, 10e6);
  r.calibration = {.models = {.fits = {fit}}};
  const Answer answer = answer_of(r);
  EXPECT_EQ(text_at(answer.result, {"coefficients", "K_tc_MPa"}), "null");
  EXPECT_EQ(text_at(answer.result, {"message"}), "\"not told apart\"");
  EXPECT_EQ(text_at(answer.result, {"combination", "value_MPa", "value"}), "820");
  EXPECT_EQ(text_at(answer.result, {"noise_mm"}), "null");
  EXPECT_EQ(text_at(answer.result, {"runout"}), "none");
  EXPECT_TRUE(answer.tables.empty() && answer.texts.empty());
}

}  // namespace trochoid::results::calibrate_test
