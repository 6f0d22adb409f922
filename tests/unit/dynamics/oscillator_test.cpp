#include <trochoid/dynamics/oscillator.h>

#include <trochoid/dynamics/nodes.h>
#include <trochoid/numerics/dominant_eigenvalue.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::dynamics::oscillator_test {

/// Mass 0.5 kg, 300 rad/s, with a damping ratio.
ChipMode damped(double ratio) {
  return {0.5, 2 * ratio * 300 * 0.5, 0.5 * 300 * 300, 1, 0};
}

TEST(Oscillator, ObeysItsEquationWhateverTheDamping) {  // [D-1] [D-3]
  for (const double ratio : {0.0, 0.01, 0.9, 0.9999999999, 1.0, 1.0000000001, 3.0}) {
    const ChipMode mode = damped(ratio);
    const double t = 0.004;
    const double dt = 1e-6;
    const auto before = free_motion(mode, t - dt);
    const auto now = free_motion(mode, t);
    const auto after = free_motion(mode, t + dt);
    for (std::size_t start : {0U, 1U}) {  // from a displacement, from a speed
      const double scale = start == 0 ? 300.0 : 1.0;
      const double velocity = (after[start] - before[start]) / (2 * dt);
      EXPECT_NEAR(velocity, now[2 + start], 1e-6 * scale) << ratio;
      const double acceleration = (after[2 + start] - before[2 + start]) / (2 * dt);
      EXPECT_NEAR(mode.mass * acceleration + mode.damping * now[2 + start] +
                      mode.stiffness * now[start],
                  0.0, 1e-3 * scale)
          << ratio;
    }
  }
}

TEST(Oscillator, GoesOnWhereItStopped) {  // [D-3]
  const ChipMode mode = damped(0.05);
  const auto a = free_motion(mode, 0.002);
  const auto b = free_motion(mode, 0.005);
  const auto both = free_motion(mode, 0.007);
  EXPECT_NEAR(b[0] * a[0] + b[1] * a[2], both[0], 1e-13);
  EXPECT_NEAR(b[2] * a[1] + b[3] * a[3], both[3], 1e-13);
}

TEST(Oscillator, FollowsAForceThatIsAPolynomial) {  // [D-4]
  // x = t^3 solves m x'' + c x' + k x = f with f = 6 m t + 3 c t^2 + k t^3.
  const ChipMode mode = damped(0.03);
  const double duration = 0.05;  // 2.4 cycles
  for (const int n : {4, 8, 30}) {
    const DrivenMotion motion = driven_motion(mode, n, duration);
    const auto& t = element_nodes(n).t;
    std::vector<double> force;
    for (const double u : t) {
      const double s = 0.5 * duration * (u + 1);
      force.push_back(6 * mode.mass * s + 3 * mode.damping * s * s +
                      mode.stiffness * s * s * s);
    }
    double velocity = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i) {
      double eta = 0.0;
      for (std::size_t k = 0; k < t.size(); ++k) {
        eta += motion.eta[i * t.size() + k] * force[k];
      }
      const double s = 0.5 * duration * (t[i] + 1);
      EXPECT_NEAR(eta, s * s * s, (n == 4 ? 1e-8 : 1e-12) * std::pow(duration, 3)) << n;
      velocity += motion.velocity[motion.velocity.size() - force.size() + i] * force[i];
    }
    EXPECT_NEAR(velocity, 3 * duration * duration, 1e-7 * duration * duration) << n;
  }
}

TEST(Nodes, InterpolateAPolynomialExactly) {
  const ElementNodes& nodes = element_nodes(7);
  std::vector<double> row(nodes.t.size());
  for (const double t : {-1.0, -0.9, 0.123, nodes.t[3], 1.0}) {
    lagrange_row(nodes, t, row);
    double value = 0.0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      value += row[i] * std::pow(nodes.t[i], 7);
    }
    EXPECT_NEAR(value, std::pow(t, 7), 1e-14);
  }
}

TEST(DominantEigenvalue, IsFoundAmongMany) {  // [D-10]
  // A rotation by 0.7, and ever smaller numbers that it drives.
  const std::size_t n = 60;
  const auto map = [&](std::span<const double> in, std::span<double> out) {
    out[0] = 1.2 * (std::cos(0.7) * in[0] - std::sin(0.7) * in[1]);
    out[1] = 1.2 * (std::sin(0.7) * in[0] + std::cos(0.7) * in[1]);
    for (std::size_t i = 2; i < n; ++i) {
      out[i] = in[i] * 1.1 * std::pow(0.7, static_cast<double>(i - 2)) + 0.1 * in[1];
    }
  };
  const auto found = numerics::dominant_eigenvalue(map, n, 1e-10);
  EXPECT_LT(std::abs(found.value - std::polar(1.2, 0.7)), 1e-9);
  std::vector<double> re(n), im(n), re_out(n), im_out(n);
  for (std::size_t i = 0; i < n; ++i) {
    re[i] = found.vector[i].real();
    im[i] = found.vector[i].imag();
  }
  map(re, re_out);
  map(im, im_out);
  double size = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const std::complex<double> value(re_out[i], im_out[i]);
    EXPECT_LT(std::abs(value - found.value * found.vector[i]), 1e-8);
    size += std::norm(found.vector[i]);
  }
  EXPECT_NEAR(size, 1.0, 1e-12);
  EXPECT_LT(found.steps, 60);
}

TEST(DominantEigenvalue, OfSmallMatrices) {  // [D-10]
  const auto flip = [](std::span<const double> in, std::span<double> out) {
    out[0] = -2 * in[0];
  };
  EXPECT_NEAR(numerics::dominant_eigenvalue(flip, 1, 1e-9).value.real(), -2.0, 1e-14);
  const auto zero = [](std::span<const double>, std::span<double> out) {
    std::fill(out.begin(), out.end(), 0.0);
  };
  EXPECT_EQ(std::abs(numerics::dominant_eigenvalue(zero, 5, 1e-9).value), 0.0);
}

}  // namespace trochoid::dynamics::oscillator_test
