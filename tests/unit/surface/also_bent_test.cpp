#include "made_wall.h"

#include <trochoid/surface/error_map.h>

#include <gtest/gtest.h>

#include <stdexcept>

namespace trochoid::surface::also_bent_test {

constexpr int points = 16;
const force::Law all_forces = force::LinearEdge{800e6, 300e6, 200e6, 9e3, 4e3, 5e3};

/// Sums of the four kinds of couples_at: the integrals without L_q.
std::array<double, 4> sums(const EdgeMoments& edges, double phi, LeverArms arms) {
  std::vector<double> out(4 * points);
  edges.couples_at(phi, arms, out);
  std::array<double, 4> sum{};
  for (std::size_t i = 0; i < out.size(); ++i) sum[i / points] += out[i];
  return sum;
}

/// The same by hand: tooth after tooth, over the heights that are in the stock.
std::array<double, 4> by_hand(const MadeCut& s, double phi, double sigma, double mid) {
  const double R = s.cutter.profile.D / 2;
  const double per_z = std::tan(s.cutter.helix) / R;
  const double edge = 1 / std::cos(s.cutter.helix);
  const auto [first, last] = arc(s);
  std::array<double, 4> sum{};
  for (const double psi : geometry::tooth_angles(s.cutter)) {
    for (int turn = -2; turn <= 2; ++turn) {
      const double top = phi - psi + 2 * pi * turn;
      const double from = std::max(0.0, (top - last) / per_z);
      const double to = std::min(s.cut.a_p, (top - first) / per_z);
      if (to <= from) continue;
      const auto part = [&](const std::function<double(double, double, double)>& f) {
        return simpson(
            [&](double z) {
              const double theta = top - z * per_z;
              const double h = s.cut.f_z * std::sin(theta);
              const double F_x = -std::cos(theta) * (800e6 * h + 9e3 * edge) -
                                 std::sin(theta) * (300e6 * h + 4e3 * edge);
              return f(R * std::cos(theta), F_x, -(200e6 * h + 5e3 * edge));
            },
            from, to);
      };
      const auto arm = [&](double y) { return sigma * (mid + sigma * y); };
      sum[0] += part([](double, double F_x, double) { return F_x; });
      sum[1] += part([&](double y, double F_x, double) { return arm(y) * F_x; });
      sum[2] += part([](double y, double, double F_z) { return y * F_z; });
      sum[3] += part([&](double y, double, double F_z) { return arm(y) * F_z; });
    }
  }
  return sum;
}

TEST(Couples, AreForcesTimesTheirLeverArms) {  // [E-42]
  for (const bool down : {true, false}) {
    const MadeCut s = made_cut(down);
    const EdgeMoments edges(s, all_forces, {0.0, s.cut.a_p, points});
    const double sigma = down ? 1.0 : -1.0;
    const LeverArms arms{.sigma = sigma, .mid_plane = 6.2e-3};
    for (const double phi : angles(9)) {
      const auto got = sums(edges, phi, arms);
      const auto want = by_hand(s, phi, sigma, 6.2e-3);
      for (std::size_t k = 0; k < 4; ++k) {
        EXPECT_NEAR(got[k], want[k], 1e-6 * (k == 0 ? 100 : 1)) << k << ' ' << phi;
      }
    }
  }
}

Setting bending(std::vector<AlsoBends> axes, BodiesAt bodies, bool down = true) {
  Setting s = made_setting(Model::imprint, made_cut(down), std::move(bodies));
  s.law = all_forces;
  s.also_bends = std::move(axes);
  return s;
}

double mean_error(const Setting& s, double x = 20e-3) {
  return error_map(s, {.heights = {0.5e-3, 1.5e-3}, .position = x}).error.mean;
}

TEST(AlsoBends, NothingMoreBendsWithoutAxialForce) {  // [E-43]
  Setting s = bending({AlsoBends::z}, with_wall());
  s.law = law(800e6, 300e6, 9e3, 4e3);
  Setting plain = s;
  plain.also_bends.clear();
  EXPECT_NEAR(mean_error(s), mean_error(plain), 1e-10);
}

TEST(AlsoBends, AnAxialForceTiltsCutterAndWallApart) {  // [E-42] [E-43]
  // The cutter is pulled down at the wall and swings away from it; the wall is pulled up
  // at its face and swings away as well.
  for (const bool down : {true, false}) {
    const double plain = mean_error(bending({}, with_wall(4e-3), down));
    const double tilted = mean_error(bending({AlsoBends::z}, with_wall(4e-3), down));
    EXPECT_GT(tilted, plain + 0.1e-6) << down;
    const double cutter = mean_error(bending({AlsoBends::z}, cutter_only(), down)) -
                          mean_error(bending({}, cutter_only(), down));
    EXPECT_GT(cutter, 0.1e-6);
  }
}

TEST(AlsoBends, AForceAlongTheFeedTurnsAWallBesideItsMiddleOnly) {  // [E-43]
  const BodiesAt wall_only = [](double x) {
    return Bodies{.wall = with_wall()(x).wall};
  };
  const auto change = [&](double x) {
    return mean_error(bending({AlsoBends::x}, wall_only), x) -
           mean_error(bending({}, wall_only), x);
  };
  const double left = change(15e-3);
  EXPECT_GT(std::abs(left), 1e-8);
  EXPECT_NEAR(change(45e-3), -left, 1e-3 * std::abs(left));  // the mirror image
  EXPECT_NEAR(change(30e-3), 0.0, 1e-3 * std::abs(left));
}

TEST(AlsoBends, ACutterBentAlongTheFeedShiftsTheImprints) {  // [E-44]
  const auto map = [&](std::vector<AlsoBends> axes) {
    return error_map(bending(std::move(axes), cutter_only()), {.heights = {1e-3}});
  };
  const ErrorMap plain = map({});
  const ErrorMap bent = map({AlsoBends::x});
  for (std::size_t i = 0; i < plain.rows[0].x.size(); ++i) {
    EXPECT_NEAR(bent.rows[0].error[i], plain.rows[0].error[i], 1e-11);
    // At the wall of a down cut the force along the feed is that of cutting, +K_tc h,
    // and edge above: forward.
    EXPECT_GT(bent.rows[0].x[i], plain.rows[0].x[i] + 1e-6);
  }
}

TEST(AlsoBends, RefusesFeedback) {
  EXPECT_THROW(
      error_map(bending({AlsoBends::z}, cutter_only()), {.feedback = Feedback::entry}),
      std::invalid_argument);
}

}  // namespace trochoid::surface::also_bent_test
