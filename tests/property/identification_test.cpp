#include "../unit/identification/made_record.h"

#include <gtest/gtest.h>

#include <cmath>

/// identify(simulate(p)) = p, over tools and cuts drawn with fixed seeds.
namespace trochoid::identification {
namespace {

struct Drawn {
  force::Setup setup;
  force::LinearEdge law;
  double phase = 0.0;
};

Drawn draw(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  const int teeth = 1 + static_cast<int>(seed % 4);
  Drawn out;
  out.setup = slot_setup(teeth, between(12.0, 45.0), between(1e-3, 6e-3));
  out.setup.cut.f_z = between(20e-6, 80e-6);
  const double a_e = between(2e-3, 7e-3);
  if (seed % 3 == 1) out.setup.cut.engagement = geometry::UpMilling{a_e};
  if (seed % 3 == 2) out.setup.cut.engagement = geometry::DownMilling{a_e};
  out.setup.runout.radial_offsets.assign(static_cast<std::size_t>(teeth), 0.0);
  for (std::size_t k = 1; k < static_cast<std::size_t>(teeth); ++k) {
    // Within what leaves every tooth in cut.
    out.setup.runout.radial_offsets[k] = between(-0.45, 0.45) * out.setup.cut.f_z;
  }
  out.law = {between(1e9, 3e9), between(3e8, 1.8e9), between(1e8, 5e8),
             between(3e3, 2e4), between(3e3, 1.5e4), between(500.0, 3e3)};
  out.phase = between(-pi / teeth, pi / teeth);
  return out;
}

class RoundTrip : public testing::TestWithParam<unsigned> {};

TEST_P(RoundTrip, IdentifyInvertsSimulate) {  // [I-1] [I-3]
  const Drawn drawn = draw(GetParam());
  Sampling sampling;
  sampling.phase = drawn.phase;
  sampling.per_turn = 240;
  const std::vector<Record> runs = {made_record(drawn.setup, drawn.law, sampling)};
  const Fit fit = identify(without_runout(drawn.setup), drawn.law, runs, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_LT(fit.rms, 1e-6 * peak(runs[0]));
  EXPECT_NEAR(fit.phase[0], drawn.phase, 1e-5);
  const std::vector<double> K = force::coefficients(drawn.law);
  for (std::size_t c = 0; c < K.size(); ++c) {
    EXPECT_NEAR(fit.coefficients[c]->value, K[c], 1e-4 * K[c]) << c;
  }
  const auto& offsets = drawn.setup.runout.radial_offsets;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    EXPECT_NEAR(fit.runout.radial_offsets[k], offsets[k], 1e-9) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(FixedSeeds, RoundTrip, testing::Range(0U, 24U));

TEST(RoundTrip, NoiseStaysWithinFiveStandardErrors) {  // [I-4]
  for (unsigned seed = 1; seed < 24; seed += 4) {
    const Drawn drawn = draw(seed);
    Sampling sampling{drawn.phase, 240, 2.0, 4.0, seed};
    const std::vector<Record> runs = {made_record(drawn.setup, drawn.law, sampling)};
    const Fit fit = identify(without_runout(drawn.setup), drawn.law, runs, {});
    ASSERT_TRUE(fit.ok) << fit.message;
    const std::vector<double> K = force::coefficients(drawn.law);
    for (std::size_t c = 0; c < K.size(); ++c) {
      EXPECT_NEAR(fit.coefficients[c]->value, K[c], 5.0 * fit.coefficients[c]->se)
          << seed << " " << c;
    }
    EXPECT_NEAR(fit.phase[0], drawn.phase, 5.0 * *fit.phase_se[0]) << seed;
  }
}

TEST(RoundTrip, TurnsRepeatedChangeNothingButTheErrors) {  // [I-1] [I-2]
  const Drawn drawn = draw(5);
  Sampling once{drawn.phase, 240, 1.0, 0.0, 1};
  Sampling thrice{drawn.phase, 240, 3.0, 0.0, 1};
  const Fit a =
      identify(without_runout(drawn.setup), drawn.law,
               std::vector<Record>{made_record(drawn.setup, drawn.law, once)}, {});
  const Fit b =
      identify(without_runout(drawn.setup), drawn.law,
               std::vector<Record>{made_record(drawn.setup, drawn.law, thrice)}, {});
  EXPECT_NEAR(a.coefficients[0]->value, b.coefficients[0]->value, 1e3);
  EXPECT_NEAR(a.condition, b.condition, 1e-6);
}

}  // namespace
}  // namespace trochoid::identification
