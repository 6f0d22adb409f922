// What a plan of a wall promises is what measuring one then finds.
#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/plan_wall.h>
#include <trochoid/surface/tooth_model.h>

#include "../unit/surface/made_readings.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trochoid::surface {
namespace {

constexpr int seeds = 100;
/// The scatter of 100 values is known to 7 %; about three times that.
constexpr double sampling_error = 0.2;

struct Scatter {
  double sum = 0.0;
  double squares = 0.0;

  void add(double value) {
    sum += value;
    squares += value * value;
  }
  [[nodiscard]] double value() const {
    return std::sqrt((squares - sum * sum / seeds) / (seeds - 1));
  }
};

/// A wall that is about to be measured.
WallTrial trial_of(Model model) {
  WallTrial trial{
      .setting = made_setting(model, with_runout(made_cut(), 4e-6, 71 * unit::deg))};
  trial.setting.law = law(800e6, 300e6);
  trial.noise = 0.5e-6;  // small enough for a wall that is linear about the truth
  return trial;
}

/// The readings of a design as the wall would give them, but for the noise.
std::vector<Reading> made(const WallTrial& trial, const PlannedReadings& planned) {
  std::vector<Reading> readings = planned.readings;
  const ToothModel model(trial.setting, readings);
  const geometry::Runout& r = trial.setting.setup.runout;
  const RunoutVector runout{r.eccentricity * std::cos(r.angle),
                            r.eccentricity * std::sin(r.angle)};
  const auto e = model.predict(
      model.forces(runout), wall_coefficients(trial.setting.law), runout, trial.start);
  for (std::size_t i = 0; i < e.size(); ++i) readings[i].error = e[i];
  return readings;
}

void expect_promised(const WallTrial& trial, const WallDesign& design) {
  const WallCatalogue catalogue(trial, heights_of(design, trial.setting.setup.cut.a_p),
                                30e-3);
  const PlannedReadings planned = catalogue.readings_of(design);
  const WallPrediction told = catalogue.predict(planned);
  ASSERT_TRUE(told.told);
  const std::vector<Reading> exact = made(trial, planned);
  Scatter K_tc;
  Scatter K_rc;
  Scatter rho;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    std::vector<Reading> readings = exact;
    add_noise(readings, trial.noise, seed);
    const Calibration c =
        calibrate(trial.setting, readings, std::array{Datum{.offset = true}});
    ASSERT_TRUE(c.ok) << c.message;
    ASSERT_TRUE(c.runout.ok) << c.runout.message;
    K_tc.add(c.coefficients.K_tc.value);
    K_rc.add(c.coefficients.K_rc.value);
    rho.add(c.runout.eccentricity.value);
  }
  EXPECT_NEAR(K_tc.value() / told.se_K_tc, 1.0, sampling_error);
  EXPECT_NEAR(K_rc.value() / told.se_K_rc, 1.0, sampling_error);
  EXPECT_NEAR(rho.value() / *told.se_eccentricity, 1.0, sampling_error);
}

TEST(PlanOfAWall, WhatItPromisesOfARealProfileIsWhatMeasuringFinds) {  // [E-60] [E-61]
  expect_promised(trial_of(Model::envelope),
                  {.heights = 5, .per_height = 12, .spread = 0.8});
}

TEST(PlanOfAWall, WhatItPromisesOfImprintsIsWhatMeasuringFinds) {
  expect_promised(trial_of(Model::imprint),
                  {.heights = 7, .per_height = 12, .spread = 0.8});
}

}  // namespace
}  // namespace trochoid::surface
