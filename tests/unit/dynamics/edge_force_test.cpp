#include <trochoid/dynamics/edge_force.h>

#include <trochoid/chip/chip.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::dynamics::edge_force_test {

struct Points {
  std::vector<double> sine, cosine, width, edge, constant;

  explicit Points(std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const double theta = 0.1 + 2.9 * static_cast<double>(i) / 31.0;
      sine.push_back(std::sin(theta));
      cosine.push_back(std::cos(theta));
      width.push_back(1e-5 * static_cast<double>(1 + i % 7));
      edge.push_back(1.2 * width.back());
      constant.push_back(i % 5 == 3 ? -2e-5
                                    : 4e-5 * std::sin(theta));  // some do not cut
    }
  }

  [[nodiscard]] PointsInCut view() const {
    return {sine.size(), sine.data(), cosine.data(), width.data(), edge.data()};
  }
};

/// Point by point, as the theory has it.
ForceSums by_hand(const Points& p, const Displaced& q, const force::Terms& law) {
  ForceSums sum{};
  for (std::size_t i = 0; i < p.sine.size(); ++i) {
    const double s = p.sine[i];
    const double c = p.cosine[i];
    const double h = p.constant[i] + q.x * s + q.y * c;
    if (h <= chip::h_threshold) {
      continue;
    }
    double f[3];
    double slope[3];
    for (std::size_t e = 0; e < 3; ++e) {
      const double m = law.form.power ? law.form.m[e] : 0.0;
      const double g = std::pow(h / force::h_0, -m);
      f[e] = law.K[e] * p.width[i] * g * h + law.K_e[e] * p.edge[i];
      slope[e] = (1 - m) * law.K[e] * p.width[i] * g;
    }
    sum[0] -= f[0] * c + f[1] * s;
    sum[1] += f[0] * s - f[1] * c;
    sum[2] -= f[2];
    const double x = -slope[0] * c - slope[1] * s;
    const double y = slope[0] * s - slope[1] * c;
    sum[3] += x * s;
    sum[4] += x * c;
    sum[5] += y * s;
    sum[6] += y * c;
    sum[7] -= slope[2] * s;
    sum[8] -= slope[2] * c;
  }
  return sum;
}

TEST(EdgeForce, IsTheSumOverItsPoints) {  // [T-4]
  std::vector<force::Terms> laws(4);
  laws[0].K = {8e8, 3e8, 1e8};
  laws[0].K_e = {2e4, 1e4, 5e3};
  laws[1] = {{true, {0.3, 0.3, 0.3}, false}, {2e8, 1e8, 5e7}, {}};
  laws[2] = {{true, {0.25, 0.4, 0.25}, true}, {2e8, 1e8, 5e7}, {1e4, 2e4, 3e3}};
  laws[3] = {{true, {0.25, 0.4, 0.4}, false}, {2e8, 0.0, 5e7}, {}};
  for (const force::Terms& law : laws) {
    for (std::size_t count = 0; count < 32; ++count) {
      const Points points(count);
      const Displaced q{3e-6, -2e-6};
      const ForceSums found =
          force_of_points(points.view(), points.constant.data(), q, law);
      const ForceSums wanted = by_hand(points, q, law);
      for (std::size_t k = 0; k < wanted.size(); ++k) {
        const double size = k < 3 ? 1.0 : 1e5;
        EXPECT_NEAR(found[k], wanted[k], 1e-12 * size) << count << ' ' << k;
      }
    }
  }
}

TEST(EdgeForce, TheLowestMarkIsMet) {  // [T-1]
  for (std::size_t count = 0; count < 32; ++count) {
    const Points points(count);
    const std::vector<Displaced> marks = {{1e-6, 2e-6}, {-3e-6, 1e-6}, {2e-6, -4e-6}};
    std::vector<double> above;
    for (std::size_t i = 0; i < 4 * count; ++i) {
      above.push_back(1e-6 * std::sin(3.7 * static_cast<double>(i)));
    }
    std::vector<double> least(count);
    chips_over_marks(points.view(), above.data(), marks, least.data());
    for (std::size_t i = 0; i < count; ++i) {
      double wanted = above[i];
      for (std::size_t m = 0; m < marks.size(); ++m) {
        wanted =
            std::min(wanted, above[(m + 1) * count + i] - marks[m].x * points.sine[i] -
                                 marks[m].y * points.cosine[i]);
      }
      EXPECT_NEAR(least[i], wanted, 1e-20) << count << ' ' << i;
    }
  }
}

}  // namespace trochoid::dynamics::edge_force_test
