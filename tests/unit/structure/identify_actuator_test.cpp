#include <gtest/gtest.h>
#include <trochoid/structure/identify_actuator.h>

#include <cmath>
#include <random>
#include <string>

namespace trochoid::structure::identify_actuator_test {

constexpr double step = 6e-6;

StepRecord made(const ActuatorDynamics& truth, double noise, unsigned seed = 5,
                double end = 0.02) {
  StepRecord record{.step = step};
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  for (int i = 0; i * 2e-5 <= end; ++i) {
    record.time.push_back(i * 2e-5);
    record.position.push_back(1e-6 + step * step_response(truth, i * 2e-5 - 0.001) +
                              noise * normal(random));
  }
  return record;
}

TEST(IdentifyActuator, FindsGainAndDynamicsOnBothSidesOfTheCriticalDamping) {  // [M-13]
  for (const double zeta : {0.2, 0.7, 1.0, 1.8}) {
    const auto truth = from_frequency(0.97, 200.0, zeta);
    for (const bool known : {true, false}) {
      StepRecord record = made(truth, 0.0);
      if (known) record.start = 0.001;
      const auto fit = identify_actuator(record);
      ASSERT_TRUE(fit.ok) << zeta << ": " << fit.reason;
      EXPECT_NEAR(fit.dynamics.gain, 0.97, 1e-7) << zeta;
      EXPECT_NEAR(fit.dynamics.sum / truth.sum, 1.0, 1e-5) << zeta;
      EXPECT_NEAR(fit.dynamics.product / truth.product, 1.0, 1e-5) << zeta;
      EXPECT_NEAR(fit.start, 0.001, 1e-8) << zeta;
      EXPECT_NEAR(fit.rest, 1e-6, 1e-12);
    }
  }
}

TEST(IdentifyActuator, TimeConstantsOnlyWithMargin) {  // [M-14]
  const auto apart =
      identify_actuator(made(from_time_constants(1, 0.002, 0.0004), 2e-8));
  ASSERT_TRUE(apart.ok) << apart.reason;
  ASSERT_TRUE(apart.time_constants) << apart.time_constants_reason;
  EXPECT_NEAR((*apart.time_constants)[0], 0.002, 4 * apart.time_constants_se[0]);
  EXPECT_NEAR((*apart.time_constants)[1], 0.0004, 4 * apart.time_constants_se[1]);
  const auto near =
      identify_actuator(made(from_time_constants(1, 0.00113, 0.00114), 2e-8));
  ASSERT_TRUE(near.ok) << near.reason;
  EXPECT_FALSE(near.time_constants);
  EXPECT_NE(near.time_constants_reason.find("too near to 1"), std::string::npos);
  const auto under = identify_actuator(made(from_frequency(1, 200, 0.5), 2e-8));
  ASSERT_TRUE(under.ok) << under.reason;
  EXPECT_NE(under.time_constants_reason.find("underdamped"), std::string::npos);
}

TEST(IdentifyActuator, StandardErrorsAreTheScatterOfManyFits) {
  const auto truth = from_frequency(1.0, 150.0, 0.8);
  constexpr int runs = 100;
  double gain = 0.0;
  double sum = 0.0;
  double zeta = 0.0;
  double start = 0.0;
  ActuatorFit last;
  for (unsigned i = 0; i < runs; ++i) {
    last = identify_actuator(made(truth, 5e-8, 100 + i));
    ASSERT_TRUE(last.ok) << last.reason;
    gain += std::pow(last.dynamics.gain - 1.0, 2) / runs;
    sum += std::pow(last.dynamics.sum - truth.sum, 2) / runs;
    zeta += std::pow(damping_ratio(last.dynamics) - 0.8, 2) / runs;
    start += std::pow(last.start - 0.001, 2) / runs;
  }
  // 100 runs tell a standard deviation to 7 %: three of that
  EXPECT_NEAR(last.gain_se / std::sqrt(gain), 1.0, 0.22);
  EXPECT_NEAR(last.sum_se / std::sqrt(sum), 1.0, 0.22);
  EXPECT_NEAR(last.damping_ratio_se / std::sqrt(zeta), 1.0, 0.22);
  EXPECT_NEAR(last.start_se / std::sqrt(start), 1.0, 0.22);
}

TEST(IdentifyActuator, RefusesAStepThatNeverSettles) {
  const auto refused = [](const StepRecord& record, const std::string& words) {
    const auto fit = identify_actuator(record);
    EXPECT_FALSE(fit.ok);
    EXPECT_NE(fit.reason.find(words), std::string::npos) << fit.reason;
  };
  refused(made(from_frequency(1, 200, 0.002), 1e-8), "settle");
  refused(made(from_frequency(1, 200, 1.0), 1e-8, 5, 0.0025), "settle");
  StepRecord drifting = made(from_frequency(1, 200, 1.0), 1e-8);
  for (std::size_t i = 0; i < drifting.time.size(); ++i) {
    drifting.position[i] += 6e-4 * drifting.time[i];
  }
  refused(drifting, "settle");
  StepRecord nothing = made(from_frequency(1e-9, 200, 1.0), 1e-8);
  refused(nothing, "no step");
}

TEST(IdentifyActuator, AReversedActuatorHasANegativeGain) {
  const auto fit = identify_actuator(made(from_frequency(-0.5, 200, 0.7), 1e-9));
  ASSERT_TRUE(fit.ok) << fit.reason;
  EXPECT_NEAR(fit.dynamics.gain, -0.5, 1e-3);
}

}  // namespace trochoid::structure::identify_actuator_test
