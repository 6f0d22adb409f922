// Responses of many lines: fewer of them tell the same, soon.
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/thinned.h>

#include "made_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <ctime>
#include <numbers>
#include <random>
#include <string>
#include <vector>

namespace trochoid::structure::thinned_test {

using made::Hz;

const std::vector<Mode>& four() {
  static const std::vector<Mode> modes{
      made::mode_of(300, 0.012, 50), made::mode_of(870, 0.02, 5),
      made::mode_of(1500, 0.035, 2), made::mode_of(2800, 0.025, 0.4)};
  return modes;
}

/// Residues turned by an angle each, in degrees.
FrequencyResponse turned(const std::vector<Mode>& modes, const std::vector<double>& by,
                         made::Band band, double noise) {
  FrequencyResponse out;
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (double f = band.from; f <= band.to; f += band.step) {
    const std::complex<double> s(0, f * Hz);
    std::complex<double> H;
    for (std::size_t r = 0; r < modes.size(); ++r) {
      const double omega = std::sqrt(modes[r].stiffness / modes[r].mass);
      const double sigma = modes[r].damping / modes[r].mass / 2;
      const double damped = std::sqrt(omega * omega - sigma * sigma);
      const std::complex<double> residue =
          std::polar(1 / modes[r].mass, by[r] * std::numbers::pi / 180) /
          std::complex<double>(0, 2 * damped);
      H += residue / (s - std::complex<double>(-sigma, damped)) +
           std::conj(residue) / (s - std::complex<double>(-sigma, -damped));
    }
    const double re = normal(random);
    out.omega.push_back(f * Hz);
    out.H.push_back(H * (1.0 + noise * std::complex<double>(re, normal(random))));
  }
  return out;
}

TEST(Thinned, KeepsWhatTheBandNeeds) {  // [M-35]
  const auto lines = made::response(four(), ResponseKind::receptance, {50, 5000, 0.25},
                                    {.fraction = 0.02});
  const FrequencyResponse few = thinned(lines, for_a_search.tolerance);
  EXPECT_LT(few.omega.size(), 1000U);
  EXPECT_GT(few.omega.size(), 100U);
  ASSERT_EQ(few.averaged.size(), few.omega.size());
  for (std::size_t i = 0; i < few.omega.size(); ++i) {
    std::complex<double> H;
    for (const Mode& mode : four()) H += receptance(mode, few.omega[i]);
    // a mean of n lines scatters by 1/sqrt(n), its bias is small beside that
    EXPECT_LT(std::abs(few.H[i] - H), 0.02 * 5 / few.calmer(i) * std::abs(H))
        << few.omega[i] / Hz << " Hz, of " << few.averaged[i];
    if (i > 0) {
      EXPECT_GT(few.omega[i], few.omega[i - 1]);
    }
  }
}

TEST(Thinned, WithoutNoiseLinesAreTakenAsTheyAre) {  // [M-35]
  const auto lines = made::response(four(), ResponseKind::accelerance, {50, 5000, 0.5});
  const FrequencyResponse few = thinned(lines, for_a_search.tolerance);
  EXPECT_LT(few.omega.size(), lines.omega.size() / 8);
  for (std::size_t i = 0; i < few.omega.size(); ++i) {
    std::complex<double> H;
    for (const Mode& mode : four()) H += receptance(mode, few.omega[i]);
    H *= factor(ResponseKind::accelerance, few.omega[i]);
    EXPECT_LT(std::abs(few.H[i] - H), 1e-6 * std::abs(H)) << few.omega[i] / Hz;
  }
}

TEST(IdentifyModes, OfManyLinesTakesNotLong) {
  const auto lines = made::response(four(), ResponseKind::receptance, {50, 5000, 0.25},
                                    {.fraction = 0.02});
  const std::clock_t start = std::clock();
  const ModesFit fit = identify_modes(lines, {});
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ASSERT_TRUE(fit.ok) << fit.reason;
  ASSERT_EQ(fit.modes.size(), 4U);
  for (std::size_t r = 0; r < 4; ++r) {
    const FittedMode& m = fit.modes[r];
    EXPECT_NEAR(m.mass.value, four()[r].mass, 4 * m.mass.se);
    EXPECT_NEAR(m.stiffness.value, four()[r].stiffness, 4 * m.stiffness.se);
    EXPECT_LT(m.stiffness.se, 0.005 * m.stiffness.value);
  }
  EXPECT_EQ(fit.responses.front().fitted.size(), lines.omega.size());
  EXPECT_LT(seconds, 10.0) << "half a second, on a machine that does nothing else";
}

TEST(ComplexCheck, NamesTurnedResidues) {  // [M-30]
  for (const double angle : {-20.0, -10.0, 10.0, 20.0}) {
    const auto lines =
        turned({made::mode_of(800, 0.03, 1)}, {angle}, {300, 2000, 2}, 0.005);
    const auto check = complex_check(identify_modes(lines, {}));
    ASSERT_TRUE(check) << angle;
    EXPECT_TRUE(check->complex()) << angle;
    EXPECT_EQ(check->fit.modes.size(), 1U) << angle;
  }
}

TEST(ComplexCheck, CountsComplexModesAsOneEach) {  // [M-30]
  const auto lines = turned(four(), {12, -15, 10, -8}, {50, 5000, 2.5}, 0.02);
  const auto check = complex_check(identify_modes(lines, {}));
  ASSERT_TRUE(check);
  EXPECT_TRUE(check->complex());
  EXPECT_EQ(check->fit.modes.size(), 4U);
}

TEST(ComplexCheck, LeavesRealModesReal) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const auto lines = made::response(four(), ResponseKind::receptance, {50, 5000, 2.5},
                                      {.fraction = 0.02}, seed);
    const auto check = complex_check(identify_modes(lines, {}));
    EXPECT_FALSE(check && check->complex()) << seed;
  }
}

/// A response as files have it: six digits.
FrequencyResponse rounded(FrequencyResponse lines) {
  const auto digits = [](double value) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) - 5);
    return std::round(value / unit) * unit;
  };
  for (auto& H : lines.H) H = {digits(H.real()), digits(H.imag())};
  return lines;
}

TEST(IdentifyModes, OfANoiseFreeFileIsWithoutWarnings) {
  for (const auto kind : {ResponseKind::receptance, ResponseKind::accelerance}) {
    const auto lines =
        rounded(made::response({made::mode_of(159.155, 0.02, 1)}, kind, {1, 500, 1}));
    const ModesFit fit = identify_modes(lines, {});
    ASSERT_TRUE(fit.ok) << fit.reason;
    EXPECT_EQ(fit.modes.size(), 1U);
    EXPECT_TRUE(fit.left_out.empty()) << fit.left_out.front();
    const auto check = complex_check(fit);
    EXPECT_FALSE(check && check->complex());
  }
}

TEST(IdentifyModes, SaysBeforeTheSearchThatASensorPointsTheOtherWay) {
  auto lines = made::response(four(), ResponseKind::accelerance, {50, 5000, 1},
                              {.fraction = 0.02});
  for (auto& H : lines.H) H = -H;
  const ModesFit fit = identify_modes(lines, {});
  EXPECT_FALSE(fit.ok);
  EXPECT_TRUE(fit.orders.empty()) << "nothing was searched";
  EXPECT_NE(fit.reason.find("against the force"), std::string::npos) << fit.reason;
}

}  // namespace trochoid::structure::thinned_test
