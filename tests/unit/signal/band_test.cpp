#include <gtest/gtest.h>
#include <trochoid/signal/band.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

namespace trochoid::signal::band_test {

constexpr double turn = 2.0 * std::numbers::pi;

std::vector<double> angles(int n, double a_turn) {
  std::vector<double> out;
  for (int i = 0; i < n; ++i) out.push_back(0.3 + i * turn / a_turn);
  return out;
}

double value(double phi) {
  return 3.0 + 2.0 * std::cos(phi) - 1.5 * std::sin(2.0 * phi) +
         0.5 * std::cos(3.0 * phi);
}

// [S-5]
TEST(Band, KeepsWhatLiesInIt) {
  // Whole turns, parts of turns, uneven steps.
  for (const double a_turn : {100.0, 77.7, 133.3}) {
    auto phi = angles(250, a_turn);
    phi[7] += 0.01;
    std::vector<double> y(phi.size());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] = value(phi[i]);
    const Band band(phi, 3);
    EXPECT_EQ(band.size(), 7);
    const auto kept = band.project(y);
    for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(kept[i], y[i], 1e-12);
  }
}

TEST(Band, DropsHigherHarmonicsOfWholeTurns) {
  const auto phi = angles(400, 100.0);
  std::vector<double> y(phi.size());
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = value(phi[i]) + 9.0 * std::sin(4.0 * phi[i]) + 5.0 * std::cos(20.0 * phi[i]);
  }
  const auto kept = Band(phi, 3).project(y);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_NEAR(kept[i], value(phi[i]), 1e-12);
}

TEST(Band, HasCoordinatesThatKeepLengthsAndAngles) {
  const auto phi = angles(333, 91.0);
  std::mt19937 random(5);
  std::normal_distribution<double> white;
  std::vector<double> a(phi.size());
  std::vector<double> b(phi.size());
  for (auto& x : a) x = white(random);
  for (auto& x : b) x = white(random);
  const Band band(phi, 5);
  const auto ca = band.coordinates(a);
  const auto cb = band.coordinates(b);
  const auto pa = band.project(a);
  EXPECT_NEAR(std::inner_product(ca.begin(), ca.end(), cb.begin(), 0.0),
              std::inner_product(pa.begin(), pa.end(), b.begin(), 0.0), 1e-10);
  const auto again = band.project(pa);
  for (std::size_t i = 0; i < pa.size(); ++i) EXPECT_NEAR(again[i], pa[i], 1e-12);
}

TEST(Band, CountsOnlyWhatTheAnglesTellApart) {
  // 8 samples a turn: sin 4 phi' is constant up to its phase, 5 looks like 3.
  EXPECT_EQ(Band(angles(80, 8.0), 3).size(), 7);
  EXPECT_EQ(Band(angles(80, 8.0), 6).size(), 8);
  EXPECT_EQ(Band(angles(3, 8.0), 6).size(), 3);
  EXPECT_EQ(Band(angles(5, 8.0), 0).size(), 1);
}

TEST(Band, RefusesNoAnglesAndOtherLengths) {
  const std::vector<double> none;
  EXPECT_THROW(Band(none, 1), std::invalid_argument);
  EXPECT_THROW(Band(angles(5, 5.0), -1), std::invalid_argument);
  EXPECT_THROW(Band(angles(5, 5.0), 1).project(none), std::invalid_argument);
}

}  // namespace trochoid::signal::band_test
