#include <gtest/gtest.h>
#include <trochoid/identification/waves.h>
#include <trochoid/numerics/least_squares.h>

#include <cmath>
#include <random>

namespace trochoid::identification::waves_test {

/// Angles and weights of a run, with a gap of that part of the turn.
struct Angles {
  std::vector<double> angle;
  std::vector<double> weight;

  Angles(std::size_t count, double gap) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> turn(0.0, 2.0 * M_PI * (1.0 - gap));
    std::uniform_real_distribution<double> heavy(0.5, 2.0);
    for (std::size_t g = 0; g < count; ++g) {
      angle.push_back(turn(random));
      weight.push_back(heavy(random));
    }
  }

  [[nodiscard]] WeightedAngles all() const { return {angle, weight}; }

  /// By its definition.
  [[nodiscard]] double wave(std::size_t i, std::size_t g) const {
    const auto m = static_cast<double>((i + 1) / 2);
    return i % 2 == 0 && i > 0 ? std::sin(m * angle[g]) : std::cos(m * angle[g]);
  }
};

/// Columns of random numbers.
std::vector<double> random_columns(std::size_t rows, std::size_t count) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  std::vector<double> out(rows * count);
  for (double& v : out) v = normal(random);
  return out;
}

TEST(Waves, ProductsAreSumsOverTheAngles) {
  const Angles at(301, 0.0);  // no whole number of stretches
  const std::vector<double> X = random_columns(301, 3);
  const std::vector<double> found = wave_products(at.angle, {X, 301}, 41);
  for (std::size_t i = 0; i < 41; ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0.0;
      for (std::size_t g = 0; g < 301; ++g) sum += at.wave(i, g) * X[c * 301 + g];
      EXPECT_NEAR(found[3 * i + c], sum, 1e-11);
    }
  }
}

TEST(Waves, SumsAreThoseOfTheirAmplitudes) {
  const Angles at(301, 0.0);
  const std::vector<double> a = random_columns(9, 1);
  const std::vector<double> found = sum_of_waves(at.angle, a);
  for (std::size_t g = 0; g < 301; ++g) {
    double sum = 0.0;
    for (std::size_t i = 0; i < 9; ++i) sum += a[i] * at.wave(i, g);
    EXPECT_NEAR(found[g], sum, 1e-13);
  }
}

/// The columns of a basis: what unit coordinates stand for, times the weight.
std::vector<std::vector<double>> columns_of(const WaveBasis& basis, const Angles& at) {
  std::vector<std::vector<double>> out;
  for (std::size_t k = 0; k < basis.size; ++k) {
    std::vector<double> unit(basis.size, 0.0);
    unit[k] = 1.0;
    out.push_back(from_coordinates(basis, at.all(), unit));
    for (std::size_t g = 0; g < at.angle.size(); ++g) out.back()[g] *= at.weight[g];
  }
  return out;
}

/// Basis, coordinates and map of a band against what defines them.
void expect_basis(const Angles& at, int harmonics, double tolerance) {
  const std::size_t u = at.angle.size();
  const std::size_t terms = 2 * static_cast<std::size_t>(harmonics) + 9;
  const WaveBasis basis = wave_basis(at.all(), harmonics);
  const auto E = columns_of(basis, at);
  ASSERT_EQ(E.size(), 2 * static_cast<std::size_t>(harmonics) + 1);
  const std::vector<double> x = random_columns(u, 1);
  const std::vector<double> found = coordinates(basis, at.all(), {x, u});
  const std::vector<double> map = band_by_waves(basis, at.all(), terms);
  for (std::size_t k = 0; k < E.size(); ++k) {
    for (std::size_t j = 0; j <= k; ++j) {
      EXPECT_NEAR(numerics::dot(E[k], E[j]), k == j ? 1.0 : 0.0, tolerance);
    }
    double sum = 0.0;
    for (std::size_t g = 0; g < u; ++g) sum += E[k][g] * at.weight[g] * x[g];
    EXPECT_NEAR(found[k], sum, 10 * tolerance);
    for (std::size_t m = 0; m < terms; ++m) {  // [I-11]
      double t = 0.0;
      for (std::size_t g = 0; g < u; ++g) t += E[k][g] * at.weight[g] * at.wave(m, g);
      EXPECT_NEAR(map[k * terms + m], t, 10 * tolerance);
    }
  }
}

TEST(Waves, ABasisIsOrthonormalOverTheWeightedAngles) {
  const Angles at(500, 0.0);
  EXPECT_TRUE(wave_basis(at.all(), 12).by_root());
  expect_basis(at, 12, 1e-11);
}

TEST(Waves, WhereAnglesLeaveAGapTheBasisComesFromTheWavesThemselves) {
  const Angles at(500, 0.4);
  EXPECT_FALSE(wave_basis(at.all(), 12).by_root());
  expect_basis(at, 12, 1e-11);
}

TEST(Waves, AmplitudesAreThoseOfTheLeastSquares) {
  const Angles at(400, 0.0);
  const std::vector<double> x = random_columns(400, 1);
  const WaveBasis basis = wave_basis(at.all(), 4);
  const std::vector<double> a =
      amplitudes(basis, coordinates(basis, at.all(), {x, 400}), 1);
  std::vector<double> W(400 * 9);
  std::vector<double> wx;
  for (std::size_t g = 0; g < 400; ++g) {
    for (std::size_t i = 0; i < 9; ++i) W[9 * g + i] = at.weight[g] * at.wave(i, g);
    wx.push_back(at.weight[g] * x[g]);
  }
  const auto fit = numerics::least_squares(W, 9, wx, 1e-12);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(a[i], fit.x[i], 1e-12);
}

}  // namespace trochoid::identification::waves_test
