// Modes that several responses of one structure share, and their shapes.
#include "made_shapes.h"

#include <gtest/gtest.h>
#include <trochoid/structure/identify_modes.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

namespace trochoid::structure::identify_shapes_test {

using made::all_of;
using made::Hz;
using made::measured;
using made::Plane;

constexpr double deg = std::numbers::pi / 180;

#ifdef __SANITIZE_ADDRESS__
constexpr unsigned seeds = 1;
#else
constexpr unsigned seeds = 2;
#endif
/// Enough lines where the number of modes is given.
constexpr made::Band coarse{600, 1600, 5};

/// Close modes at 30 and 120 deg.
const Plane tilted{{{{1000, 0.03, 0.5, 30}, {1080, 0.025, 0.8, 120}}}};

std::string told(const ModesFit& fit) {
  std::string text = fit.ok ? "ok" : fit.reason;
  for (const ModesOrder& o : fit.orders) {
    text += "\n" + std::to_string(o.criterion) + " " +
            (o.complex_shapes ? "complex " : "real ") + (o.residual_terms ? "UL" : "");
    for (const auto& [w, z] : o.modes) {
      text += " " + std::to_string(w / Hz) + " (" + std::to_string(z) + ")";
    }
    text += " " + o.fault;
  }
  return text;
}

void expect_known(const Known& found, double truth, double worst) {
  EXPECT_NEAR(found.value, truth, 4 * found.se);
  EXPECT_LT(found.se, worst);
  EXPECT_GT(found.se, 0.0);
}

void expect_mode(const FittedMode& found, const made::TiltedMode& truth) {
  expect_known(found.omega, truth.frequency * Hz, 0.002 * truth.frequency * Hz);
  expect_known(found.zeta, truth.zeta, 0.03 * truth.zeta);
  expect_known(found.mass, truth.mass, 0.03 * truth.mass);
  const double angle = truth.angle > 90 ? truth.angle - 180 : truth.angle;
  expect_known(found.angle, angle * deg, 1 * deg);
}

TEST(IdentifyShapes,
     ModesAt30And120DegreesComeOutRight) {  // [M-30] [M-31] [M-32] [M-33]
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    const auto fit =
        identify_shapes(all_of(tilted, {"xx", "xy", "yy"}, {.seed = seed}), {});
    ASSERT_EQ(fit.modes.size(), 2U) << told(fit);
    EXPECT_FALSE(fit.complex_shapes) << told(fit);
    expect_mode(fit.modes[0], tilted.modes[0]);
    expect_mode(fit.modes[1], tilted.modes[1]);
    for (const FittedResponse& one : fit.responses) {
      EXPECT_NEAR(one.noise.magnitude, 0.02, 0.004);
      EXPECT_EQ(one.residues.size(), 2U);
    }
  }
}

TEST(IdentifyShapes, TheCovarianceIsThatOfTheStandardErrors) {  // [U-1]
  const auto fit = identify_shapes(all_of(tilted, {"xx", "xy", "yy"}, {.band = coarse}),
                                   {.count = 2});
  ASSERT_EQ(fit.real_modes.size(), 2U) << told(fit);
  ASSERT_EQ(fit.covariance.size(), 64U);
  const auto at = [&](std::size_t i, std::size_t j) {
    return fit.covariance[8 * i + j];
  };
  for (std::size_t k = 0; k < 2; ++k) {
    const FittedMode& m = fit.real_modes[k];
    const std::size_t i = 4 * k;
    EXPECT_NEAR(std::sqrt(at(i, i)) / m.omega.se, 1, 1e-9);
    EXPECT_NEAR(std::sqrt(at(i + 1, i + 1)) / m.zeta.se, 1, 1e-9);
    EXPECT_NEAR(std::sqrt(at(i + 2, i + 2)) / m.mass.se, 1, 1e-9);
    EXPECT_NEAR(std::sqrt(at(i + 3, i + 3)) / m.angle.se, 1, 1e-9);
    const double w = 2 / m.omega.value;
    const double u = 1 / m.mass.value;
    const double both =
        w * w * at(i, i) + 2 * w * u * at(i, i + 2) + u * u * at(i + 2, i + 2);
    EXPECT_NEAR(std::sqrt(both) * m.stiffness.value / m.stiffness.se, 1, 1e-6);
  }
  EXPECT_EQ(at(2, 6), at(6, 2));
  EXPECT_NE(at(2, 6), 0);
}

TEST(IdentifyShapes, KindsAndLinesMayDifferBetweenResponses) {  // [M-30]
  std::vector<DirectedResponse> all = all_of(tilted, {"xx"}, {.band = coarse});
  all.push_back(measured(tilted, "xy",
                         {.band = {601, 1700, 6}, .kind = ResponseKind::accelerance}));
  all.push_back(
      measured(tilted, "yy", {.band = {550, 1500, 4}, .kind = ResponseKind::mobility}));
  const auto fit = identify_shapes(all, {.count = 2, .complex_shapes = false});
  ASSERT_EQ(fit.modes.size(), 2U) << told(fit);
  expect_mode(fit.modes[0], tilted.modes[0]);
  expect_mode(fit.modes[1], tilted.modes[1]);
}

TEST(IdentifyShapes, OneFrequencyInTwoDirectionsIsTwoModes) {
  const Plane round{{{{1000, 0.03, 0.5, 20}, {1004, 0.03, 0.5, 110}}}};
  const auto fit = identify_shapes(all_of(round, {"xx", "xy", "yy"}, {.band = coarse}),
                                   {.complex_shapes = false});
  ASSERT_EQ(fit.modes.size(), 2U) << told(fit);
  for (const FittedMode& mode : fit.modes) {
    EXPECT_NEAR(mode.omega.value, 1002 * Hz, 4 * Hz);
    EXPECT_NEAR(mode.mass.value, 0.5, 0.03);
  }
}

TEST(IdentifyShapes, ADamperInOnePlaceMakesShapesComplex) {  // [M-30] [M-33]
  const Plane damped{.modes = {{{1000, 0.02, 0.5, 0}, {1080, 0.02, 0.8, 90}}},
                     .damper = 200};
  const auto all = all_of(damped, {"xx", "xy", "yy"}, {.band = coarse});
  const auto fit = identify_shapes(all, {.count = 2, .residual_terms = false});
  ASSERT_TRUE(fit.ok) << told(fit);
  EXPECT_TRUE(fit.complex_shapes) << told(fit);
  ASSERT_TRUE(fit.complex_evidence.has_value());
  EXPECT_GT(*fit.complex_evidence, 100.0);
  for (const FittedMode& mode : fit.modes) {
    EXPECT_GT(mode.imaginary.value, 0.05);
    EXPECT_LT(mode.imaginary.se, 0.01);
  }
  // Without noise beyond that of the lines the model is the structure's.
  for (const FittedResponse& one : fit.responses) {
    EXPECT_NEAR(one.noise.magnitude, 0.02, 0.004);
  }
  ASSERT_EQ(fit.real_modes.size(), 2U);
  EXPECT_EQ(fit.real_modes[0].imaginary.value, 0.0);
}

TEST(IdentifyShapes, ComplexShapesOfALightDamperAreExact) {  // [M-30]
  const Plane damped{.modes = {{{1000, 0.02, 0.5, 0}, {1080, 0.02, 0.8, 90}}},
                     .damper = 200};
  const auto fit = identify_shapes(
      all_of(damped, {"xx", "xy", "yy"}, {.band = coarse, .noise = {.floor = 1e-9}}),
      {.count = 2, .residual_terms = false, .complex_shapes = true});
  ASSERT_TRUE(fit.ok) << told(fit);
  for (const FittedResponse& one : fit.responses) {
    EXPECT_GT(one.explained, 1 - 1e-14);
  }
}

TEST(IdentifyShapes, ASwappedSignOfACrossResponseIsNamed) {  // [M-34]
  auto all = all_of(tilted, {"xx", "xy", "yx", "yy"}, {.band = coarse});
  for (auto& H : all[2].response.H) {
    H = -H;
  }
  const auto fit = identify_shapes(all, {});
  EXPECT_FALSE(fit.ok);
  EXPECT_TRUE(fit.modes.empty());
  EXPECT_NE(fit.reason.find("the responses xy and yx have opposite signs"),
            std::string::npos)
      << fit.reason;
}

TEST(IdentifyShapes, ASwappedSignOfADirectResponseIsNamed) {
  auto all = all_of(tilted, {"xx", "xy", "yy"}, {.band = coarse});
  for (auto& H : all[2].response.H) {
    H = -H;
  }
  const auto fit = identify_shapes(all, {.count = 2});
  EXPECT_FALSE(fit.ok);
  EXPECT_NE(fit.reason.find("response yy: "), std::string::npos) << fit.reason;
  EXPECT_NE(fit.reason.find("sign must be changed"), std::string::npos) << fit.reason;
}

TEST(IdentifyShapes, ReciprocityIsMeasured) {  // [M-34]
  auto all = all_of(tilted, {"xx", "xy", "yx", "yy"}, {.band = coarse});
  const ModesOptions two{.count = 2, .complex_shapes = false};
  const auto fit = identify_shapes(all, two);
  ASSERT_EQ(fit.reciprocity.size(), 1U) << told(fit);
  EXPECT_NEAR(fit.reciprocity[0].gain.value, 1.0, 4 * fit.reciprocity[0].gain.se);
  EXPECT_LT(fit.reciprocity[0].gain.se, 0.01);
  for (auto& H : all[2].response.H) {
    H *= 1.1;  // a hammer with another calibration
  }
  const auto hurt = identify_shapes(all, two);
  ASSERT_EQ(hurt.reciprocity.size(), 1U) << told(hurt);
  EXPECT_NEAR(hurt.reciprocity[0].gain.value, 1.1, 0.02);
  EXPECT_GT(hurt.reciprocity[0].gain.value, 1 + 4 * hurt.reciprocity[0].gain.se);
}

TEST(IdentifyShapes, OneDirectResponseMayHaveComplexResidues) {
  const Plane damped{.modes = {{{1000, 0.02, 0.5, 20}, {1080, 0.02, 0.8, 110}}},
                     .damper = 200};
  const auto fit = identify_shapes(all_of(damped, {"xx"}), {.count = 2});
  ASSERT_TRUE(fit.ok) << told(fit);
  EXPECT_TRUE(fit.complex_shapes);
}

TEST(IdentifyShapes, NothingIsSaidOfNoise) {
  auto all = all_of(tilted, {"xx", "xy", "yy"}, {.band = coarse});
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (DirectedResponse& one : all) {
    for (auto& H : one.response.H) {
      const double re = normal(random);
      H = {1e-8 * re, 1e-8 * normal(random)};
    }
  }
  const auto fit = identify_shapes(all, {});
  EXPECT_FALSE(fit.ok);
  EXPECT_FALSE(fit.reason.empty());
  EXPECT_TRUE(fit.modes.empty());
}

}  // namespace trochoid::structure::identify_shapes_test
