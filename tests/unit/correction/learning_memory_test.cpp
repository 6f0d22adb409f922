// Memory of what learns that something else wrote into.
#include <trochoid/correction/estimator.h>
#include <trochoid/correction/online.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace trochoid::learning_memory_test {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

#ifdef __SANITIZE_ADDRESS__
constexpr std::size_t stride = 13;
#else
constexpr std::size_t stride = 1;
#endif

TrochoidEstimatorConfig estimator_config() {
  TrochoidEstimatorConfig c;
  trochoid_estimator_defaults(&c);
  c.least_samples = 2;
  c.settled_turns = 1;
  for (int j = 0; j < c.teeth; ++j) {
    for (int k = 0; k < 2 * c.harmonics; ++k) {
      c.wave_model[j][k] = 2e4 * std::cos(1.3 * (j + 1) * (k + 1));
    }
    for (int i = 0; i < c.teeth; ++i) c.runout_model[j][i] = i == j ? 3e4 : -1e4;
  }
  return c;
}

/// Some turns of four flutes that differ; `check` sees every result.
template <class Result, class Sample, class Check>
void some_turns(const Sample& sample, const Check& check) {
  for (int i = 0; i < 120; ++i) {
    const double angle = 0.03 * i;
    const int flute = static_cast<int>(4.0 * (angle - std::floor(angle)));
    const Result result = sample(angle, 100.0 + 10.0 * flute);
    check(result);
  }
}

TrochoidEstimator learnt_estimator() {
  TrochoidEstimator whole;
  const auto config = estimator_config();
  EXPECT_EQ(trochoid_estimator_init(&whole, &config), TROCHOID_ESTIMATOR_ACCEPTED);
  some_turns<TrochoidEstimatorResult>(
      [&](double a, double f) { return trochoid_estimator_sample(&whole, a, f, 1); },
      [](const auto&) {});
  EXPECT_GT(whole.result.learnt, 0);
  return whole;
}

TrochoidOnline learnt_gain() {
  TrochoidOnlineConfig config;
  trochoid_online_defaults(&config);
  config.least_samples = 2;
  TrochoidOnline whole;
  EXPECT_EQ(trochoid_online_init(&whole, &config), TROCHOID_ONLINE_ACCEPTED);
  some_turns<TrochoidOnlineResult>(
      [&](double a, double f) { return trochoid_online_sample(&whole, a, f, 1); },
      [](const auto&) {});
  EXPECT_GT(whole.result.learnt, 0);
  return whole;
}

bool finite_waves(const TrochoidEstimatorResult& result) {
  for (int n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
    if (!std::isfinite(result.cosine_m[n]) || !std::isfinite(result.sine_m[n])) {
      return false;
    }
  }
  return true;
}

}  // namespace

TEST(LearningMemory, NoNumberOfTheEstimatorThatIsNoneBecomesAWave) {
  const TrochoidEstimator whole = learnt_estimator();
  for (std::size_t i = 0; i < sizeof whole / sizeof(double); i += stride) {
    for (const double value : {nan, -std::numeric_limits<double>::infinity(), 1e300}) {
      TrochoidEstimator spoilt = whole;
      std::memcpy(reinterpret_cast<char*>(&spoilt) + i * sizeof value, &value,
                  sizeof value);
      some_turns<TrochoidEstimatorResult>(
          [&](double a, double f) {
            return trochoid_estimator_sample(&spoilt, a, f, 1);
          },
          [&](const auto& r) { ASSERT_TRUE(finite_waves(r)) << i << " " << value; });
    }
  }
}

TEST(LearningMemory, NumbersOfTeethBeyondTheArraysLeaveItNotReady) {
  for (const int teeth : {-1, 0, 9, 1 << 30}) {
    for (const bool of_teeth : {true, false}) {
      TrochoidEstimator spoilt = learnt_estimator();
      (of_teeth ? spoilt.config.teeth : spoilt.config.harmonics) = teeth;
      const auto result = trochoid_estimator_sample(&spoilt, 0.5, 100.0, 1);
      EXPECT_EQ(result.turn, TROCHOID_TURN_NOT_READY);
      EXPECT_EQ(result.cosine_m[0], 0.0);
      EXPECT_EQ(spoilt.result.cosine_m[0], 0.0) << "for who reads the memory";
      EXPECT_EQ(trochoid_estimator_sample(&spoilt, 0.52, 100.0, 1).turn,
                TROCHOID_TURN_NOT_READY);
    }
  }
}

TEST(LearningMemory, NoNumberOfTheGainThatIsNoneIsGiven) {
  const TrochoidOnline whole = learnt_gain();
  for (std::size_t i = 0; i < sizeof whole / sizeof(double); ++i) {
    for (const double value : {nan, -std::numeric_limits<double>::infinity(), 1e300}) {
      TrochoidOnline spoilt = whole;
      std::memcpy(reinterpret_cast<char*>(&spoilt) + i * sizeof value, &value,
                  sizeof value);
      some_turns<TrochoidOnlineResult>(
          [&](double a, double f) { return trochoid_online_sample(&spoilt, a, f, 1); },
          [&](const auto& r) {
            ASSERT_TRUE(r.gain >= 0.0 && r.gain <= 1.0) << i << " " << value;
            ASSERT_TRUE(std::isfinite(r.residual_m)) << i << " " << value;
          });
    }
  }
}

/// A spindle that stands still in a window for half an hour of milliseconds.
TEST(LearningMemory, MeanIsOfTheSamplesThatAreCounted) {
  TrochoidOnlineConfig config;
  trochoid_online_defaults(&config);
  config.measure = TROCHOID_MEASURE_MEAN;
  TrochoidOnline online;
  ASSERT_EQ(trochoid_online_init(&online, &config), TROCHOID_ONLINE_ACCEPTED);
  const auto turn_to = [&](double from, double to) {
    TrochoidOnlineResult last{};
    for (double angle = from; angle < to; angle += 0.03) {
      last = trochoid_online_sample(&online, angle, 100.0, 1);
    }
    return last;
  };
  turn_to(0.9, 1.2);
  for (int i = 0; i < 2'000'000; ++i) {
    trochoid_online_sample(&online, 1.2, 100.0, 1);
  }
  const auto result = turn_to(1.2, 2.1);
  EXPECT_NEAR(result.force_N[0], 100.0, 1e-6);  // the sum rounds
  EXPECT_NEAR(result.force_N[1], 100.0, 1e-6);
}

}  // namespace trochoid::learning_memory_test
