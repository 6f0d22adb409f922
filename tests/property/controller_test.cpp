#include <trochoid/correction/controller.h>

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

/// Over decades.
double scaled(Random& random, double low, double high) {
  return std::exp(between(random, std::log(low), std::log(high)));
}

int one_in(Random& random, int count) {
  return std::uniform_int_distribution<int>(1, count)(random) == 1 ? 1 : 0;
}

/// Any 64 bits: infinities, NaN with payload, denormals, all exponents.
double any_bits(Random& random) {
  const std::uint64_t bits = random();
  double value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

double nasty(Random& random) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double values[] = {nan, inf,     -inf,   0.0,   -0.0,
                           1.0, -1.0,    1e-300, 1e300, 5e-324,
                           1e9, 1e9 + 1, -1e9,   0.5,   any_bits(random)};
  return values[random() % std::size(values)];
}

TrochoidControllerConfig any_config(Random& random) {
  TrochoidControllerConfig c;
  trochoid_controller_defaults(&c);
  c.points = std::uniform_int_distribution<int>(2, TROCHOID_TABLE_POINTS)(random);
  c.lower_m = between(random, -100e-6, 100e-6);
  c.upper_m = c.lower_m + scaled(random, 1e-8, 1e-3);
  c.start_m = between(random, c.lower_m, c.upper_m);
  const double half = 0.499 * (c.upper_m - c.lower_m) * between(random, 0.0, 1.0);
  const bool square = one_in(random, 3) != 0;
  for (int i = 0; i < c.points; ++i) {
    c.table_m[i] =
        square ? (i < c.points / 2 ? half : -half) : between(random, -half, half);
  }
  c.phase_rev = between(random, -10.0, 10.0);
  c.lead_s = one_in(random, 3) != 0 ? 0.0 : scaled(random, 1e-5, 0.1);
  c.period_s = scaled(random, 1e-6, 0.1);
  c.max_step_s = std::fmin(1.0, c.period_s * between(random, 1.0, 10.0));
  c.slew_m_per_s = scaled(random, 1e-7, 10.0);
  c.fade_s = scaled(random, 1e-3, 1.0);
  c.ramp_s = scaled(random, 1e-3, 1.0);
  c.gain_time_s = scaled(random, 1e-3, 1.0);
  c.filter_rev = between(random, 0.25, 2.0);
  c.min_speed_rps = scaled(random, 1e-3, 10.0);
  c.max_speed_rps = c.min_speed_rps * scaled(random, 1.5, 1e4);
  c.speed_change = between(random, 0.01, 1.0);
  c.index_turns = between(random, 1.3, 5.0);
  c.position_tol_rev = between(random, 0.01, 0.25);
  c.wrap_rev = one_in(random, 3) != 0 ? scaled(random, 2.0, 1e9) : 0.0;
  c.recovery = one_in(random, 2);
  c.good_turns = std::uniform_int_distribution<int>(1, 3)(random);
  return c;
}

using Config = TrochoidControllerConfig;
constexpr double Config::*numbers[] = {
    &Config::phase_rev,     &Config::lead_s,          &Config::period_s,
    &Config::max_step_s,    &Config::lower_m,         &Config::upper_m,
    &Config::start_m,       &Config::slew_m_per_s,    &Config::fade_s,
    &Config::ramp_s,        &Config::gain_time_s,     &Config::filter_rev,
    &Config::min_speed_rps, &Config::max_speed_rps,   &Config::speed_change,
    &Config::index_turns,   &Config::position_tol_rev};

/// A spindle that mostly turns well.
struct Spindle {
  double speed;
  double turns = 0.0;

  TrochoidControllerInput next(const TrochoidControllerConfig& c) {
    const double before = turns;
    turns += speed * c.period_s;
    TrochoidControllerInput in{};
    in.position_rev = turns;
    in.index_position_rev = std::floor(turns);
    in.index = std::floor(turns) != std::floor(before) ? 1 : 0;
    in.speed_rps = speed;
    in.gain = 1.0;
    for (int n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {  // together beyond the window
      in.cosine_m[n] = 0.3 * (c.upper_m - c.lower_m) * std::cos(n + 0.1 * turns);
      in.sine_m[n] = 0.3 * (c.upper_m - c.lower_m) * std::sin(3 * n + 0.2 * turns);
    }
    in.dt_s = c.period_s;
    in.enable = 1;
    return in;
  }
};

void spoil(TrochoidControllerInput& in, Random& random) {
  switch (random() % 10) {
    case 0:
      in.position_rev = nasty(random);
      break;
    case 1:
      in.speed_rps = nasty(random);
      break;
    case 2:
      in.dt_s = nasty(random);
      break;
    case 3:
      in.dt_s = scaled(random, 1e-12, 10.0);
      break;
    case 4:
      in.gain = one_in(random, 2) != 0 ? nasty(random) : scaled(random, 0.1, 1e3);
      break;
    case 5:
      in.index = 1;
      in.index_position_rev = nasty(random);
      break;
    case 6:
      in.position_rev += between(random, -2.0, 2.0);
      break;
    case 7:
      in.enable = 0;
      break;
    case 8:
      in.cosine_m[random() % TROCHOID_WAVE_HARMONICS] = nasty(random);
      break;
    default:
      in.inhibit = one_in(random, 2);
      in.index = one_in(random, 2);
      break;
  }
}

/// The promise, without tolerance: in the window, slope within the limit for the time
/// that passed, never more of it than max_step_s.
testing::AssertionResult keeps_the_promise(const TrochoidControllerConfig& c,
                                           double before, double dt,
                                           const TrochoidControllerResult& r) {
  const double passed = dt > 0.0 ? std::fmin(dt, c.max_step_s) : 0.0;
  if (!(r.command_m >= c.lower_m && r.command_m <= c.upper_m)) {
    return testing::AssertionFailure() << r.command_m << " leaves the window";
  }
  if (!(std::fabs(r.command_m - before) <= c.slew_m_per_s * passed)) {
    return testing::AssertionFailure()
           << before << " to " << r.command_m << " in " << dt;
  }
  if (!(r.fade >= 0.0 && r.fade <= 1.0 && std::isfinite(r.gain) &&
        std::isfinite(r.speed_rps) && r.angle_rev >= 0.0 && r.angle_rev < 1.0)) {
    return testing::AssertionFailure() << "fade, gain, speed or angle is out of bounds";
  }
  return testing::AssertionSuccess();
}

TEST(PropertyController, WhateverTheInputsWindowAndSlopeAreKept) {  // [L-3]
  Random random(20100501);
  long runs = 0;
  long faults = 0;
  for (int round = 0; round < 400; ++round) {
    const auto config = any_config(random);
    TrochoidController controller;
    ASSERT_EQ(trochoid_controller_init(&controller, &config), TROCHOID_ACCEPTED)
        << round;
    // A turn of 3 to 300 steps.
    Spindle spindle{1.0 / (config.period_s * scaled(random, 3.0, 300.0))};
    const int hostility = 1 + static_cast<int>(scaled(random, 1.0, 3000.0));
    const double gain = one_in(random, 3) != 0 ? 1e3 : 1.0;  // up to the stroke
    double before = config.start_m;
    for (int i = 0; i < 5000; ++i) {
      auto in = spindle.next(config);
      in.gain = gain;
      if (one_in(random, hostility) != 0) {
        spoil(in, random);
      }
      const auto result = trochoid_controller_step(&controller, &in);
      ASSERT_TRUE(keeps_the_promise(config, before, in.dt_s, result))
          << "round " << round << ", step " << i;
      before = result.command_m;
      runs += result.state == TROCHOID_RUNNING ? 1 : 0;
      faults += result.state == TROCHOID_FAULT ? 1 : 0;
    }
  }
  // Otherwise the inputs were so hostile that nothing was tried.
  EXPECT_GT(runs, 10000);
  EXPECT_GT(faults, 10000);
}

TEST(PropertyController, FullStrokeRoundsIntoTheWindow) {  // [L-3]
  Random random(5);
  int full = 0;
  for (int round = 0; round < 300; ++round) {
    TrochoidControllerConfig config;
    trochoid_controller_defaults(&config);
    config.lower_m = between(random, -100e-6, 100e-6);
    config.upper_m = config.lower_m + between(random, 1e-6, 100e-6);
    config.start_m = config.lower_m;
    config.table_m[0] = between(random, 0.01, 0.4) * (config.upper_m - config.lower_m);
    config.table_m[1] = config.table_m[0];
    config.slew_m_per_s = 1.0;
    TrochoidController controller;
    ASSERT_EQ(trochoid_controller_init(&controller, &config), TROCHOID_ACCEPTED);
    Spindle spindle{20.0};
    for (int i = 0; i < 1500; ++i) {
      auto in = spindle.next(config);
      in.gain = i % 100 < 50 ? 1e3 : -1e3;
      const double now = trochoid_controller_step(&controller, &in).command_m;
      ASSERT_LE(now, config.upper_m);
      ASSERT_GE(now, config.lower_m);
      full += now > config.upper_m - 1e-12 ? 1 : 0;
    }
  }
  EXPECT_GT(full, 1000);
}

TEST(PropertyController, InputsOfAnyBits) {  // [L-3]
  Random random(7);
  for (int round = 0; round < 200; ++round) {
    const auto config = any_config(random);
    TrochoidController controller;
    trochoid_controller_init(&controller, &config);
    double before = config.start_m;
    for (int i = 0; i < 1000; ++i) {
      const TrochoidControllerInput in{
          any_bits(random),  any_bits(random), any_bits(random),
          any_bits(random),  any_bits(random), static_cast<std::int32_t>(random()),
          one_in(random, 2), one_in(random, 2)};
      const auto result = trochoid_controller_step(&controller, &in);
      ASSERT_TRUE(keeps_the_promise(config, before, in.dt_s, result));
      before = result.command_m;
    }
  }
}

TEST(PropertyController, AConfigurationOfAnyBitsIsRefusedOrSafe) {
  Random random(3);
  int accepted = 0;
  for (int round = 0; round < 2000; ++round) {
    auto config = any_config(random);
    for (std::size_t spoilt = random() % 3; spoilt > 0; --spoilt) {
      config.*numbers[random() % std::size(numbers)] = nasty(random);
    }
    TrochoidController controller;
    if (trochoid_controller_init(&controller, &config) != TROCHOID_ACCEPTED) {
      continue;
    }
    ++accepted;
    Spindle spindle{0.5 * (config.min_speed_rps + config.max_speed_rps)};
    double before = config.start_m;
    for (int i = 0; i < 300; ++i) {
      const auto in = spindle.next(config);
      const auto result = trochoid_controller_step(&controller, &in);
      ASSERT_TRUE(keeps_the_promise(config, before, in.dt_s, result)) << round;
      before = result.command_m;
    }
  }
  EXPECT_GT(accepted, 300);
  EXPECT_LT(accepted, 1900);
}

TEST(PropertyController, AfterAFaultItRestsAtMidStrokeInTime) {
  Random random(11);
  int tried = 0;
  for (int round = 0; round < 300; ++round) {
    auto config = any_config(random);
    config.recovery = TROCHOID_RECOVER_BY_ENABLE;
    TrochoidController controller;
    trochoid_controller_init(&controller, &config);
    Spindle spindle{std::fmin(1.0 / (config.period_s * 50.0), config.max_speed_rps)};
    TrochoidControllerResult result{};
    for (int i = 0; i < 20000 && result.state != TROCHOID_RUNNING; ++i) {
      const auto in = spindle.next(config);
      result = trochoid_controller_step(&controller, &in);
    }
    if (result.state != TROCHOID_RUNNING) {
      continue;  // too slow for this configuration
    }
    ++tried;
    const double half = 0.5 * (config.upper_m - config.lower_m);
    const double most = std::fmax(config.ramp_s, half / config.slew_m_per_s);
    const int steps = static_cast<int>(most / config.period_s) + 3;
    for (int i = 0; i < steps; ++i) {
      auto in = spindle.next(config);
      in.inhibit = i == 0 ? 1 : 0;
      if (i > 0) {
        in.position_rev = nasty(random);
        in.speed_rps = nasty(random);
      }
      result = trochoid_controller_step(&controller, &in);
    }
    EXPECT_EQ(result.state, TROCHOID_FAULT);
    EXPECT_EQ(result.command_m, config.lower_m + half);
  }
  EXPECT_GT(tried, 50);
}

TEST(PropertyController, SameInputsSameBits) {
  for (unsigned round = 0; round < 20; ++round) {
    TrochoidController controllers[2];
    Random randoms[2] = {Random(100 + round), Random(100 + round)};
    TrochoidControllerConfig configs[2];
    Spindle spindles[2] = {{10.0}, {10.0}};
    for (int k = 0; k < 2; ++k) {
      configs[k] = any_config(randoms[k]);
      std::memset(&controllers[k], k == 0 ? 0 : 0xa5, sizeof controllers[k]);
      trochoid_controller_init(&controllers[k], &configs[k]);
    }
    for (int i = 0; i < 2000; ++i) {
      double commands[2];
      for (int k = 0; k < 2; ++k) {
        auto in = spindles[k].next(configs[k]);
        if (one_in(randoms[k], 100) != 0) {
          spoil(in, randoms[k]);
        }
        commands[k] = trochoid_controller_step(&controllers[k], &in).command_m;
      }
      ASSERT_EQ(commands[0], commands[1]);
    }
  }
}

}  // namespace

}  // namespace trochoid
