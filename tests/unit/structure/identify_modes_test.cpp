#include <gtest/gtest.h>
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/pole_search.h>

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace trochoid::structure::identify_modes_test {

constexpr double Hz = 2 * std::numbers::pi;

struct Band {
  double from = 0.0;  // [Hz]
  double to = 0.0;
  double step = 0.0;
};

FrequencyResponse made(const std::vector<Mode>& modes, ResponseKind kind, Band band,
                       double noise = 0.0, double above = 0.0, double below = 0.0) {
  FrequencyResponse out{.kind = kind};
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  double largest = 0.0;
  for (double f = band.from; f <= band.to * (1 + 1e-12); f += band.step) {
    const double w = f * Hz;
    std::complex<double> H = above;
    if (below != 0) H -= below / (w * w);
    for (const Mode& mode : modes) H += receptance(mode, w);
    out.omega.push_back(w);
    out.H.push_back(H * factor(kind, w));
    largest = std::max(largest, std::abs(out.H.back()));
  }
  for (auto& H : out.H) {
    const double re = normal(random);
    H += noise * largest * std::complex<double>(re, normal(random));
  }
  return out;
}

Mode mode_of(double frequency, double zeta, double mass) {
  return completed({.mass = mass, .frequency = frequency, .damping_ratio = zeta});
}

void expect_mode(const FittedMode& found, const Mode& truth, double tolerance) {
  EXPECT_NEAR(found.mass.value / truth.mass, 1, tolerance);
  EXPECT_NEAR(found.stiffness.value / truth.stiffness, 1, tolerance);
  EXPECT_NEAR(found.damping.value / truth.damping, 1, tolerance);
}

TEST(IdentifyModes, FindsAModeExactlyInEachKind) {  // [M-6]
  const Mode truth = mode_of(900, 0.03, 0.6);
  for (const auto kind :
       {ResponseKind::receptance, ResponseKind::mobility, ResponseKind::accelerance}) {
    const auto fit = identify_modes(made({truth}, kind, {200, 2000, 2}), {});
    ASSERT_TRUE(fit.ok) << fit.reason;
    ASSERT_EQ(fit.modes.size(), 1U);
    expect_mode(fit.modes[0], truth, 1e-8);
    EXPECT_NEAR(fit.modes[0].omega.value, 900 * Hz, 1e-4);
    EXPECT_NEAR(fit.responses[0].explained, 1.0, 1e-12);
    const double w = fit.responses[0].omega[100];
    EXPECT_NEAR(
        std::abs(modelled(fit, w) * factor(kind, w) - fit.responses[0].fitted[100]),
        0.0, 1e-12 * std::abs(fit.responses[0].fitted[100]));
  }
}

TEST(IdentifyModes, FreePolesFindThemselvesOnTheWayThere) {  // [M-5]
  const Mode low = mode_of(400, 0.02, 1.0);
  const Mode high = mode_of(1100, 0.01, 0.3);
  const auto poles =
      find_poles(made({low, high}, ResponseKind::mobility, {50, 2000, 1}), 2, false);
  ASSERT_EQ(poles.pairs.size(), 2U);
  EXPECT_NEAR(poles.explained, 1.0, 1e-12);
  for (const Pole& pole : poles.pairs) {
    const bool is_low = std::abs(pole.p) < 700 * Hz;
    const Mode& truth = is_low ? low : high;
    const double w = natural_frequency(truth);
    const double zeta = damping_ratio(truth);
    EXPECT_NEAR(pole.p.real() / (-zeta * w), 1.0, 1e-6);
    EXPECT_NEAR(pole.p.imag() / (w * std::sqrt(1 - zeta * zeta)), 1.0, 1e-8);
    const double R = 1 / (2 * truth.mass * w * std::sqrt(1 - zeta * zeta));
    EXPECT_NEAR(std::abs(pole.R - std::complex<double>(0, -R)), 0.0, 1e-6 * R);
  }
}

TEST(IdentifyModes, ChoosesTheirNumberInNoise) {
  const std::vector<Mode> truth = {mode_of(420, 0.025, 1.1), mode_of(640, 0.015, 0.9),
                                   mode_of(1490, 0.02, 0.2)};
  const auto fit =
      identify_modes(made(truth, ResponseKind::receptance, {50, 2500, 2.5}, 0.004), {});
  ASSERT_TRUE(fit.ok) << fit.reason;
  ASSERT_EQ(fit.modes.size(), 3U);
  for (std::size_t r = 0; r < 3; ++r) {
    expect_mode(fit.modes[r], truth[r], 0.03);
  }
}

TEST(IdentifyModes, ResidualTermsStandForModesOutsideOfTheBand) {  // [M-6]
  const Mode truth = mode_of(900, 0.02, 0.5);
  const auto record =
      made({truth}, ResponseKind::receptance, {500, 1500, 1}, 0.0, 2e-8, 0.2);
  const auto with = identify_modes(record, {});
  ASSERT_TRUE(with.ok) << with.reason;
  EXPECT_TRUE(with.residual_terms);
  expect_mode(with.modes[0], truth, 1e-7);
  EXPECT_NEAR(with.responses[0].residual[0], 2e-8, 1e-14);
  EXPECT_NEAR(with.responses[0].residual[1], 0.2, 1e-7);
  const auto without = identify_modes(record, {.count = 1, .residual_terms = false});
  ASSERT_TRUE(without.ok) << without.reason;
  EXPECT_GT(without.responses[0].rms, 1e3 * with.responses[0].rms);
}

TEST(IdentifyModes, StandardErrorsAreTheScatterOfManyFits) {  // [M-7]
  const Mode truth = mode_of(500, 0.02, 1.0);
  auto clean = made({truth}, ResponseKind::receptance, {300, 800, 2});
  const double sigma = 0.01 / (truth.damping * 500 * Hz);
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, sigma);
  constexpr int runs = 200;
  double mass = 0.0;
  double damping = 0.0;
  double frequency = 0.0;
  FittedMode last;
  for (int i = 0; i < runs; ++i) {
    auto noisy = clean;
    for (auto& H : noisy.H) {
      const double re = normal(random);
      H += std::complex<double>(re, normal(random));
    }
    const auto fit = identify_modes(noisy, {.count = 1, .residual_terms = false});
    ASSERT_TRUE(fit.ok) << fit.reason;
    last = fit.modes[0];
    mass += std::pow(last.mass.value - truth.mass, 2) / runs;
    damping += std::pow(last.damping.value - truth.damping, 2) / runs;
    frequency += std::pow(last.omega.value - 500 * Hz, 2) / runs;
  }
  // 200 runs tell a standard deviation to 5 %: three of that
  EXPECT_NEAR(last.mass.se / std::sqrt(mass), 1.0, 0.15);
  EXPECT_NEAR(last.damping.se / std::sqrt(damping), 1.0, 0.15);
  EXPECT_NEAR(last.omega.se / std::sqrt(frequency), 1.0, 0.15);
}

TEST(IdentifyModes, AnExponentialWindowIsTakenOut) {  // [M-22]
  const Mode low = mode_of(420, 0.004, 1.1);
  const Mode high = mode_of(900, 0.02, 0.6);
  const double a = 29.0;  // 1/s: more than the low mode decays by itself
  FrequencyResponse record{.kind = ResponseKind::accelerance};
  for (double f = 100; f <= 1500; f += 2) {
    const std::complex<double> s(a, f * Hz);
    std::complex<double> H;
    for (const Mode& m : {low, high}) {
      H += 1.0 / (m.mass * s * s + m.damping * s + m.stiffness);
    }
    record.omega.push_back(f * Hz);
    record.H.push_back(H * factor(record.kind, f * Hz));
  }
  const auto fit = identify_modes(record, {.window_decay = a});
  ASSERT_EQ(fit.modes.size(), 2U) << fit.reason;
  expect_mode(fit.modes[0], low, 1e-6);
  expect_mode(fit.modes[1], high, 1e-6);
  EXPECT_NEAR(fit.modes[0].omega.value, natural_frequency(low), 1e-3);
  EXPECT_NEAR(fit.modes[0].zeta.value, 0.004, 1e-8);
  const auto bare = identify_modes(record, {});
  EXPECT_GT(bare.modes.at(0).zeta.value, 0.012) << "the window is a damping";
}

/// Stiffness and damping follow from frequency, damping ratio and mass: so do errors.
void expect_consistent(const ModesFit& fit) {
  const std::size_t n = 3 * fit.modes.size();
  ASSERT_EQ(fit.covariance.size(), n * n);
  for (std::size_t k = 0; k < fit.modes.size(); ++k) {
    const FittedMode& m = fit.modes[k];
    const double x[] = {m.omega.value, m.zeta.value, m.mass.value};
    const auto error = [&](double omega, double zeta, double mass) {
      const double power[] = {omega, zeta, mass};
      double sum = 0.0;
      for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
          sum += power[i] * power[j] / (x[i] * x[j]) *
                 fit.covariance[(3 * k + i) * n + 3 * k + j];
        }
      }
      return std::sqrt(sum);
    };
    EXPECT_NEAR(error(1, 0, 0) * m.omega.value / m.omega.se, 1, 1e-9);
    EXPECT_NEAR(error(0, 1, 0) * m.zeta.value / m.zeta.se, 1, 1e-9);
    EXPECT_NEAR(error(0, 0, 1) * m.mass.value / m.mass.se, 1, 1e-9);
    EXPECT_NEAR(error(2, 0, 1) * m.stiffness.value / m.stiffness.se, 1, 1e-6);
    EXPECT_NEAR(error(1, 1, 1) * m.damping.value / m.damping.se, 1, 1e-6);
  }
}

TEST(IdentifyModes, TheCovarianceIsThatOfTheStandardErrors) {  // [U-1]
  const auto record = made({mode_of(500, 0.02, 1.0), mode_of(700, 0.03, 0.8)},
                           ResponseKind::accelerance, {300, 1000, 2}, 0.01);
  for (const double a : {0.0, 20.0}) {
    const auto fit = identify_modes(record, {.count = 2, .window_decay = a});
    ASSERT_TRUE(fit.ok) << fit.reason;
    expect_consistent(fit);
  }
}

TEST(IdentifyModes, CloseModesHangTogetherAsTheCovarianceSays) {
  const std::vector<Mode> truth = {mode_of(500, 0.03, 1.0), mode_of(520, 0.03, 1.0)};
  const auto clean = made(truth, ResponseKind::receptance, {400, 620, 2});
  std::mt19937 random(11);
  std::normal_distribution<double> normal(0.0, 0.01 * std::abs(clean.H[50]));
  constexpr int runs = 100;
  double mean[2] = {};
  double square[2] = {};
  double product = 0.0;
  double told = 0.0;
  for (int i = 0; i < runs; ++i) {
    auto noisy = clean;
    for (auto& H : noisy.H) {
      const double re = normal(random);
      H += std::complex<double>(re, normal(random));
    }
    const auto fit = identify_modes(noisy, {.count = 2, .residual_terms = false});
    ASSERT_EQ(fit.modes.size(), 2U) << fit.reason;
    for (std::size_t k = 0; k < 2; ++k) {
      mean[k] += fit.modes[k].mass.value / runs;
      square[k] += std::pow(fit.modes[k].mass.value, 2) / runs;
    }
    product += fit.modes[0].mass.value * fit.modes[1].mass.value / runs;
    told += fit.covariance[2 * 6 + 5] / (fit.modes[0].mass.se * fit.modes[1].mass.se) /
            runs;
  }
  const double seen =
      (product - mean[0] * mean[1]) /
      std::sqrt((square[0] - mean[0] * mean[0]) * (square[1] - mean[1] * mean[1]));
  EXPECT_LT(told, -0.4) << "what one takes the other leaves";
  EXPECT_NEAR(seen, told, 0.2);
}

void expect_refused(const FrequencyResponse& record, const ModesOptions& options,
                    const std::string& words) {
  const auto fit = identify_modes(record, options);
  EXPECT_FALSE(fit.ok);
  EXPECT_TRUE(fit.modes.empty());
  EXPECT_NE(fit.reason.find(words), std::string::npos) << fit.reason;
}

TEST(IdentifyModes, RefusesWhereNoResonanceLiesInTheBand) {
  const Mode truth = mode_of(900, 0.02, 0.5);
  const auto clean = made({truth}, ResponseKind::receptance, {100, 600, 2}, 1e-4);
  expect_refused(clean, {}, "no resonance lies in the band from 100 Hz to 600 Hz");
  const auto whole = made({truth}, ResponseKind::receptance, {100, 2000, 2});
  expect_refused(whole, {.from = 1100 * Hz}, "no resonance");
}

TEST(IdentifyModes, RefusesNoise) {
  const auto noise = made({}, ResponseKind::receptance, {100, 1000, 2}, 0.0);
  expect_refused(noise, {}, "zero");
  auto flat = noise;
  std::mt19937 random(3);
  std::normal_distribution<double> normal(0.0, 1e-8);
  for (auto& H : flat.H) {
    const double re = normal(random);
    H = {re, normal(random)};
  }
  const auto fit = identify_modes(flat, {});
  EXPECT_FALSE(fit.ok);
}

TEST(IdentifyModes, RefusesAPeakThatIsCutOff) {
  const Mode truth = mode_of(900, 0.02, 0.5);
  expect_refused(made({truth}, ResponseKind::receptance, {300, 905, 1}), {},
                 "half-power points");
}

TEST(IdentifyModes, RefusesLessDampingThanTheWindowAdds) {  // [M-22]
  const Mode truth = mode_of(900, 0.02, 0.5);               // decays by 113 1/s
  expect_refused(made({truth}, ResponseKind::receptance, {300, 1500, 1}),
                 {.window_decay = 200}, "exponential window");
}

TEST(IdentifyModes, RefusesAPeakBetweenTwoLines) {
  const Mode truth = mode_of(905, 0.001, 0.5);
  expect_refused(made({truth}, ResponseKind::receptance, {300, 1500, 10}), {},
                 "measure longer");
}

/// Beside it the rest is below rounding, and the poles of a search were no numbers.
TEST(IdentifyModes, RefusesOneLineThatIsOutOfAllProportion) {
  const Mode truth = mode_of(900, 0.02, 0.5);
  const auto sound = made({truth}, ResponseKind::accelerance, {300, 1500, 5}, 1e-2);
  for (const double height : {1e10, 1e13, 1e16, 1e18, 1e22, 1e30}) {
    for (const std::size_t at : {3U, 100U, 150U, 237U}) {
      auto spoilt = sound;
      spoilt.H[at].imag(height);
      EXPECT_FALSE(identify_modes(spoilt, {}).ok) << height << " at " << at;
    }
  }
}

TEST(IdentifyModes, SaysWhichKindAResponseLooksLike) {
  const Mode truth = mode_of(900, 0.02, 0.5);
  auto record = made({truth}, ResponseKind::mobility, {300, 1500, 1}, 1e-3);
  record.kind = ResponseKind::receptance;
  expect_refused(record, {}, "turns like a mobility");
  record.kind = ResponseKind::accelerance;
  expect_refused(record, {}, "turns like a mobility");
  record = made({truth}, ResponseKind::accelerance, {300, 1500, 1}, 1e-3);
  record.kind = ResponseKind::receptance;
  expect_refused(record, {}, "turns like an accelerance");
}

TEST(IdentifyModes, RefusesTooFewLines) {
  const Mode truth = mode_of(900, 0.02, 0.5);
  expect_refused(made({truth}, ResponseKind::receptance, {880, 920, 10}), {}, "lines");
}

TEST(IdentifyModes, LeavesOutTheLineAtZero) {
  const Mode truth = mode_of(90, 0.02, 0.5);
  const auto fit =
      identify_modes(made({truth}, ResponseKind::accelerance, {0, 300, 0.5}), {});
  ASSERT_TRUE(fit.ok) << fit.reason;
  EXPECT_EQ(fit.responses[0].omega.size(), 600U);
  expect_mode(fit.modes[0], truth, 1e-7);
}

}  // namespace trochoid::structure::identify_modes_test
