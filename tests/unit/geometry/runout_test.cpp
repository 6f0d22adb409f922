#include "steps.h"

#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/edge.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace trochoid::geometry::runout_test {

constexpr double r = 5e-3;

EdgePosition exact(double rho, double c) {
  return edge_position({.eccentricity = rho}, r, c);
}

EdgePosition first(double rho, double c) {
  return edge_position({.eccentricity = rho, .order = EccentricityOrder::first}, r, c);
}

TEST(Runout, AnEccentricPointIsASumOfTwoVectors) {  // [G-9]
  for (const double c : steps(-4, 4, 0.13)) {
    for (const double rho : {1e-6, 80e-6, 2e-3}) {
      const EdgePosition p = exact(rho, c);
      EXPECT_NEAR(p.R * std::cos(p.epsilon), r + rho * std::cos(c), 1e-15);
      EXPECT_NEAR(p.R * std::sin(p.epsilon), rho * std::sin(c), 1e-15);
    }
  }
}

TEST(Runout, TheFirstOrderErrsByTheSquareOfTheEccentricity) {  // [G-9] [G-10]
  for (const double c : steps(0.1, 6.2, 0.2)) {
    const double rho = 40e-6;
    const double error = exact(rho, c).R - first(rho, c).R;
    const double half = exact(rho / 2, c).R - first(rho / 2, c).R;
    // leading term; the next is smaller by rho/r
    const double leading = rho * rho * std::sin(c) * std::sin(c) / (2 * r);
    EXPECT_NEAR(error, leading, leading * 2 * rho / r + 1e-17);
    EXPECT_NEAR(half, leading / 4, leading / 4 * rho / r + 1e-17);
    EXPECT_EQ(first(rho, c).epsilon, 0.0);
  }
}

TEST(Runout, ATurnIsItsSineOverTheRadius) {  // [G-9]
  const double rho = 1e-6;
  for (const double c : steps(0, 6.2, 0.3)) {
    EXPECT_NEAR(exact(rho, c).epsilon, rho * std::sin(c) / r, 2 * rho * rho / (r * r));
  }
}

TEST(Runout, WithoutEccentricityOnlyOffsetsStay) {
  const Runout runout{.radial_offsets = {0.0, -8e-6, 3e-6}};
  const std::vector<double> psi{0.0, 2.0, 4.0};
  std::vector<EdgePosition> at(3);
  edge_positions(runout, psi, r, 0.7, at);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(at[k].R, r + runout.radial_offsets[k]);
    EXPECT_EQ(at[k].epsilon, 0.0);
  }
}

TEST(Runout, OffsetsAndEccentricityAddUp) {  // [G-9]
  const Runout runout{
      .radial_offsets = {1e-6, -8e-6}, .eccentricity = 12e-6, .angle = 0.4};
  const std::vector<double> psi{0.0, std::numbers::pi};
  std::vector<EdgePosition> at(2);
  const double lag = 0.3;
  edge_positions(runout, psi, r, lag, at);
  for (std::size_t k = 0; k < 2; ++k) {
    const EdgePosition want = edge_position(runout, r + runout.radial_offsets[k],
                                            psi[k] + lag - runout.angle);
    EXPECT_EQ(at[k].R, want.R);
    EXPECT_EQ(at[k].epsilon, want.epsilon);
  }
  EXPECT_GT(at[0].R, at[1].R);  // the tooth next to lambda stands out
}

TEST(Runout, ItsDirectionCountsFromToothOneTowardsToothTwo) {
  const Runout runout{.eccentricity = 10e-6, .angle = 2.0};
  const std::vector<double> psi{0.0, 2.0, 4.0};
  std::vector<EdgePosition> at(3);
  edge_positions(runout, psi, r, 0.0, at);
  EXPECT_NEAR(at[1].R, r + 10e-6, 1e-15);
}

TEST(Runout, AToothWithoutARadiusLeavesNoMark) {
  const Runout runout{.radial_offsets = {0.0, -6e-3}, .eccentricity = 10e-6};
  const std::vector<double> psi{0.0, 3.0};
  std::vector<EdgePosition> at(2);
  edge_positions(runout, psi, r, 0.0, at);
  EXPECT_GT(at[0].R, 0.0);
  EXPECT_LE(at[1].R, 0.0);
}

}  // namespace trochoid::geometry::runout_test
