#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/problem.h>

#include <cmath>

namespace trochoid::identification::gauge_test {

Problem problem_of(const force::Setup& setup, const Record& run,
                   RunoutUnknowns runout) {
  Problem out;
  out.setup = setup;
  out.law = steel();
  out.runs = {fold(run, {})};
  out.unknowns.runout = runout;
  out.unknowns.teeth = setup.cutter.teeth();
  out.unknowns.length = setup.cut.f_z;
  out.unknowns.phases = 1;
  out.columns = 6;
  return out;
}

/// Renumbering the teeth changes nothing but the common part of the offsets.
void expect_same_answer(const Problem& problem, const Point& point) {
  const std::vector<double> before = parameters_of(problem, point);
  std::vector<double> after = before;
  EXPECT_TRUE(apply_gauge(problem, after));
  const Point named = point_of(problem, after);
  EXPECT_GE(named.phase[0], -pi / problem.unknowns.teeth);
  EXPECT_LT(named.phase[0], pi / problem.unknowns.teeth);
  std::vector<double> wrong = before;
  wrong.back() = after.back();  // the phase alone, teeth not renumbered
  const double rss = rss_at(problem, before);
  EXPECT_NEAR(rss_at(problem, after) / rss, 1.0, 1e-2);
  EXPECT_GT(rss_at(problem, wrong) / rss, 2.0);
}

TEST(Gauge, RenumberedOffsetsGiveTheSameForce) {  // [I-3]
  force::Setup setup = slot_setup(4, 30.0, 3.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8e-6, 5e-6, 3e-6};
  Sampling sampling;
  sampling.noise = 3.0;
  for (const double phase : {2.0, -2.5, 3.5}) {
    sampling.phase = phase;
    const Record run = made_record(setup, steel(), sampling);
    const Problem problem =
        problem_of(without_runout(setup), run, RunoutUnknowns::offsets);
    expect_same_answer(problem, {setup.runout, steel(), {phase}});
  }
}

TEST(Gauge, RenumberedEccentricityGivesTheSameForce) {  // [I-3]
  force::Setup setup = slot_setup(3, 30.0, 3.0 * unit::mm);
  setup.runout.eccentricity = 9e-6;
  setup.runout.angle = 0.4;
  Sampling sampling;
  sampling.noise = 3.0;
  sampling.per_turn = 60;
  sampling.phase = 2.0;
  const Record run = made_record(setup, steel(), sampling);
  const Problem problem =
      problem_of(without_runout(setup), run, RunoutUnknowns::eccentricity);
  expect_same_answer(problem, {setup.runout, steel(), {2.0}});
}

TEST(Gauge, UnequalPitchKeepsItsNumbers) {
  force::Setup setup = slot_setup(3, 30.0, 3.0 * unit::mm);
  setup.cutter.pitch = {2.0, 2.2, 2.0 * pi - 4.2};
  const Record run = made_record(setup, steel(), {});
  const Problem problem = problem_of(setup, run, RunoutUnknowns::offsets);
  EXPECT_FALSE(teeth_are_alike(problem));
  std::vector<double> p = {0.1, 0.2, 2.0 + 2.0 * pi};
  EXPECT_FALSE(apply_gauge(problem, p));
  EXPECT_NEAR(p[2], 2.0, 1e-12);
  EXPECT_NEAR(p[0], 0.1, 1e-12);
}

}  // namespace trochoid::identification::gauge_test
