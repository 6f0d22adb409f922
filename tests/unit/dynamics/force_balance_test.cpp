#include <trochoid/dynamics/force_balance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace trochoid::dynamics::force_balance_test {

using Plane = std::array<double, 2>;

/// A tooth whose chip is h_0 - n . q, with force -K h^m d on a tool that moves by P F.
struct Touch {
  double h_0 = 0.0;
  Plane n{};  ///< outwards
  Plane d{};  ///< of the force
  double K = 0.0;
  double m = 1.0;
};

Response response(const std::vector<Touch>& teeth, const Plane& q) {
  Response r;
  for (const Touch& t : teeth) {
    const double h = t.h_0 + t.n[0] * q[0] + t.n[1] * q[1];
    if (h <= 0) continue;
    const double F = t.K * std::pow(h, t.m);
    for (std::size_t a = 0; a < 2; ++a) {
      r.F[a] -= F * t.d[a];
      r.per_q[2 * a] -= F * t.m / h * t.d[a] * t.n[0];
      r.per_q[2 * a + 1] -= F * t.m / h * t.d[a] * t.n[1];
    }
  }
  return r;
}

TEST(BalancedForce, IsFoundWhateverTheCompliance) {  // [T-12]
  std::mt19937 random(5);
  std::uniform_real_distribution<double> even(0.0, 1.0);
  const auto power = [&](double low, double high) {
    return low * std::pow(high / low, even(random));
  };
  int touching = 0;
  for (int n = 0; n < 4000; ++n) {
    const Plane q_0 = {20e-6 * (even(random) - 0.5), 20e-6 * (even(random) - 0.5)};
    const double p = power(1e-14, 1e-7);
    std::vector<Touch> teeth;
    for (int j = 0; j < 1 + n % 3; ++j) {
      const double theta = 6.28 * even(random);
      const double radial = even(random);
      const Plane n_j = {std::sin(theta), std::cos(theta)};
      const Plane d_j = {n_j[0] * radial - n_j[1], n_j[1] * radial + n_j[0]};
      const double m = 0.3 + 0.7 * even(random);
      const double strength = power(1e-4, 1.0);  // of the feedback at a chip of 5 um
      const double K = strength / (p * m * std::pow(5e-6, m - 1));
      teeth.push_back(
          {.h_0 = 10e-6 * (even(random) - 0.5), .n = n_j, .d = d_j, .K = K, .m = m});
    }
    const std::array<double, 3> P = {p, 0.0, p * (0.5 + even(random))};
    const auto response_of = [&](const Force& F) {
      return response(teeth, {q_0[0] + P[0] * F[0], q_0[1] + P[2] * F[1]});
    };
    const ForceBalance found = balanced_force(response_of, {P, {}}, {}, 1e-14);
    EXPECT_LE(found.motion_error, 1e-12) << n;
    touching += std::hypot(found.F[0], found.F[1]) > 0 ? 1 : 0;
  }
  EXPECT_GT(touching, 1000);
}

TEST(BalancedForce, OfAJumpIsOneOfBoth) {  // [T-12]
  const std::array<double, 3> P = {1e-9, 0.0, 1e-9};
  const auto pushed_out = [&](const Force& F) {  // touches without a force only
    Response r;
    r.F[0] = P[0] * F[0] > -1e-9 ? -10.0 : 0.0;
    return r;
  };
  const ForceBalance found = balanced_force(pushed_out, {P, {}}, {}, 1e-14);
  EXPECT_LE(found.force_error, 10.0);
  EXPECT_NEAR(P[0] * found.F[0], -1e-9, 10e-9);
}

}  // namespace trochoid::dynamics::force_balance_test
