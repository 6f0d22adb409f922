#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/turn_matrix.h>

#include <cmath>

namespace trochoid::identification::turn_matrix_test {

force::Setup with_offset(double helix_deg) {
  force::Setup setup = slot_setup(2, helix_deg, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

/// A series at one angle, shape (width).
std::vector<double> value(const std::vector<double>& coefficients, std::size_t width,
                          double phi) {
  std::vector<double> out(coefficients.begin(),
                          coefficients.begin() + static_cast<std::ptrdiff_t>(width));
  for (std::size_t row = 1; row < coefficients.size() / width; ++row) {
    const double x = static_cast<double>((row + 1) / 2) * phi;
    const double wave = row % 2 == 1 ? std::cos(x) : std::sin(x);
    for (std::size_t c = 0; c < width; ++c) {
      out[c] += wave * coefficients[row * width + c];
    }
  }
  return out;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double out = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    out = std::max(out, std::abs(a[i] - b[i]));
  }
  return out;
}

TEST(TurnMatrix, SeriesIsTheMatrix) {
  const force::ForceMatrix matrix(with_offset(30.0), steel(), 1e-8);
  const TurnMatrix turn = turn_matrix(matrix, {512, 200, false});
  double largest = 0.0;
  std::vector<double> C(18);
  for (const double phi : {0.3, 1.7, 4.4}) {
    matrix.evaluate({&phi, 1}, C);
    for (const double c : C) largest = std::max(largest, std::abs(c));
    // The kinks of an edge that enters leave 1/m^2 of the harmonics that are missing.
    EXPECT_LT(largest_difference(value(turn.coefficients, 18, phi), C), 3e-3 * largest);
  }
}

TEST(TurnMatrix, APhaseIsARotation) {  // [I-10]
  const force::ForceMatrix matrix(with_offset(30.0), steel(), 1e-8);
  const TurnMatrix turn = turn_matrix(matrix, {128, 40, false});
  const std::vector<double> turned = at_phase(turn, 0.7);
  EXPECT_LT(
      largest_difference(value(turned, 18, 1.1), value(turn.coefficients, 18, 1.8)),
      1e-15);
  const double d = 1e-5;
  std::vector<double> slope = at_phase(turn, 0.7 + d);
  const std::vector<double> behind = at_phase(turn, 0.7 - d);
  double largest = 0.0;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    slope[i] = (slope[i] - behind[i]) / (2.0 * d);
    largest = std::max(largest, std::abs(slope[i]));
  }
  // Third derivatives: 40^2 d^2/6 of the slope.
  EXPECT_LT(largest_difference(slope, slope_at_phase(turn, 0.7)), 1e-7 * largest);
}

/// With jumps found, few angles give what very many do without.
TEST(TurnMatrix, JumpsOfAStraightEdgeAreFound) {
  const force::ForceMatrix matrix(with_offset(0.0), steel(), 1e-8);
  const TurnMatrix many = turn_matrix(matrix, {65536, 12, false});
  const TurnMatrix few = turn_matrix(matrix, {256, 12, true});
  const TurnMatrix blind = turn_matrix(matrix, {256, 12, false});
  const double found = largest_difference(few.coefficients, many.coefficients);
  const double missed = largest_difference(blind.coefficients, many.coefficients);
  // What is left are the lines between jumps: of second order in the step.
  EXPECT_LT(found, 0.1 * missed);
  const std::vector<double> jumps = jump_angles(matrix, 256);
  ASSERT_GE(jumps.size(), 2U);
  std::vector<double> before(18);
  std::vector<double> after(18);
  for (const double jump : jumps) {
    const double a = jump - 1e-6;
    const double b = jump + 1e-6;
    matrix.evaluate({&a, 1}, before);
    matrix.evaluate({&b, 1}, after);
    EXPECT_GT(largest_difference(before, after), 1e-4) << jump;
  }
}

}  // namespace trochoid::identification::turn_matrix_test
