#include <trochoid/base/units.h>
#include <trochoid/dynamics/steady_state.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <variant>

/// A cut that moves, whatever moves: every step finds its force, and every motion comes to
/// one of three ends.
namespace trochoid::dynamics {
namespace {

constexpr double pi = std::numbers::pi;
#ifdef __SANITIZE_ADDRESS__
constexpr int cuts = 20;
constexpr int followed_cuts = 3;
#else
constexpr int cuts = 250;
constexpr int followed_cuts = 60;
#endif

class RandomCuts {
 public:
  double even(double low, double high) {
    return low + (high - low) * std::uniform_real_distribution<double>(0, 1)(random_);
  }
  double power(double low, double high) {
    return low * std::pow(high / low, even(0, 1));
  }
  int one_of(int count) {
    return std::uniform_int_distribution<int>(0, count - 1)(random_);
  }

  MotionProblem next() {
    MotionProblem p;
    const double D = power(2e-3, 30e-3);
    const int teeth = 1 + one_of(6);
    p.setup.cutter = {.profile = geometry::cylinder(D),
                      .pitch = geometry::equal_pitch(teeth),
                      .helix = one_of(3) == 0 ? even(0.1, 0.8) : 0.0,
                      .lag_diameter = D};
    if (one_of(4) == 0 && teeth > 1) {
      p.setup.cutter.pitch[0] *= 1.1;
      p.setup.cutter.pitch[1] -= 0.1 * 2 * pi / teeth;
    }
    const double a_e = std::max(1e-6, D * power(0.01, 1.0) * (1 - 1e-9));
    const geometry::Engagement engagements[] = {
        geometry::Slot{}, geometry::UpMilling{a_e}, geometry::DownMilling{a_e}};
    p.setup.cut = {.engagement = engagements[one_of(3)],
                   .a_p = power(1e-4, 5e-3),
                   .f_z = power(5e-6, 3e-4),
                   .Omega = power(20, 20000) * unit::rpm};
    p.setup.chip = {one_of(2) == 0 ? chip::Model::radial : chip::Model::trochoidal,
                    chip::Lookback::all};
    if (one_of(2) == 0) {
      for (int j = 0; j < teeth; ++j) {
        p.setup.runout.radial_offsets.push_back(even(-1, 1) * p.setup.cut.f_z);
      }
    }
    p.law = law();
    add_modes(p);
    p.revolutions = 2;
    p.samples_per_rev = 60;
    return p;
  }

 private:
  force::Law law() {
    const double K = power(100e6, 4000e6);
    const double ratio = even(0.1, 0.9);
    const double m = even(0, 0.8);
    switch (one_of(3)) {
      case 0:
        return force::LinearEdge{.K_tc = K,
                                 .K_rc = ratio * K,
                                 .K_ac = 0.2 * K,
                                 .K_te = even(0, 4e4),
                                 .K_re = even(0, 4e4)};
      case 1:
        return force::Power{.K_t1 = K, .K_r1 = ratio * K, .m_t = m, .m_r = m};
      default:
        return force::PowerEdge{.K_t1 = K,
                                .K_r1 = ratio * K,
                                .m_t = m,
                                .m_r = even(0, 0.8),
                                .K_te = even(0, 4e4),
                                .K_re = even(0, 4e4)};
    }
  }

  /// From 0.02 to 200 N/um, and from 50 Hz to 10 kHz where the turns are short enough.
  void add_modes(MotionProblem& p) {
    const double turns = p.setup.cut.Omega / (2 * pi);
    const int count = 1 + one_of(3);
    for (int r = 0; r < count; ++r) {
      const double k = power(2e4, 2e8);
      const double f = std::min(power(50, 10000), 500 * turns);
      const double omega = 2 * pi * f;
      const double m = k / (omega * omega);
      const double angle = one_of(2) == 0 ? 0.5 * pi * one_of(4) : even(0, 2 * pi);
      p.system.modes.push_back(
          {m, 2 * power(2e-3, 0.2) * omega * m, k, std::cos(angle), std::sin(angle)});
    }
  }

  std::mt19937 random_{20};
};

bool is_fine(const MotionProblem& p) {
  return steps_needed(p) * p.setup.cutter.teeth() < 8000;
}

/// Is the cut stiffer than the tool? Then a tool that is pulled inwards digs in: the chip
/// grows by more than what pulls it, and no displacement is too large.
bool may_dig_in(const MotionProblem& p) {
  const force::Terms law = force::terms(p.law);
  double K = 0.0;
  for (std::size_t e = 0; e < 2; ++e) {
    const double m = law.form.power ? law.form.m[e] : 0.0;
    K += law.K[e] * std::pow(p.setup.cut.f_z / force::h_0, -m);
  }
  double compliance = 0.0;
  for (const ChipMode& mode : p.system.modes) {
    compliance += 1 / mode.stiffness;
  }
  return K * p.setup.cut.a_p * compliance > 0.5;
}

TEST(Motion, OfAnyCutFindsItsForceInEveryStep) {  // [T-6] [T-12]
  RandomCuts random;
  int ran_away = 0;
  int tried = 0;
  for (int n = 0; n < cuts; ++n) {
    const MotionProblem p = random.next();
    if (!is_fine(p)) {
      continue;
    }
    ++tried;
    const Motion m = motion(p);
    EXPECT_TRUE(m.solved) << "cut " << n << " after " << m.turns_done << " turns, "
                          << p.setup.cut.Omega / unit::rpm << " rpm, law "
                          << force::name_of(p.law);
    ran_away += m.finite || may_dig_in(p) ? 0 : 1;
    for (const auto& F : m.force) {
      ASSERT_TRUE(std::isfinite(F[0] + F[1] + F[2])) << n;
    }
  }
  EXPECT_GT(tried, 0.5 * cuts);
  EXPECT_EQ(ran_away, 0);
}

TEST(SteadyState, OfAnyCutIsOneOfThree) {  // [T-15]
  RandomCuts random;
  std::array<int, 3> ends{};
  for (int n = 0; n < followed_cuts; ++n) {
    const MotionProblem p = random.next();
    if (steps_needed(p) * p.setup.cutter.teeth() > 4000) {
      continue;
    }
    const SteadyState steady = steady_state(p);
    ASSERT_TRUE(steady.motion.solved) << n;
    ++ends[steady.verdict.index()];
    if (const auto* periodic = std::get_if<Periodic>(&steady.verdict)) {
      EXPECT_GE(periodic->passes, 1);
      EXPECT_TRUE(steady.motion.finite);
    } else if (const auto* bounded = std::get_if<Bounded>(&steady.verdict)) {
      EXPECT_TRUE(steady.motion.finite);
      EXPECT_TRUE(bounded->fades || bounded->turns > 0) << n;
      if (!bounded->fades) {
        EXPECT_GT(bounded->amplitude[0] + bounded->amplitude[1], 0.0) << n;
        EXPECT_LT(bounded->amplitude[0] + bounded->amplitude[1], 2 * run_away) << n;
        EXPECT_FALSE(bounded->lines.empty()) << n;
      }
    }
  }
#ifndef __SANITIZE_ADDRESS__
  EXPECT_GT(ends[0], 3) << "periodic";
  EXPECT_GT(ends[1], 3) << "bounded";
#endif
  RecordProperty("periodic", ends[0]);
  RecordProperty("bounded", ends[1]);
  RecordProperty("growing", ends[2]);
}

}  // namespace
}  // namespace trochoid::dynamics
