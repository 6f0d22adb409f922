// Modes close to one another, weak beside strong ones, in noise of several kinds.
#include "made_response.h"

#include <gtest/gtest.h>
#include <trochoid/structure/identify_modes.h>

#include <cmath>
#include <string>
#include <vector>

namespace trochoid::structure::close_modes_test {

using made::Hz;
using made::mode_of;

std::string found(const ModesFit& fit) {
  std::string text = fit.ok ? "ok" : fit.reason;
  for (const FittedMode& m : fit.modes) {
    text += " " + std::to_string(m.omega.value / Hz) + " (" +
            std::to_string(m.zeta.value) + ")";
  }
  for (const ModesOrder& o : fit.orders) {
    text += "\n" + std::to_string(o.criterion) + " " + std::to_string(o.residual_terms);
    for (const auto& [w, z] : o.modes) {
      text += " " + std::to_string(w / Hz) + " (" + std::to_string(z) + ")";
    }
    text += " " + o.fault;
  }
  return text;
}

/// Within four standard errors, and those no larger than a fraction.
void expect_known(const FittedMode& m, const Mode& truth, double worst) {
  EXPECT_NEAR(m.omega.value, natural_frequency(truth), 4 * m.omega.se);
  EXPECT_NEAR(m.zeta.value, damping_ratio(truth), 4 * m.zeta.se);
  EXPECT_NEAR(m.stiffness.value, truth.stiffness, 4 * m.stiffness.se);
  EXPECT_LT(m.stiffness.se, worst * truth.stiffness);
}

TEST(CloseModes, TwoHalfAPeakApartAreTwo) {  // [M-16] [M-17]
  const std::vector<Mode> truth = {mode_of(1000, 0.02, 1.0), mode_of(1040, 0.02, 1.0)};
  for (unsigned seed = 1; seed <= 2; ++seed) {
    for (const auto noise : {made::Noise{.floor = 0.05}, {.fraction = 0.05}}) {
      const auto record =
          made::response(truth, ResponseKind::receptance, {500, 1600, 1}, noise, seed);
      for (const int count : {0, 2}) {
        const auto fit = identify_modes(record, {.count = count});
        ASSERT_EQ(fit.modes.size(), 2U) << found(fit);
        expect_known(fit.modes[0], truth[0], 0.3);
        expect_known(fit.modes[1], truth[1], 0.3);
      }
    }
  }
}

TEST(CloseModes, ThreeInARowAreThree) {
  const std::vector<Mode> truth = {mode_of(1000, 0.02, 1.0), mode_of(1060, 0.02, 1.0),
                                   mode_of(1130, 0.02, 1.0)};
  for (const auto noise : {made::Noise{.floor = 0.02}, {.fraction = 0.05}}) {
    const auto fit = identify_modes(
        made::response(truth, ResponseKind::receptance, {500, 1600, 1}, noise), {});
    ASSERT_EQ(fit.modes.size(), 3U) << found(fit);
    for (std::size_t r = 0; r < 3; ++r) expect_known(fit.modes[r], truth[r], 0.3);
  }
}

TEST(CloseModes, AWeakOneFarBelowIsFound) {
  // At its own peak the accelerance of the slow mode is a hundredth of the other's.
  const std::vector<Mode> truth = {mode_of(60, 0.03, 20.0), mode_of(1800, 0.02, 0.3)};
  for (const auto kind : {ResponseKind::accelerance, ResponseKind::receptance}) {
    const auto fit = identify_modes(
        made::response(truth, kind, {20, 2500, 1.2}, {.fraction = 0.03}), {});
    ASSERT_EQ(fit.modes.size(), 2U) << found(fit);
    for (std::size_t r = 0; r < 2; ++r) expect_known(fit.modes[r], truth[r], 0.1);
  }
}

TEST(CloseModes, AModeWithTooFewLinesIsNotLeftOutInSilence) {
  const std::vector<Mode> truth = {mode_of(60, 0.01, 2.0), mode_of(1800, 0.02, 0.3)};
  const auto fit = identify_modes(made::response(truth, ResponseKind::receptance,
                                                 {20, 3000, 5}, {.fraction = 0.01}),
                                  {});
  ASSERT_EQ(fit.modes.size(), 1U) << found(fit);
  ASSERT_EQ(fit.left_out.size(), 1U) << found(fit);
  EXPECT_NE(fit.left_out[0].find("measure longer"), std::string::npos);
  EXPECT_NEAR(fit.unresolved[0].omega.value / Hz, 60, 0.5);
  expect_known(fit.modes[0], truth[1], 0.02);
  const double w = fit.responses[0].omega[100];
  EXPECT_NEAR(std::abs(modelled(fit, w) - fit.responses[0].fitted[100]), 0.0,
              1e-12 * std::abs(fit.responses[0].fitted[100]));
}

TEST(CloseModes, ARippleOfAFewThousandthsIsNoMode) {
  auto record = made::response({mode_of(900, 0.02, 0.5)}, ResponseKind::receptance,
                               {300, 2000, 2}, {.fraction = 1e-4});
  const auto ripple = mode_of(1500, 0.03, 2000.0);
  for (std::size_t i = 0; i < record.omega.size(); ++i) {
    record.H[i] += receptance(ripple, record.omega[i]);
  }
  const auto fit = identify_modes(record, {});
  ASSERT_EQ(fit.modes.size(), 1U) << found(fit);
  ASSERT_EQ(fit.unresolved.size(), 1U) << found(fit);
  EXPECT_NEAR(fit.unresolved[0].omega.value / Hz, 1500, 10);
  EXPECT_NE(fit.left_out[0].find("% of the response at its own peak"),
            std::string::npos);
}

TEST(CloseModes, TheNoiseIsRecognised) {  // [M-15]
  const std::vector<Mode> truth = {mode_of(700, 0.03, 1.0)};
  const auto with = [&](made::Noise noise) {
    const auto fit = identify_modes(
        made::response(truth, ResponseKind::mobility, {200, 1500, 1}, noise), {});
    EXPECT_EQ(fit.modes.size(), 1U) << found(fit);
    return fit;
  };
  const double largest = 1 / truth[0].damping;
  auto fit = with({.floor = 0.01});
  EXPECT_NEAR(fit.responses[0].noise.floor / (0.01 * largest), 1,
              0.1);  // 2600 numbers: 1.4 %
  EXPECT_EQ(fit.responses[0].noise.magnitude, 0.0);
  fit = with({.fraction = 0.03});
  EXPECT_NEAR(fit.responses[0].noise.magnitude / 0.03, 1, 0.1);
  EXPECT_EQ(fit.responses[0].noise.magnitude, fit.responses[0].noise.phase);
  fit = with({.floor = 0.002, .magnitude = 0.05});
  EXPECT_NEAR(fit.responses[0].noise.magnitude / 0.05, 1, 0.2);
  EXPECT_LT(fit.responses[0].noise.phase, 0.01);
  EXPECT_NEAR(fit.responses[0].noise.floor / (0.002 * largest), 1, 0.1);
}

TEST(CloseModes, OneIsNotTakenForTwo) {
  int more = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const auto fit = identify_modes(
        made::response({mode_of(900, 0.03, 1.0)}, ResponseKind::accelerance,
                       {300, 2000, 3}, {.floor = 0.01, .fraction = 0.03}, seed),
        {});
    more += fit.modes.size() == 1 ? 0 : 1;
    EXPECT_EQ(fit.modes.size(), 1U) << seed << ": " << found(fit);
  }
  EXPECT_EQ(more, 0);
}

}  // namespace trochoid::structure::close_modes_test
