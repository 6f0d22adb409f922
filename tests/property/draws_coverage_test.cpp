#include <trochoid/force/statistics.h>
#include <trochoid/results/joint_of_fit.h>
#include <trochoid/results/spread.h>
#include <trochoid/sweep/distribution.h>

#include "../unit/identification/made_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>

/// How often the 95 % of draws of what was identified hold the force of another cut.
namespace trochoid::identification {
namespace {

constexpr std::size_t draws = 150;

/// The slot that is identified: two flutes, one of them short.
force::Setup measured() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

/// Largest force in the plane of the table in a cut with half as much feed again.
double peak_force(double offset, const force::Law& law) {
  force::Setup setup = measured();
  setup.runout.radial_offsets = {0.0, offset};
  setup.cut.f_z = 60.0 * unit::um;
  std::vector<double> phi;
  for (int i = 0; i < 60; ++i) phi.push_back(2.0 * pi * i / 60);
  double most = 0.0;
  for (const auto& F : force::forces(setup, law, phi, 1e-6)) {
    most = std::max(most, std::hypot(F[0], F[1]));
  }
  return most;
}

results::Joint identified(unsigned seed) {
  const force::Setup setup = measured();
  std::vector<Record> runs;
  runs.push_back(
      made_record(setup, steel(),
                  {.per_turn = 90, .turns = 3, .noise = 25.0, .seed = 31 * seed + 5}));
  Options options;
  options.phase = 0.0;
  options.errors = Errors::white;
  return results::joint_of(identify(without_runout(setup), steel(), runs, options), 0);
}

/// Names: six coefficients, then the offset of tooth 2.
results::Spread predicted(const results::Joint& joint, std::uint64_t seed) {
  const sweep::Distribution d = sweep::distribution_of(joint).value();
  std::mt19937_64 random(seed);
  const auto chance = sweep::chances(random, d.chances(), draws, false);
  const auto quantities = force::coefficient_quantities(steel());
  std::vector<double> peaks;
  for (std::size_t i = 0; i < draws; ++i) {
    std::vector<double> own;
    for (std::size_t c = 0; c < d.chances(); ++c) own.push_back(chance[c * draws + i]);
    std::vector<double> x = sweep::drawn(d, own);
    const double offset = x.back() * unit::mm;
    x.pop_back();
    for (std::size_t q = 0; q < x.size(); ++q) x[q] *= quantities[q].unit;
    peaks.push_back(peak_force(offset, force::with_coefficients(steel(), x)));
  }
  return results::spread_of(std::move(peaks));
}

/// The same numbers as if they did not hang together.
results::Joint apart(results::Joint joint) {
  const std::size_t n = joint.names.size();
  for (std::size_t i = 0; i < n * n; ++i) {
    if (i % (n + 1) != 0) joint.covariance[i] = 0.0;
  }
  return joint;
}

/// TROCHOID_SEEDS asks for more than the few of a quick test.
unsigned seeds() {
  constexpr unsigned few = 40;
  const char* asked = std::getenv("TROCHOID_SEEDS");
  return asked != nullptr ? static_cast<unsigned>(std::atoi(asked)) : few;
}

TEST(DrawsCoverage, TheForceOfAnotherCutLiesWithinNineteenTimesOfTwenty) {  // [U-4]
  const unsigned n = seeds();
  const double truth = peak_force(-8.0 * unit::um, steel());
  unsigned held = 0;
  double width = 0.0;
  double width_apart = 0.0;
  for (unsigned seed = 1; seed <= n; ++seed) {
    const results::Joint joint = identified(seed);
    ASSERT_EQ(joint.names.size(), 7U);
    const results::Spread with = predicted(joint, seed);
    held += with.low <= truth && truth <= with.high ? 1 : 0;
    width += (with.high - with.low) / n;
    if (seed <= 3) {
      const results::Spread without = predicted(apart(joint), seed);
      width_apart += (without.high - without.low) / 3;
    }
  }
  const double part = static_cast<double>(held) / n;
  const double deviation = std::sqrt(0.95 * 0.05 / n);
  // The ends of n draws hold (n - 1)/(n + 1) of what those of all do.
  EXPECT_GE(part, 0.94 - 3 * deviation);
  EXPECT_LT(part, 0.99 + deviation);
  // What the record knows best is the sum of what it cannot tell apart.
  EXPECT_GT(width_apart, 1.5 * width);
  if (n > 100) {
    std::printf("held %.1f %%, %.3g N wide; drawn apart %.3g N\n", 100 * part, width,
                width_apart);
  }
}

}  // namespace
}  // namespace trochoid::identification
