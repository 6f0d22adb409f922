#include <trochoid/identification/systematic.h>

#include "made_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

/// A dynamometer or a cut that is not what the case says.
namespace trochoid::identification::systematic_test {

force::Setup two_flutes_with_runout() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

Record noisy(const force::Setup& setup) {
  return made_record(setup, steel(),
                     {.per_turn = 120, .turns = 12, .noise = 4.0, .seed = 5});
}

Fit fitted(const std::vector<Record>& runs) {
  return identify(without_runout(two_flutes_with_runout()), steel(), runs, {});
}

Systematics found_in(const std::vector<Record>& runs) {
  return systematics(without_runout(two_flutes_with_runout()), steel(), runs,
                     fitted(runs));
}

const SystematicEffect& of_kind(const Systematics& all, SystematicKind kind) {
  for (const SystematicEffect& one : all.untold) {
    if (one.systematic.kind == kind) return one;
  }
  throw std::out_of_range("no such systematic");
}

TEST(Systematic, EffectsAreWhatARefitFinds) {  // [I-24]
  const force::Setup setup = two_flutes_with_runout();
  const std::vector<Record> right{noisy(setup)};
  const Systematics told = found_in(right);
  const Fit fit = fitted(right);
  const auto expect = [&](SystematicKind kind, double amount, const Record& wrong) {
    const Fit other = fitted({wrong});
    for (std::size_t q = 0; q < 2; ++q) {
      const double effect = of_kind(told, kind).on_coefficients[q] * amount;
      EXPECT_NEAR(other.coefficients[q]->value - fit.coefficients[q]->value, effect,
                  0.05 * std::abs(effect) + 2e5)
          << static_cast<int>(kind) << " " << q;
    }
  };
  Record turned = right[0];
  const double turn = 0.5 * unit::deg;
  for (auto& F : turned.force) F = {F[0] + turn * F[1], F[1] - turn * F[0], F[2]};
  expect(SystematicKind::turn, turn, turned);
  Record louder = right[0];
  for (auto& F : louder.force) {
    for (double& f : F) f *= 1.01;
  }
  expect(SystematicKind::all_gains, 0.01, louder);
  Record shallower = right[0];  // told: 0.02 mm less than was cut
  shallower.cut.a_p -= 0.02 * unit::mm;
  expect(SystematicKind::axial_depth, 0.02 * unit::mm, shallower);
  Record slower = right[0];
  slower.cut.f_z -= 0.2 * unit::um;
  expect(SystematicKind::feed, 0.2 * unit::um, slower);
}

TEST(Systematic, ToleranceThatIsToldIsInTheIntervals) {  // [I-24]
  const std::vector<Record> runs{noisy(two_flutes_with_runout())};
  const Systematics told = found_in(runs);
  const Fit fit = fitted(runs);
  Options options;
  options.tolerances.turn = 0.5 * unit::deg;
  options.tolerances.axial_depth = 0.02 * unit::mm;
  const Fit wider =
      identify(without_runout(two_flutes_with_runout()), steel(), runs, options);
  for (std::size_t q = 0; q < 2; ++q) {
    const double turn = *options.tolerances.turn *
                        of_kind(told, SystematicKind::turn).on_coefficients[q];
    const double depth = *options.tolerances.axial_depth *
                         of_kind(told, SystematicKind::axial_depth).on_coefficients[q];
    const double want = std::hypot(fit.coefficients[q]->se, turn, depth);
    EXPECT_NEAR(wider.coefficients[q]->se / want, 1.0, 1e-3) << q;
    EXPECT_NEAR(wider.coefficients[q]->value / fit.coefficients[q]->value, 1.0, 1e-9);
  }
}

TEST(Systematic, ASlotHasNoRadialDepth) {  // [I-24]
  const Systematics told = found_in({noisy(two_flutes_with_runout())});
  EXPECT_THROW(of_kind(told, SystematicKind::radial_depth), std::out_of_range);
}

TEST(Systematic, GainOfOneChannelIsTold) {  // [I-24]
  Record run = noisy(two_flutes_with_runout());
  EXPECT_TRUE(found_in({run}).faults.empty()) << "nothing is wrong yet";
  for (auto& F : run.force) F[1] *= 1.03;
  bool named = false;
  for (const SensorFault& fault : found_in({run}).faults) {
    if (fault.systematic.kind != SystematicKind::gain) continue;
    if (fault.systematic.reading != 1) continue;
    named = true;
    EXPECT_NEAR(fault.value, 0.03, 0.006);
    EXPECT_NEAR(fault.coefficients[0] / steel().K_tc, 1.0, 0.01);
    EXPECT_NEAR(fault.coefficients[1] / steel().K_rc, 1.0, 0.01);
  }
  EXPECT_TRUE(named);
}

TEST(Systematic, DelayOfOneChannelIsTold) {  // [I-24]
  constexpr std::size_t late = 2;            // samples, of which a turn has 120
  Record run = noisy(two_flutes_with_runout());
  for (std::size_t i = run.force.size(); i-- > late;) {
    run.force[i][1] = run.force[i - late][1];
  }
  for (std::size_t i = 0; i < late; ++i) {
    run.force[i][1] = run.force[i + 120][1];  // it repeats
  }
  const auto faults = found_in({run}).faults;
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.front().systematic.kind, SystematicKind::delay);
  EXPECT_EQ(faults.front().systematic.reading, 1u);
  const double delay = late * unit::turn / 120 / run.cut.Omega;
  EXPECT_NEAR(faults.front().value / delay, 1.0, 0.15);
}

TEST(Systematic, TheErrorOfAnOffsetIsInTheIntervals) {  // [I-24]
  std::vector<Record> runs{noisy(two_flutes_with_runout())};
  const Fit fit = fitted(runs);
  constexpr double offset = 3.0;  // [N]
  std::vector<Record> moved = runs;
  for (auto& F : moved[0].force) F[2] += offset;
  const Fit other = fitted(moved);
  runs[0].offset_se = {0.0, 0.0, offset};
  const Fit wider = fitted(runs);
  const std::size_t K_ae = 5;
  const double effect = other.coefficients[K_ae]->value - fit.coefficients[K_ae]->value;
  EXPECT_GT(std::abs(effect), fit.coefficients[K_ae]->se);
  EXPECT_NEAR(
      wider.coefficients[K_ae]->se / std::hypot(fit.coefficients[K_ae]->se, effect),
      1.0, 0.01);
}

TEST(Systematic, CrossTalkIsTold) {  // [I-24]
  Record run = noisy(two_flutes_with_runout());
  for (auto& F : run.force) F[0] += 0.03 * F[1];
  bool named = false;
  for (const SensorFault& fault : found_in({run}).faults) {
    const Systematic& one = fault.systematic;
    EXPECT_EQ(one.kind, SystematicKind::cross_talk);
    if (one.reading != 0 || one.force != 1) continue;
    named = true;
    EXPECT_NEAR(fault.value, 0.03, 0.01);
    EXPECT_NEAR(fault.coefficients[1] / steel().K_rc, 1.0, 0.02);
  }
  EXPECT_TRUE(named);
}

}  // namespace trochoid::identification::systematic_test
