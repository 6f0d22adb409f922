#include "../unit/structure/made_response.h"

#include <gtest/gtest.h>
#include <trochoid/structure/identify_modes.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

/// How often 95 % intervals hold the modes that a response was made from.
namespace trochoid::structure {
namespace {

using made::mode_of;

struct Structure {
  std::vector<Mode> modes;  ///< those inside the band, then the others
  std::size_t inside = 0;   ///< how many
  made::Band band;
  ResponseKind kind = ResponseKind::accelerance;
};

/// Two modes of a tool, 2.5 Hz apart the lines.
Structure tool() {
  return {.modes = {mode_of(900, 0.028, 0.6), mode_of(2500, 0.025, 0.032)},
          .inside = 2,
          .band = {200, 4000, 2.5}};
}

Structure close_pair() {
  return {.modes = {mode_of(1000, 0.02, 1.0), mode_of(1040, 0.02, 1.0)},
          .inside = 2,
          .band = {600, 1500, 1},
          .kind = ResponseKind::receptance};
}

/// One mode in the band, one on either side of it.
Structure among_others(double step) {
  return {.modes = {mode_of(900, 0.03, 0.5), mode_of(90, 0.03, 4.0),
                    mode_of(6000, 0.02, 0.05)},
          .inside = 1,
          .band = {400, 1800, step},
          .kind = ResponseKind::receptance};
}

constexpr std::array names = {"frequency", "damping_ratio", "mass", "stiffness",
                              "damping"};

bool holds(const Known& known, double truth) {
  return std::abs(known.value - truth) <= 1.96 * known.se;
}

/// Six modes in 451 lines, four of them within 300 Hz.
Structure many() {
  return {.modes = {mode_of(1431.5, 0.027, 0.546), mode_of(1857, 0.03, 1.932),
                    mode_of(1974.2, 0.0232, 0.4034), mode_of(2063.4, 0.015, 1.5034),
                    mode_of(2155.6, 0.01527, 1.7826), mode_of(2777.8, 0.00986, 1.4909)},
          .inside = 6,
          .band = {300, 3000, 6},
          .kind = ResponseKind::receptance};
}

/// How often each number is held, and of how many modes that were found.
struct Count {
  std::array<int, names.size()> held{};
  int modes = 0;
  int wrong_number = 0;  ///< responses in which not all modes were found, or more
};

Count counted(const Structure& made_of, made::Noise noise, int seeds) {
  Count count;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto fit =
        identify_modes(made::response(made_of.modes, made_of.kind, made_of.band, noise,
                                      static_cast<unsigned>(seed)),
                       {});
    if (!fit.ok || fit.modes.size() != made_of.inside) {
      ++count.wrong_number;
      continue;
    }
    for (std::size_t r = 0; r < made_of.inside; ++r) {
      const FittedMode& m = fit.modes[r];
      const Mode& truth = made_of.modes[r];
      const std::array held = {
          holds(m.omega, natural_frequency(truth)), holds(m.zeta, damping_ratio(truth)),
          holds(m.mass, truth.mass), holds(m.stiffness, truth.stiffness),
          holds(m.damping, truth.damping)};
      for (std::size_t k = 0; k < held.size(); ++k) {
        count.held[k] += held[k] ? 1 : 0;
      }
      ++count.modes;
    }
  }
  return count;
}

/// TROCHOID_SEEDS asks for more than the few of a quick test.
int seeds() {
#ifdef __SANITIZE_ADDRESS__
  constexpr int few = 1;
#else
  constexpr int few = 5;
#endif
  const char* asked = std::getenv("TROCHOID_SEEDS");
  return asked != nullptr ? std::atoi(asked) : few;
}

void expect_held(const Structure& made_of, made::Noise noise) {
  const int n = seeds();
  const Count count = counted(made_of, noise, n);
  EXPECT_LE(count.wrong_number, 0.1 * n);
  // 90 %, less three deviations of a count of so many modes.
  const double least = 0.9 * count.modes - 3 * std::sqrt(0.9 * 0.1 * count.modes);
  for (std::size_t k = 0; k < names.size(); ++k) {
    EXPECT_GE(count.held[k], least) << names[k] << " of " << count.modes;
    testing::Test::RecordProperty(names[k], count.held[k]);
  }
  testing::Test::RecordProperty("modes", count.modes);
  testing::Test::RecordProperty("wrong_number", count.wrong_number);
}

TEST(ModesCoverage, UnderAFloor) {  // [M-7]
  expect_held(tool(), {.floor = 0.01});
}

TEST(ModesCoverage, UnderNoiseInProportion) {  // [M-15] [M-16]
  expect_held(tool(), {.fraction = 0.03});
}

TEST(ModesCoverage, UnderNoiseOfTheMagnitudeAndAFloor) {  // [M-15]
  expect_held(tool(), {.floor = 0.002, .magnitude = 0.05});
}

TEST(ModesCoverage, OfModesHalfAPeakApart) {  // [M-17]
  expect_held(close_pair(), {.floor = 0.02});
}

TEST(ModesCoverage, OfModesHalfAPeakApartInProportion) {  // [M-17]
  expect_held(close_pair(), {.fraction = 0.05});
}

TEST(ModesCoverage, BetweenModesOutsideOfTheBand) {  // [M-6]
  expect_held(among_others(2), {.fraction = 0.03});
}

/// The thinned lines of a search tell as many modes apart as all lines would.
TEST(ModesCoverage, OfManyModesInNoise) {  // [M-16] [M-35]
  expect_held(many(), {.fraction = 0.02});
}

/// Thinned lines still tell of the modes outside, without which the mass is wrong.
TEST(ModesCoverage, BetweenModesOutsideOfTheBandInManyLines) {  // [M-6] [M-35]
  expect_held(among_others(0.25), {.fraction = 0.03});
}

}  // namespace
}  // namespace trochoid::structure
