#include <trochoid/correction/estimator.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace trochoid::estimator_test {

namespace {

constexpr double turn = 2.0 * std::numbers::pi;
constexpr double um = 1e-6;

/// Flutes whose force follows chip to a power; the table is the command.
struct Machine {
  std::vector<double> rho;  ///< what the teeth stand out [m]
  double feed = 50 * um;
  double exponent = 0.6;  ///< of the chip
  double response = 1.0;  ///< of the table, over the model
  double noise = 0.0;
  std::mt19937_64 random{3};

  [[nodiscard]] double table(const TrochoidEstimatorResult& r, double angle) const {
    double x = 0.0;
    for (int n = 0; n < TROCHOID_WAVE_HARMONICS; ++n) {
      x += r.cosine_m[n] * std::cos((n + 1) * angle) +
           r.sine_m[n] * std::sin((n + 1) * angle);
    }
    return response * x;
  }

  [[nodiscard]] std::vector<double> peaks(const TrochoidEstimatorResult& r) {
    const std::size_t N = rho.size();
    std::normal_distribution<double> normal(0.0, 1.0);
    std::vector<double> p;
    for (std::size_t j = 0; j < N; ++j) {
      const double step = turn / static_cast<double>(N);
      const double angle = step * (static_cast<double>(j) + 0.5);
      const double chip = feed + rho[j] - rho[(j + N - 1) % N] -
                          (table(r, angle) - table(r, angle - step));
      p.push_back(chip > 0 ? 1e5 * std::pow(chip, exponent) *
                                 (1 + (noise > 0 ? noise * normal(random) : 0.0))
                           : 0.0);
    }
    return p;
  }
};

/// The model of that machine, linear about no runout; R-31 written anew.
TrochoidEstimatorConfig config_for(const Machine& machine, int harmonics) {
  TrochoidEstimatorConfig c;
  trochoid_estimator_defaults(&c);
  const std::size_t N = machine.rho.size();
  c.teeth = static_cast<int32_t>(N);
  c.harmonics = harmonics;
  const double step = turn / static_cast<double>(N);
  const double slope = machine.exponent / machine.feed;
  for (std::size_t j = 0; j < N; ++j) {
    const double angle = step * (static_cast<double>(j) + 0.5);
    c.start_rev[j] = static_cast<double>(j) / static_cast<double>(N);
    for (int n = 1; n <= harmonics; ++n) {
      c.wave_model[j][2 * n - 2] =
          -slope * (std::cos(n * angle) - std::cos(n * (angle - step)));
      c.wave_model[j][2 * n - 1] =
          -slope * (std::sin(n * angle) - std::sin(n * (angle - step)));
    }
    c.runout_model[j][j] = slope;
    c.runout_model[j][(j + N - 1) % N] = -slope;
  }
  return c;
}

struct Turns {
  TrochoidEstimator estimator{};
  TrochoidEstimatorResult last{};

  explicit Turns(const TrochoidEstimatorConfig& config) {
    EXPECT_EQ(trochoid_estimator_init(&estimator, &config),
              TROCHOID_ESTIMATOR_ACCEPTED);
  }

  /// A turn of half sines; the next one's first sample completes it.
  TrochoidEstimatorResult turn_of(Machine& machine) {
    const auto peaks = machine.peaks(estimator.result);
    const auto N = static_cast<int>(peaks.size());
    int became = TROCHOID_TURN_OPEN;
    int event = TROCHOID_TOOL_UNCHANGED;
    for (int i = 0; i < 40 * N; ++i) {
      const double angle = (i + 0.5) / (40.0 * N);
      const double within = std::fmod(angle * N, 1.0);
      const double force = -peaks[static_cast<std::size_t>(i / 40)] *
                           std::sin(std::numbers::pi * within);
      last = trochoid_estimator_sample(&estimator, angle, force, 1);
      if (last.turn != TROCHOID_TURN_OPEN) {
        became = last.turn;
        event = last.event;
      }
    }
    last.turn = became;
    last.event = event;
    return last;
  }
};

double difference_of(const std::vector<double>& p) {
  const auto [least, most] = std::ranges::minmax_element(p);
  return (*most - *least) / *most;
}

const std::vector<double> four = {10 * um, -4 * um, 6 * um, -12 * um};

}  // namespace

TEST(Estimator, BringsAnyNumberOfFlutesBelowThreePercent) {  // [L-9] [L-10] [L-11]
  for (const auto& rho :
       {std::vector<double>{9 * um, -9 * um},
        std::vector<double>{8 * um, -5 * um, 2 * um}, four,
        std::vector<double>{5 * um, -8 * um, 3 * um, 1 * um, -4 * um, 2 * um},
        std::vector<double>{4 * um, -6 * um, 3 * um, 1 * um, -4 * um, 2 * um, 5 * um,
                            -3 * um}}) {
    Machine machine{.rho = rho};
    EXPECT_GT(difference_of(machine.peaks({})), 0.2);
    Turns turns(config_for(machine, std::max(2, static_cast<int>(rho.size()) - 1)));
    for (int k = 0; k < 14; ++k) {
      turns.turn_of(machine);
    }
    EXPECT_LT(difference_of(machine.peaks(turns.estimator.result)), 0.01) << rho.size();
  }
}

TEST(Estimator, LearnsAModelThatIsWrong) {  // [L-10]
  for (const double response : {0.5, 1.6}) {
    Machine machine{.rho = four, .response = response};
    Turns turns(config_for(machine, 3));
    for (int k = 0; k < 24; ++k) {
      turns.turn_of(machine);
    }
    EXPECT_LT(difference_of(machine.peaks(turns.estimator.result)), 0.01) << response;
  }
}

TEST(Estimator, StaysBelowThreePercentInNoise) {
  Machine machine{.rho = four, .noise = 0.005};
  Turns turns(config_for(machine, 3));
  for (int k = 0; k < 200; ++k) {
    turns.turn_of(machine);
    if (k > 20) {
      Machine quiet = machine;
      quiet.noise = 0.0;
      EXPECT_LT(difference_of(quiet.peaks(turns.estimator.result)), 0.03) << k;
      EXPECT_EQ(turns.last.events, 0);
    }
  }
}

TEST(Estimator, NeverAsksForMoreThanTheStroke) {  // [L-11]
  Machine machine{.rho = {40 * um, -30 * um, 20 * um, -30 * um}, .feed = 120 * um};
  auto config = config_for(machine, 3);
  config.most_m = 5 * um;
  Turns turns(config);
  for (int k = 0; k < 20; ++k) {
    turns.turn_of(machine);
    for (int i = 0; i < 500; ++i) {
      EXPECT_LE(std::abs(machine.table(turns.last, turn * i / 500)), 5.05 * um);
    }
  }
}

TEST(Estimator, RecognisesAToothThatBreaks) {  // [L-12]
  Machine machine{.rho = four};
  auto config = config_for(machine, 3);
  config.event_change = 0.05;
  Turns turns(config);
  for (int k = 0; k < 40; ++k) {
    turns.turn_of(machine);
  }
  EXPECT_EQ(turns.last.events, 0);
  machine.rho[2] -= 8 * um;  // breaks at the edge
  int told = 0;
  for (int k = 0; k < 20; ++k) {
    if (turns.turn_of(machine).event != TROCHOID_TOOL_UNCHANGED) {
      ++told;
      EXPECT_EQ(turns.last.event, TROCHOID_TOOTH_WORN);
      EXPECT_EQ(turns.last.tooth, 3);
      EXPECT_NEAR(turns.last.change_m, -8 * um, 3 * um);
    }
  }
  EXPECT_EQ(told, 1);
  EXPECT_LT(difference_of(machine.peaks(turns.estimator.result)), 0.02);
}

TEST(Estimator, RecognisesSlowWearOfOneTooth) {  // [L-12]
  Machine machine{.rho = four};
  auto config = config_for(machine, 3);
  config.event_change = 0.05;
  Turns turns(config);
  int first = 0;
  for (int k = 0; k < 400; ++k) {
    machine.rho[1] -= k > 40 ? 0.02 * um : 0.0;
    if (turns.turn_of(machine).event != TROCHOID_TOOL_UNCHANGED && first == 0) {
      first = k;
      EXPECT_EQ(turns.last.event, TROCHOID_TOOTH_WORN);
      EXPECT_EQ(turns.last.tooth, 2);
      EXPECT_LT(turns.last.change_m, 0.0);
    }
    EXPECT_TRUE(k < 20 || turns.last.difference < 0.03) << k;
  }
  EXPECT_GT(first, 40);
}

TEST(Estimator, RecognisesAnotherTool) {  // [L-12]
  Machine machine{.rho = four};
  Turns turns(config_for(machine, 3));
  for (int k = 0; k < 30; ++k) {
    turns.turn_of(machine);
  }
  machine.rho = {-9 * um, 9 * um, -10 * um, 6 * um};
  int told = 0;
  for (int k = 0; k < 20; ++k) {
    told += turns.turn_of(machine).event == TROCHOID_TOOL_CHANGED ? 1 : 0;
  }
  EXPECT_EQ(told, 1);
  EXPECT_LT(difference_of(machine.peaks(turns.estimator.result)), 0.02);
}

TEST(Estimator, OneSpoiltTurnIsNoEventAndIsNotLearntFrom) {  // [L-12]
  Machine machine{.rho = four};
  Turns turns(config_for(machine, 3));
  for (int k = 0; k < 30; ++k) {
    turns.turn_of(machine);
  }
  const auto before = turns.estimator.result;
  Machine hard{.rho = {40 * um, -9 * um, 6 * um, -12 * um}};  // a hard inclusion
  turns.turn_of(hard);
  turns.turn_of(machine);
  for (int n = 0; n < 3; ++n) {
    EXPECT_EQ(turns.last.cosine_m[n], before.cosine_m[n]);
  }
  EXPECT_EQ(turns.last.events, 0);
}

TEST(Estimator, TurnsThatTellNothingChangeNothing) {
  Machine machine{.rho = four};
  Turns turns(config_for(machine, 3));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 400; ++i) {
    trochoid_estimator_sample(&turns.estimator, 0.01 * i, i % 50 == 3 ? nan : 50.0, 1);
  }
  EXPECT_EQ(turns.estimator.result.learnt, 0);
  for (int i = 0; i < 400; ++i) {
    turns.last = trochoid_estimator_sample(&turns.estimator, 0.01 * i, 0.1, 1);
    if (turns.last.turn == TROCHOID_TURN_NO_CUT) {
      break;
    }
  }
  EXPECT_EQ(turns.last.turn, TROCHOID_TURN_NO_CUT);
  EXPECT_EQ(turns.estimator.result.learnt, 0);
}

TEST(Estimator, WrongConfigurationsAreRefused) {
  const Machine machine{.rho = four};
  const auto refused = [&](auto spoil) {
    auto config = config_for(machine, 3);
    spoil(config);
    TrochoidEstimator estimator;
    const int32_t why = trochoid_estimator_init(&estimator, &config);
    EXPECT_EQ(trochoid_estimator_sample(&estimator, 0.1, 1.0, 1).turn,
              TROCHOID_TURN_NOT_READY);
    EXPECT_STRNE(trochoid_estimator_refusal_reason(why), "unknown");
    return why;
  };
  using Config = TrochoidEstimatorConfig;
  EXPECT_EQ(refused([](Config& c) { c.teeth = 9; }), TROCHOID_ESTIMATOR_REFUSED_TEETH);
  EXPECT_EQ(refused([](Config& c) { c.harmonics = 0; }),
            TROCHOID_ESTIMATOR_REFUSED_TEETH);
  EXPECT_EQ(refused([](Config& c) { c.start_rev[2] = 0.2; }),
            TROCHOID_ESTIMATOR_REFUSED_WINDOWS);
  EXPECT_EQ(refused([](Config& c) {
              c.wave_model[1][2] = std::numeric_limits<double>::quiet_NaN();
            }),
            TROCHOID_ESTIMATOR_REFUSED_MODEL);
  EXPECT_EQ(refused([](Config& c) { c.forgetting = 0.1; }),
            TROCHOID_ESTIMATOR_REFUSED_LEARNING);
  EXPECT_EQ(trochoid_estimator_init(nullptr, nullptr),
            TROCHOID_ESTIMATOR_REFUSED_POINTER);
}

}  // namespace trochoid::estimator_test
