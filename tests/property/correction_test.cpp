#include <trochoid/base/units.h>
#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/learning.h>
#include <trochoid/correction/plant.h>
#include <trochoid/correction/ratio.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/correction/static_fit.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

/// Laws of the correction, over cuts, motions and plants drawn with fixed seeds.
namespace trochoid::correction {
namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr unsigned seeds = 24;

struct Drawn {
  force::Setup setup;
  force::Power law;
  Plant plant;
  PeriodicMotion motion;
};

Drawn draw(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  Drawn out;
  const int teeth = 2 + static_cast<int>(seed % 4);
  const double D = between(4e-3, 20e-3);
  out.setup.cutter = {.profile = geometry::cylinder(D),
                      .pitch = geometry::equal_pitch(teeth),
                      .lag_diameter = D};
  out.setup.cut = {geometry::Slot{}, between(0.5e-3, 3e-3), between(20e-6, 100e-6),
                   between(600, 8000) * unit::rpm};
  if (seed % 3 == 1)
    out.setup.cut.engagement = geometry::UpMilling{between(0.1, 0.9) * D};
  if (seed % 3 == 2)
    out.setup.cut.engagement = geometry::DownMilling{between(0.1, 0.9) * D};
  for (int j = 0; j < teeth; ++j) {
    out.setup.runout.radial_offsets.push_back(between(-0.4, 0.4) * out.setup.cut.f_z);
  }
  out.setup.chip.model = chip::Model::radial;
  out.law = {.K_t1 = between(100e6, 900e6),
             .K_r1 = between(30e6, 300e6),
             .K_a1 = between(20e6, 100e6),
             .m_t = between(0.1, 0.6),
             .m_r = between(0.1, 0.6),
             .m_a = between(0.1, 0.6)};
  const double k = between(5e6, 5e7);
  const double omega_n = turn * between(600, 2500);
  out.plant = held_by_actuator(
      structure::from_frequency(between(0.8, 1.2), between(60, 400), between(0.3, 1.5)),
      {.mass = k / (omega_n * omega_n),
       .stiffness = k,
       .damping = 2 * between(0.01, 0.1) * k / omega_n});
  Harmonics motion;
  for (int n = 1; n <= 7; ++n) {
    motion.c.emplace_back(between(-1, 1) * 5e-6 / n, between(-1, 1) * 5e-6 / n);
  }
  out.motion = motion;
  return out;
}

}  // namespace

TEST(Correction, LevelsSumToZero) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const auto x = levels(draw(seed).setup.runout.radial_offsets);
    EXPECT_NEAR(std::accumulate(x.begin(), x.end(), 0.0), 0.0, 1e-18);
  }
}

TEST(Correction, EveryChipOfEveryMotionIsTakenFromTheWork) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Drawn d = draw(seed);
    const RigidCut cut(d.setup, d.law);
    double sum = 0.0;
    for (const Flute& f : cut.flutes(d.motion)) {
      sum += f.chip_area;
    }
    const double width = std::cos(cut.arc().from) - std::cos(cut.arc().to);
    const double all =
        d.setup.cutter.teeth() * d.setup.cut.f_z * width;  // f times the width over R
    EXPECT_NEAR(sum, all, 1e-7 * all) << seed;
  }
}

TEST(Correction, RenumberingTheTeethTurnsEverythingAlong) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Drawn d = draw(seed);
    force::Setup other = d.setup;
    auto& rho = other.runout.radial_offsets;
    std::rotate(rho.begin(), rho.begin() + 1, rho.end());
    const double pitch = turn / d.setup.cutter.teeth();
    const RigidCut a(d.setup, d.law);
    const RigidCut b(other, d.law);
    for (const Shape shape : {Shape::square, Shape::sine, Shape::quintic}) {
      const PeriodicMotion x = table_motion(a, shape, {.transition = 0.5});
      const PeriodicMotion y = table_motion(b, shape, {.transition = 0.5});
      for (double phi = 0.0123; phi < turn; phi += 0.4) {
        EXPECT_NEAR(place_at(x, phi + pitch), place_at(y, phi), 1e-14);
        const auto F = a.force(x, phi + pitch);
        const auto G = b.force(y, phi);
        EXPECT_NEAR(F[0], G[0], 1e-6 + 1e-6 * std::abs(F[0]));
        EXPECT_NEAR(F[1], G[1], 1e-6 + 1e-6 * std::abs(F[1]));
      }
    }
  }
}

TEST(Correction, AConstantPlaceOfTheTableChangesNothing) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Drawn d = draw(seed);
    const RigidCut cut(d.setup, d.law);
    Harmonics shifted = std::get<Harmonics>(d.motion);
    shifted.mean = 30e-6;
    for (double phi = 0.05; phi < turn; phi += 0.3) {
      const auto F = cut.force(d.motion, phi);
      const auto G = cut.force(shifted, phi);
      EXPECT_NEAR(F[1], G[1], 1e-6 + 1e-6 * std::abs(F[1]));
    }
  }
}

TEST(Correction, InverseThenPlantIsTheMotion) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Drawn d = draw(seed);
    const double Omega = d.setup.cut.Omega;
    const Command c =
        command_for(d.motion, Method::inverse, d.plant, Omega, {.n_max = 7});
    const Harmonics back = table_response(d.plant, c.wave, Omega, 7);
    for (std::size_t n = 0; n < 7; ++n) {
      EXPECT_NEAR(std::abs(back.c[n] - std::get<Harmonics>(d.motion).c[n]), 0.0, 1e-17);
    }
  }
}

TEST(Correction, LearningConvergesIfAndOnlyIfItsFactorsAreBelowOne) {
  int converged = 0;
  int diverged = 0;
  for (unsigned seed = 0; seed < 4 * seeds; ++seed) {
    const Drawn d = draw(seed);
    const Plant real = draw(seed + 1000).plant;  // another plant altogether
    const double Omega = d.setup.cut.Omega;
    const double gain = 0.2 + 0.02 * seed;
    const auto factors = learning_factors(real, d.plant, Omega, gain, 3);
    const double largest = *std::max_element(factors.begin(), factors.end());
    if (std::abs(largest - 1) < 0.02) continue;  // too slow to tell
    const Command start =
        command_for(d.motion, Method::inverse, d.plant, Omega, {.n_max = 3});
    const Learned learned =
        learn(d.motion, std::get<Harmonics>(start.wave), d.plant, Omega,
              [&](const Harmonics& u) { return table_response(real, u, Omega, 3); },
              {.gain = gain, .iterations = 2000, .enough = 1e-6});
    EXPECT_EQ(learned.converged, largest < 1) << seed << ' ' << largest;
    (learned.converged ? converged : diverged) += 1;
  }
  EXPECT_GT(converged, 10);
  EXPECT_GT(diverged, 10);
}

TEST(Correction, TwoTeethCanAlwaysBeMadeAlike) {
  for (unsigned seed = 0; seed < 2 * seeds; seed += 4) {  // two teeth
    const Drawn d = draw(seed);
    const RigidCut cut(d.setup, d.law);
    for (const Shape shape : {Shape::square, Shape::sine, Shape::quintic}) {
      const Amplitude a =
          amplitude_for(Target::peak_force, cut, table_motion(cut, shape, {}));
      ASSERT_TRUE(a.ok) << seed << ' ' << static_cast<int>(shape) << ' ' << a.reason;
      EXPECT_LT(a.peak_difference, 1e-5) << seed << ' ' << static_cast<int>(shape);
    }
  }
}

TEST(Correction, RatioUndoesThePowerLaw) {
  for (unsigned seed = 0; seed < seeds; ++seed) {
    const Drawn d = draw(seed);
    const double f_z = d.setup.cut.f_z;
    const auto& rho = d.setup.runout.radial_offsets;
    std::vector<double> F;
    for (std::size_t j = 0; j < rho.size(); ++j) {
      const double h = f_z + rho[j] - rho[(j + rho.size() - 1) % rho.size()];
      F.push_back(d.law.K_t1 * std::pow(h, 1 - d.law.m_t));
    }
    const RatioEstimate r = ratio_estimate(F, f_z, d.law.m_t);
    ASSERT_TRUE(r.ok);
    const auto x = levels(rho);
    for (std::size_t j = 0; j < rho.size(); ++j) {
      EXPECT_NEAR(r.rho[j], x[j], 1e-15);
    }
  }
}

TEST(Correction, StaticFitFindsWhatMadeTheForces) {
  for (unsigned seed = 0; seed < seeds / 2; ++seed) {
    const Drawn d = draw(seed);
    const RigidCut cut(d.setup, d.law);
    ForceRecord record;
    for (int i = 0; i < 360; ++i) {
      record.angle.push_back(turn * i / 360);
      record.force.push_back(cut.force(Harmonics{}, turn * i / 360 + 0.01));
    }
    force::Setup asked = d.setup;
    asked.runout = {};
    const StaticFit fit = static_fit(asked, record);
    ASSERT_TRUE(fit.ok) << seed << ' ' << fit.reason;
    const auto x = levels(d.setup.runout.radial_offsets);
    for (std::size_t j = 0; j < x.size(); ++j) {
      EXPECT_NEAR(fit.rho[j].value, x[j], 1e-3 * d.setup.cut.f_z) << seed;
    }
    EXPECT_NEAR(fit.m_t.value, d.law.m_t, 1e-3) << seed;
    EXPECT_NEAR(fit.offset.value, 0.01, 1e-4) << seed;
  }
}

}  // namespace trochoid::correction
