#include <trochoid/identification/identify.h>

#include "made_record.h"

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::identification::match_phase_test {

force::Setup with_runout() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

TEST(MatchPhase, FindsTheAngleAtWhichTheRecordBegins) {
  const force::Setup setup = with_runout();
  for (const double phase : {-2.5, 0.0, 3.0}) {
    const Record record = made_record(setup, steel(), {.phase = phase});
    const PhaseMatch match = match_phase(setup, steel(), record, std::nullopt, 1e-8);
    EXPECT_NEAR(match.phase, phase, 1e-5);
    EXPECT_LT(match.rms, 1e-4 * match.measured_rms);
  }
}

TEST(MatchPhase, KeepsAGivenPhaseAndSaysWhatIsLeft) {
  const force::Setup setup = with_runout();
  Record record = made_record(setup, steel(), {.phase = 0.4});
  for (auto& F : record.force) {
    F[1] += 3.0;
  }
  const PhaseMatch match = match_phase(setup, steel(), record, 0.4, 1e-10);
  EXPECT_DOUBLE_EQ(match.phase, 0.4);
  EXPECT_NEAR(match.rms_axis[0], 0.0, 1e-6);
  EXPECT_NEAR(match.rms_axis[1], 3.0, 1e-6);
  EXPECT_NEAR(match.rms, 3.0, 1e-6);
  EXPECT_EQ(match.computed.size(), record.angle.size());
}

/// The run brings its own cut: the feed of one record need not be that of another.
TEST(MatchPhase, TakesTheCutOfTheRun) {
  const force::Setup setup = with_runout();
  force::Setup faster = setup;
  faster.cut.f_z *= 2;
  const Record record = made_record(faster, steel(), {});
  const PhaseMatch match = match_phase(setup, steel(), record, 0.0, 1e-10);
  EXPECT_LT(match.rms, 1e-6 * match.measured_rms);
}

}  // namespace trochoid::identification::match_phase_test
