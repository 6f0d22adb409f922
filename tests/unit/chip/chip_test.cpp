#include "made_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::chip::chip_test {

constexpr std::array models{Model::none, Model::feed, Model::radial, Model::trochoidal};

TEST(Chip, ZeroRunoutGivesEqualTeeth) {  // [C-1] [C-2] [C-3] [C-4]
  for (const int teeth : {1, 2, 3, 5}) {
    MadeSlice s = made_slice(10e-3, teeth, 60e-6);
    for (const Model model : models) {
      s.model.model = model;
      for (const double theta : steps(-1.5, 4.6, 0.05)) {
        for (int j = 1; j < teeth; ++j) {
          EXPECT_NEAR(s.h(j, theta), s.h(0, theta), 1e-17);
        }
      }
    }
  }
}

TEST(Chip, SimpleModelsAreTheFeedTimesTheSine) {  // [C-2] [C-3] [C-4]
  MadeSlice s = made_slice(10e-3, 2, 60e-6);
  for (const Model model : {Model::none, Model::feed, Model::radial}) {
    s.model.model = model;
    for (const double theta : steps(-1.5, 4.6, 0.05)) {
      EXPECT_NEAR(s.h(1, theta), std::max(0.0, 60e-6 * std::sin(theta)), 1e-17);
    }
  }
}

TEST(Chip, TheExactChipDiffersBySecondOrderOfTheFeed) {  // [C-5] [C-6] [C-7]
  // h = f_m sin + f_m^2 cos^2 / 2 R - f f_m sin cos / 2 pi R (docs/theory/chip.md)
  const double R = 5e-3;
  const double f_z = 20e-6;
  const MadeSlice s = made_slice(2 * R, 2, f_z);
  for (const double theta : steps(0.3, 2.9, 0.1)) {
    const double c = std::cos(theta);
    const double second = f_z * f_z * c * c / (2 * R) -
                          2 * f_z * f_z * std::sin(theta) * c / (2 * pi * R);
    EXPECT_NEAR(s.h(0, theta), f_z * std::sin(theta) + second,
                20 * f_z * f_z * f_z / (R * R));
  }
}

/// How far from the axis a tooth that cut so much earlier left the stock on a ray: the place
/// where its path crosses it, by halving. The path is a circle that turns to the left.
double left_by_path(double R, double theta_p, double feed, double rho, double theta) {
  const auto edge = [&](double delta) {
    const double turned = feed * (theta_p + delta) / rho;
    return std::array{-rho * std::sin(turned) + R * std::sin(theta - delta),
                      rho * (1 - std::cos(turned)) + R * std::cos(theta - delta)};
  };
  const auto aside = [&](double delta) {
    const auto [x, y] = edge(delta);
    return x * std::cos(theta) - y * std::sin(theta);
  };
  double lo = -1.0;
  double hi = 1.0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (lo + hi);
    ((aside(middle) > 0) == (aside(lo) > 0) ? lo : hi) = middle;
  }
  const auto [x, y] = edge(lo);
  return x * std::sin(theta) + y * std::cos(theta);
}

TEST(Chip, OnATightCircleIsThatOfThePathOfTheTeeth) {  // [N-29]
  MadeSlice s = made_slice(10e-3, 2, 0.25e-3, {.radial_offsets = {0.0, -20e-6}});
  const double rho = 1e-3;
  s.cut.engagement = geometry::Arcs{{{0.0, 1e-3, {{{0.0, pi}, {}, {}}}}}, 1 / rho};
  Passage passage = s.passage();
  passage.by_arcs = false;
  for (const double theta : steps(0.3, 2.9, 0.1)) {
    for (int m = 1; m <= 2; ++m) {
      const double R = s.teeth[m == 1 ? 1 : 0].R;
      const double left = left_by_path(R, m * pi, passage.feed, rho, theta);
      EXPECT_NEAR(chip_over_mark(passage, s.slice(), 0, theta, m), s.teeth[0].R - left,
                  1e-12);
    }
  }
}

TEST(Chip, OffsetsShiftTheRadialChipAndScaleTheFeedChip) {  // [C-3] [C-4]
  MadeSlice s = made_slice(10e-3, 2, 60e-6, {.radial_offsets = {0.0, 4e-6}});
  const double theta = 1.1;
  s.model.model = Model::feed;
  EXPECT_NEAR(s.h(1, theta), 64e-6 * std::sin(theta), 1e-17);
  EXPECT_NEAR(s.h(0, theta), 56e-6 * std::sin(theta), 1e-17);
  s.model.model = Model::radial;
  EXPECT_NEAR(s.h(1, theta), 60e-6 * std::sin(theta) + 4e-6, 1e-17);
  EXPECT_NEAR(s.h(0, theta), 60e-6 * std::sin(theta) - 4e-6, 1e-17);
}

TEST(Chip, NothingIsCutWithoutFeed) {
  for (const auto& offsets : {std::vector<double>{}, {0.0, 5e-6, -3e-6}}) {
    MadeSlice s = made_slice(10e-3, 3, 0.0, {.radial_offsets = offsets});
    for (const Model model : models) {
      s.model.model = model;
      for (const double theta : steps(-1.5, 4.6, 0.01)) {
        for (int j = 0; j < 3; ++j) {
          EXPECT_EQ(s.h(j, theta), 0.0);
        }
      }
    }
  }
}

TEST(Chip, AToothShorterThanItsFeedIsIdleAndItsNeighbourDoesItsWork) {
  // [C-3] [C-4] [C-7]
  MadeSlice s = made_slice(10e-3, 3, 30e-6, {.radial_offsets = {0.0, 0.0, -70e-6}});
  for (const Model model : {Model::feed, Model::radial, Model::trochoidal}) {
    s.model.model = model;
    for (const double theta : steps(-1.5, 4.6, 0.01)) {
      EXPECT_EQ(s.h(2, theta), 0.0);
    }
    EXPECT_NEAR(s.h(0, pi / 2), 60e-6, 1e-8);
    EXPECT_NEAR(s.h(1, pi / 2), 30e-6, 1e-8);
  }
}

TEST(Chip, AToothMeetsItsOwnMarkWhereTheOthersAreTooShort) {  // [C-3] [C-4]
  MadeSlice s = made_slice(10e-3, 2, 50e-6, {.radial_offsets = {200e-6, 0.0}});
  for (const Model model : {Model::feed, Model::radial, Model::trochoidal}) {
    s.model.model = model;
    EXPECT_NEAR(s.h(0, pi / 2), 100e-6, 1e-8);
    EXPECT_EQ(s.h(1, pi / 2), 0.0);
  }
}

TEST(Chip, LookingBackAtMoreTeethNeverMakesItThicker) {
  std::mt19937 random(3);
  for (int n = 0; n < 30; ++n) {
    MadeSlice s = random_slice(random, 50e-6);
    for (const Model model : {Model::feed, Model::trochoidal}) {
      s.model.model = model;
      for (const double theta : steps(-0.2, 3.4, 0.09)) {
        for (int j = 0; j < s.cutter.teeth(); ++j) {
          s.model.lookback = Lookback::previous;
          const double previous = s.h(j, theta);
          s.model.lookback = Lookback::all;
          EXPECT_LE(s.h(j, theta), previous + 1e-18);
        }
      }
    }
  }
}

TEST(Chip, AToothThatComesLaterIsOneOfAnotherPitch) {  // [C-5] [G-1]
  std::mt19937 random(4);
  for (int n = 0; n < 30; ++n) {
    const MadeSlice late = random_slice(random, 200e-6);
    MadeSlice uneven = late;
    const std::size_t N = late.teeth.size();
    for (std::size_t k = 0; k < N; ++k) {
      uneven.cutter.pitch[k] -= late.teeth[(k + 1) % N].epsilon - late.teeth[k].epsilon;
      uneven.teeth[k].epsilon = 0.0;
    }
    for (std::size_t j = 0; j < N; ++j) {
      const int tooth = static_cast<int>(j);
      for (const double theta : steps(-0.2, 3.4, 0.11)) {
        EXPECT_NEAR(late.h(tooth, theta),
                    uneven.h(tooth, theta + late.teeth[j].epsilon), 1e-15);
      }
    }
  }
}

TEST(Chip, UnequalPitchesShareTheFeed) {  // [C-1]
  MadeSlice s = made_slice(10e-3, 3, 40e-6);
  s.model.model = Model::none;
  s.cutter.pitch = {1.5, 2.0, 2 * pi - 3.5};
  const double feed = 3 * 40e-6;
  EXPECT_NEAR(s.h(1, pi / 2), feed * 1.5 / (2 * pi), 1e-17);
  EXPECT_NEAR(s.h(2, pi / 2), feed * 2.0 / (2 * pi), 1e-17);
  EXPECT_NEAR(s.h(0, pi / 2), feed * (2 * pi - 3.5) / (2 * pi), 1e-17);
}

TEST(Chip, StockBoundsTheChip) {  // [C-7] [G-11]
  MadeSlice s = made_slice(10e-3, 2, 50e-6);
  s.cut.engagement = geometry::Band{-1e-3, 2e-3};
  for (const double theta : steps(0.05, 3.1, 0.05)) {
    const double y = 5e-3 * std::cos(theta);
    if (y > -1e-3 && y < 2e-3) {
      EXPECT_GT(s.h(0, theta), 0.0);
    } else if (y < -1.1e-3 || y > 2.1e-3) {
      EXPECT_EQ(s.h(0, theta), 0.0);
    }
  }
}

}  // namespace trochoid::chip::chip_test
