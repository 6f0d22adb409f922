#include "made_readings.h"

#include <trochoid/surface/fit_nominal.h>

#include <gtest/gtest.h>

namespace trochoid::surface::fit_models_test {

constexpr Coefficients K = {800e6, 300e6, 0.0, 0.0};

void expect_truth(const CoefficientFit& a, double relative, Coefficients truth = K) {
  ASSERT_TRUE(a.ok) << a.message;
  EXPECT_NEAR(a.K_tc.value, truth[0], relative * truth[0]);
  EXPECT_NEAR(a.K_rc.value, truth[1], relative * truth[1]);
}

TEST(FitModels, ImprintsGiveTheCoefficientsBack) {  // [E-15]
  for (const bool down : {true, false}) {
    const Setting s = made_setting(Model::imprint, made_cut(down));
    const ModelFits c = fitted(s, imprints(s, K));
    expect_truth(chosen_fit(c), 1e-6);
    EXPECT_EQ(chosen_fit(c).rank, 2);
    EXPECT_LT(chosen_fit(c).rms, 1e-11);
    EXPECT_EQ(c.nominal.size(), 11U);
  }
}

TEST(FitModels, PulsesGiveTheCoefficientsBack) {  // [E-15]
  for (const bool down : {true, false}) {
    Setting s = made_setting(Model::quasi_static, made_cut(down));
    s.phase = 0.1;
    const ModelFits c = fitted(s, pulses(s, K, {.heights = {0.5e-3}}));
    expect_truth(chosen_fit(c), 1e-6);
    EXPECT_EQ(c.nominal.size(), 10U);
  }
}

TEST(FitModels, AForceByHandGivesItsCoefficientsBack) {  // [E-15] by another path
  Setting s = made_setting(Model::quasi_static);
  std::vector<Reading> readings;
  for (int k = 0; k < 12; ++k) {
    for (const double h : {0.5e-3, 2e-3}) {
      const double e = weighted_force(s.setup, K, 2 * pi / 36 * k, [&](double z) {
        return structure::compliance(made_cutter(), h, z);
      });
      readings.push_back({.travel = 0.2e-3 * k / 12, .height = h, .error = e});
    }
  }
  expect_truth(chosen_fit(fitted(s, readings)), 1e-5);
}

TEST(FitModels, RunoutDoesNotMatterToMeans) {  // [E-15] [E-11]
  const MadeCut cut = with_runout(made_cut(), 8e-6, 1.0);
  Setting s = made_setting(Model::imprint, cut);
  expect_truth(chosen_fit(fitted(s, imprints(s, K))), 1e-6);
  s.model = Model::quasi_static;
  expect_truth(chosen_fit(fitted(s, pulses(s, K, {.heights = {1e-3}}))), 1e-5);
}

TEST(FitModels, AWallIsTakenAtEachPlace) {  // [E-15]
  const Setting s = made_setting(Model::imprint, made_cut(), with_wall());
  const Measured at{.heights = made_heights(5), .places = {10e-3, 20e-3, 30e-3}};
  const ModelFits c = fitted(s, imprints(s, K, at));
  EXPECT_EQ(c.nominal.size(), 15U);
  expect_truth(chosen_fit(c), 1e-6);
}

TEST(FitModels, ManyPlacesAreInterpolated) {  // [E-15]
  const Setting s = made_setting(Model::imprint, made_cut(), with_wall());
  Measured at{.heights = made_heights(3), .places = {}};
  for (int i = 0; i < 12; ++i) at.places.push_back(20e-3 + 1e-3 * i);
  const ModelFits c = fitted(s, imprints(s, K, at));
  EXPECT_LT(c.stations->count(), 10U);
  expect_truth(chosen_fit(c), 2e-3);
}

TEST(FitModels, AnOffsetAndTiltsAreFoundWithIt) {  // [E-15]
  const Setting s = made_setting(Model::imprint, made_cut(), with_wall());
  auto readings =
      imprints(s, K, {.heights = made_heights(5), .places = {10e-3, 20e-3, 30e-3}});
  for (Reading& r : readings) r.error += 4e-6 + 1e-3 * r.height - 2e-4 * (r.x - 20e-3);
  const CoefficientFit a =
      chosen_fit(fitted(s, readings, {.offset = true, .tilt = true}));
  expect_truth(a, 1e-5);
  ASSERT_EQ(a.datum.size(), 3U);
  EXPECT_NEAR(a.datum[0].value, 4e-6 + 1e-3 * 1.5e-3, 1e-10);  // about the middle
  EXPECT_NEAR(a.datum[1].value, -2e-4, 1e-7);
  EXPECT_NEAR(a.datum[2].value, 1e-3, 1e-7);
  const CoefficientFit b = chosen_fit(fitted(s, readings));
  EXPECT_GT(std::abs(b.K_rc.value / K[1] - 1), 0.01);
}

TEST(FitModels, EachMeasurementHasItsOwnOffset) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  auto readings = imprints(s, K);
  auto again = readings;
  for (Reading& r : readings) r.error += 3e-6;
  for (Reading& r : again) {
    r.error -= 5e-6;
    r.set = 1;
  }
  readings.insert(readings.end(), again.begin(), again.end());
  const std::array datum = {Datum{.offset = true}, Datum{.offset = true}};
  const CoefficientFit a = chosen_fit(fit_models(s, readings, datum, Feedback::none));
  expect_truth(a, 1e-5);
  ASSERT_EQ(a.datum.size(), 2U);
  EXPECT_NEAR(a.datum[0].value, 3e-6, 1e-10);
  EXPECT_NEAR(a.datum[1].value, -5e-6, 1e-10);
}

TEST(FitModels, EdgeCoefficientsAreKeptAsGiven) {  // [E-15]
  const Coefficients edged = {800e6, 300e6, 5e3, 3e3};
  Setting s = made_setting(Model::imprint);
  const auto readings = imprints(s, edged);
  s.law = law(0, 0, 5e3, 3e3);
  expect_truth(chosen_fit(fitted(s, readings)), 1e-5);
  s.law = law(0, 0);
  EXPECT_GT(std::abs(chosen_fit(fitted(s, readings)).K_tc.value / K[0] - 1), 0.01);
}

TEST(FitModels, MeansOfMoreReadingsWeighMore) {  // [E-15]
  // an error of one reading in two is half as bad as of the only one
  const Setting s = made_setting(Model::imprint, made_cut(true, 1));
  const auto clean = imprints(s, K, {.heights = made_heights(6)});
  auto doubled = clean;
  doubled.push_back(clean[2]);
  doubled.back().error += 2e-6;  // the mean moves by 1 um
  auto single = clean;
  single[2].error += 1e-6;
  const CoefficientFit a = chosen_fit(fitted(s, doubled));
  const CoefficientFit b = chosen_fit(fitted(s, single));
  EXPECT_GT(std::abs(a.residual[2]), 0.0);
  EXPECT_LT(std::abs(a.residual[2]), std::abs(b.residual[2]));
}

TEST(FitModels, StandardErrorsAreThoseComputedApart) {  // [E-15] per um of noise
  const auto se_at = [](Setting s, Datum datum, int heights) {
    auto readings = imprints(s, K, {.heights = made_heights(heights)});
    for (int i = 0; i < heights; ++i) {  // any residuals; se goes with their size
      for (std::size_t k = 0; k < 3; ++k) {
        readings[3 * static_cast<std::size_t>(i) + k].error +=
            1e-6 * std::sin(1.0 + 7.0 * i * i);
      }
    }
    const CoefficientFit a = chosen_fit(fitted(s, readings, datum));
    // the readings of a mean do not scatter: se of the means per um of the means
    const double per_um = 1e-6 / a.noise * std::sqrt(3.0);
    return std::array{a.K_tc.se * per_um / 1e6, a.K_rc.se * per_um / 1e6,
                      a.correlation};
  };
  // heights of the table: 0.25 to 2.75 in steps of 0.25
  const auto plain = se_at(made_setting(Model::imprint), {}, 11);
  EXPECT_NEAR(plain[0], 104.0, 2.0);
  EXPECT_NEAR(plain[1], 28.0, 0.7);
  EXPECT_LT(plain[2], -0.97);
  const auto shifted = se_at(made_setting(Model::imprint), {.offset = true}, 11);
  EXPECT_NEAR(shifted[0], 143.0, 3.0);
  EXPECT_NEAR(shifted[1], 45.0, 1.0);
  const auto wall =
      se_at(made_setting(Model::imprint, made_cut(), with_wall()), {}, 11);
  EXPECT_NEAR(wall[0], 43.0, 1.0);
  EXPECT_NEAR(wall[1], 12.0, 0.5);
}

/// Mean envelope at a height by nothing but the definitions, without runout: one path
/// after the other, a tooth feed apart.
double mean_by_hand(const MadeCut& s, Coefficients with, double h) {
  const double R = s.cutter.profile.D / 2;
  const double sigma = side_of(s.cut.engagement)->sigma;
  const double theta_s = side_of(s.cut.engagement)->theta;
  const double lag = h * std::tan(s.cutter.helix) / R;
  const double feed = s.cutter.teeth() * s.cut.f_z;
  constexpr int samples = 700;
  std::vector<std::array<double, 2>> path;
  for (int i = 0; i <= samples; ++i) {
    const double theta = theta_s + 0.3 * (2.0 * i / samples - 1);
    const double phi = theta + lag;
    const double delta = sigma * weighted_force(s, with, phi, [&](double z) {
                           return structure::compliance(made_cutter(), h, z);
                         });
    path.push_back({feed * phi / (2 * pi) + R * std::sin(theta),
                    R + sigma * R * std::cos(theta) + delta});
  }
  if (path.front()[0] > path.back()[0]) std::reverse(path.begin(), path.end());
  double mean = 0.0;
  constexpr int points = 100;
  for (int k = 0; k < points; ++k) {
    double lowest = 1.0;
    for (int pass = -6; pass <= 6; ++pass) {
      const double x = s.cut.f_z * (pass + (k + 0.5) / points);
      const auto above =
          std::upper_bound(path.begin(), path.end(), x,
                           [](double at, const auto& p) { return at < p[0]; });
      if (above == path.begin() || above == path.end()) continue;
      const auto below = above - 1;
      const double t = (x - (*below)[0]) / ((*above)[0] - (*below)[0]);
      lowest = std::min(lowest, (1 - t) * (*below)[1] + t * (*above)[1]);
    }
    mean += lowest / points;
  }
  return mean;
}

TEST(FitModels, RealProfilesGiveTheirCoefficientsBack) {  // [E-16] by another path
  for (const bool down : {true, false}) {
    const MadeCut cut = made_cut(down);
    std::vector<Reading> readings;
    for (const double h : made_heights(7)) {
      readings.push_back({.height = h, .error = mean_by_hand(cut, K, h)});
    }
    const ModelFits c = fitted(made_setting(Model::envelope, cut), readings);
    EXPECT_EQ(chosen_fit(c).model, Model::envelope);
    expect_truth(chosen_fit(c), 2e-3);
    EXPECT_LT(chosen_fit(c).rms, 10e-9);
    // read as imprints they do not fit: spring-back
    EXPECT_EQ(c.fits[0].model, Model::imprint);
    if (down) {
      EXPECT_NEAR(c.fits[0].K_tc.value, 570e6, 30e6);
    }
  }
}

TEST(FitModels, TheEnvelopeIsReadRight) {  // [E-16] imprint 563/305, truth 800/300
  const Setting s = made_setting(Model::envelope);
  const auto readings = profiles(s, K, {.heights = made_heights(11), .per_tooth = 40});
  const ModelFits c = fitted(s, readings);
  ASSERT_EQ(c.fits.size(), 3U);
  EXPECT_NEAR(c.fits[0].K_tc.value, 562.88e6, 2e6);
  EXPECT_NEAR(c.fits[0].K_rc.value, 305.19e6, 1e6);
  expect_truth(chosen_fit(c), 2e-3);
  EXPECT_EQ(c.fits[2].feedback, Feedback::entry);
}

TEST(FitModels, AProbeIsAllowedFor) {  // [E-13] [E-16]
  Setting s = made_setting(Model::envelope);
  s.probe_radius = 0.5e-3;
  std::vector<Nominal> rows;
  for (const double h : made_heights(7)) {
    rows.push_back({.height = h, .readings = {0}});
  }
  const auto read = NominalModel(s, rows).rigid(K);
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    readings.push_back({.height = rows[i].height, .error = read.error[i]});
  }
  expect_truth(chosen_fit(fitted(s, readings)), 1e-4);
  Setting blunt = s;
  blunt.probe_radius = 0.0;
  const CoefficientFit wrong = chosen_fit(fitted(blunt, readings));
  EXPECT_GT(std::abs(wrong.K_tc.value / K[0] - 1), 1e-3);
}

TEST(FitModels, FeedbackIsFittedAlong) {  // [E-10] [E-15]
  const Setting s = made_setting(Model::quasi_static, made_cut(), with_wall());
  const Coefficients soft = {400e6, 200e6, 0.0, 0.0};
  const auto rows = nominal_errors(pulses(s, soft, {.heights = {0.5e-3}}), s.model,
                                   s.setup.cut.f_z, 3);
  const auto bent = NominalModel(s, rows).with_feedback(soft, Feedback::entry);
  ASSERT_TRUE(bent.good);
  std::vector<Reading> readings;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    readings.push_back({.x = rows[i].x,
                        .travel = rows[i].travel,
                        .height = rows[i].height,
                        .error = bent.error[i]});
  }
  const ModelFits c = fitted(s, readings, {}, Feedback::entry);
  EXPECT_EQ(chosen_fit(c).feedback, Feedback::entry);
  expect_truth(chosen_fit(c), 1e-2, soft);
  EXPECT_LT(c.fits[0].K_tc.value, 0.6 * soft[0]);  // without feedback: 123 of 400
}

TEST(FitModels, AnswersStandSideBySide) {
  const auto kinds = [](Model model, Feedback feedback) {
    const Setting s = made_setting(model);
    const Measured at{.heights = made_heights(5)};
    const auto readings = model == Model::quasi_static ? pulses(s, K, at)
                          : model == Model::imprint    ? imprints(s, K, at)
                                                       : profiles(s, K, at);
    return fitted(s, readings, {}, feedback);
  };
  const ModelFits a = kinds(Model::quasi_static, Feedback::none);
  ASSERT_EQ(a.fits.size(), 2U);
  EXPECT_EQ(a.chosen, 0U);
  const ModelFits b = kinds(Model::imprint, Feedback::none);
  ASSERT_EQ(b.fits.size(), 3U);
  EXPECT_EQ(b.chosen, 0U);
  EXPECT_EQ(b.fits[1].model, Model::envelope);
  const ModelFits c = kinds(Model::envelope, Feedback::entry);
  ASSERT_EQ(c.fits.size(), 3U);
  EXPECT_EQ(c.chosen, 2U);
}

TEST(FitModels, AdviceNamesTheHeightThatHelpsMost) {  // [E-15]
  const Setting s = made_setting(Model::imprint);
  auto readings = imprints(s, K, {.heights = {1.4e-3, 1.5e-3, 1.6e-3, 1.7e-3}});
  add_noise(readings, 1e-6, 1);
  const ModelFits c = fitted(s, readings);
  ASSERT_EQ(c.advice.size(), 19U);
  for (std::size_t i = 1; i < c.advice.size(); ++i) {
    EXPECT_LE(c.advice[i - 1].se_K_tc, c.advice[i].se_K_tc);
  }
  EXPECT_LT(c.advice[0].se_K_tc, chosen_fit(c).K_tc.se);
  // what it promises: ten more readings there, the noise as it is
  const double best = c.advice[0].height;
  EXPECT_GT(std::abs(best - 1.55e-3), 0.5e-3);
}

}  // namespace trochoid::surface::fit_models_test
