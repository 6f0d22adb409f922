#include <trochoid/correction/online.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace trochoid {

namespace {

using Random = std::mt19937_64;

double between(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

double any_bits(Random& random) {
  const std::uint64_t bits = random();
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

double nasty(Random& random) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double values[] = {
      nan, inf, -inf, 0.0, -0.0, 1e-320, 1e9, -1e300, 1e300, -0.5, any_bits(random)};
  return values[random() % std::size(values)];
}

TrochoidOnlineConfig any_config(Random& random) {
  TrochoidOnlineConfig c;
  trochoid_online_defaults(&c);
  c.measure = static_cast<std::int32_t>(random() % 2);
  c.wait_turns = static_cast<std::int32_t>(random() % 3);
  c.window_start_rev = between(random, -1.0, 1.0);
  c.window_rev = between(random, 0.2, 0.5);
  c.gain_low = between(random, -2.0, 0.0);
  c.gain_high = between(random, 0.0, 5.0);
  c.gain = between(random, c.gain_low, c.gain_high);
  c.gain_step = between(random, 0.01, 5.0);
  c.rate = between(random, 0.1, 1.5);
  c.difference_m = between(random, -40e-6, 40e-6);
  c.exponent = between(random, 0.0, 0.95);
  return c;
}

TEST(PropertyOnline, WhateverTheSamplesGainAndStepStayWithinTheirLimits) {  // [L-6]
  Random random(1);
  int learnt = 0;
  for (int round = 0; round < 300; ++round) {
    const auto config = any_config(random);
    TrochoidOnline online;
    ASSERT_EQ(trochoid_online_init(&online, &config), TROCHOID_ONLINE_ACCEPTED);
    const auto hostility = 1 + static_cast<std::uint64_t>(between(random, 1.0, 5000.0));
    double angle = 0.0;
    double gain = config.gain;
    for (int i = 0; i < 5000; ++i) {
      angle += 0.01;
      double given = angle;
      double force = between(random, 0.0, 100.0) * (angle - std::floor(angle));
      if (random() % hostility == 0) {
        (random() % 2 == 0 ? given : force) = nasty(random);
      }
      const auto result =
          trochoid_online_sample(&online, given, force, random() % 5000 != 0);
      ASSERT_GE(result.gain, config.gain_low);
      ASSERT_LE(result.gain, config.gain_high);
      ASSERT_LE(std::fabs(result.gain - gain), config.gain_step * (1 + 1e-12));
      ASSERT_TRUE(result.difference >= 0.0 && result.difference <= 1.0);
      ASSERT_LE(std::fabs(result.residual_m), config.feed_per_tooth_m);
      gain = result.gain;
    }
    learnt += online.result.learnt;
  }
  EXPECT_GT(learnt, 500);
}

TEST(PropertyOnline, SamplesOfAnyBits) {
  Random random(2);
  for (int round = 0; round < 100; ++round) {
    const auto config = any_config(random);
    TrochoidOnline online;
    trochoid_online_init(&online, &config);
    for (int i = 0; i < 2000; ++i) {
      const auto result =
          trochoid_online_sample(&online, any_bits(random), any_bits(random),
                                 static_cast<std::int32_t>(random()));
      ASSERT_TRUE(result.gain >= config.gain_low && result.gain <= config.gain_high);
      ASSERT_TRUE(std::isfinite(result.difference));
      ASSERT_TRUE(std::isfinite(result.force_N[0] + result.force_N[1]));
    }
  }
}

TEST(PropertyOnline, AConfigurationOfAnyBitsIsRefusedOrSafe) {
  using Config = TrochoidOnlineConfig;
  constexpr double Config::*numbers[] = {&Config::window_start_rev,
                                         &Config::window_rev,
                                         &Config::gain,
                                         &Config::gain_low,
                                         &Config::gain_high,
                                         &Config::gain_step,
                                         &Config::rate,
                                         &Config::feed_per_tooth_m,
                                         &Config::difference_m,
                                         &Config::exponent,
                                         &Config::least_force_N,
                                         &Config::deadband};
  Random random(3);
  int accepted = 0;
  for (int round = 0; round < 2000; ++round) {
    auto config = any_config(random);
    config.*numbers[random() % std::size(numbers)] = nasty(random);
    TrochoidOnline online;
    if (trochoid_online_init(&online, &config) != TROCHOID_ONLINE_ACCEPTED) {
      continue;
    }
    ++accepted;
    for (int i = 0; i < 300; ++i) {
      const auto result = trochoid_online_sample(&online, 0.01 * i, i % 100, 1);
      ASSERT_TRUE(result.gain >= config.gain_low && result.gain <= config.gain_high);
    }
  }
  EXPECT_GT(accepted, 50);
  EXPECT_LT(accepted, 1500);
}

}  // namespace

}  // namespace trochoid
