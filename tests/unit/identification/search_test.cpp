#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/runout_starts.h>
#include <trochoid/identification/search.h>

#include <cmath>

namespace trochoid::identification::search_test {

force::Setup with_offsets(int teeth, double helix_deg) {
  force::Setup setup = slot_setup(teeth, helix_deg, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 9.0 * unit::um, -6.0 * unit::um, 3.0 * unit::um};
  setup.runout.radial_offsets.resize(static_cast<std::size_t>(teeth));
  return setup;
}

void expect_same(const Fit& a, const Fit& b) {
  ASSERT_TRUE(a.ok && b.ok) << a.message << b.message;
  EXPECT_NEAR(a.rms, b.rms, 1e-6 * a.rms);
  EXPECT_NEAR(a.phase[0], b.phase[0], 1e-4);
  EXPECT_NEAR(a.coefficients[0]->value, b.coefficients[0]->value,
              0.02 * a.coefficients[0]->se);
}

/// A start, good or bad, changes the work and not the answer.
TEST(Search, AnswersTheSameFromAnyStart) {  // [I-3]
  for (const int teeth : {2, 3}) {
    const force::Setup setup = with_offsets(teeth, 30.0);
    const std::vector<Record> runs = {
        made_record(setup, steel(), {0.3, 180, 2.0, 5.0, 2})};
    const Fit blind = identify(without_runout(setup), steel(), runs, {});
    for (const double factor : {0.9, -1.0, 6.0}) {
      force::Setup given = setup;
      for (double& s : given.runout.radial_offsets) s *= factor;
      expect_same(identify(given, steel(), runs, {}), blind);
      Options options;
      options.start = Start{given.runout, {0.3 * factor}};
      expect_same(identify(without_runout(setup), steel(), runs, options), blind);
    }
  }
}

/// The smooth problem of a straight edge leads to the minimum between the jumps.
TEST(Search, SmoothProblemIsNearTheOneThatJumps) {
  const force::Setup setup = with_offsets(2, 0.0);
  const std::vector<Record> runs = {
      made_record(setup, steel(), {0.301, 180, 1.0, 0.0, 1})};
  const Problem problem = *prepare(without_runout(setup), steel(), runs, {}).problem;
  ASSERT_TRUE(sum_of_squares_jumps(problem));
  const Problem smooth = smooth_problem(problem);
  EXPECT_FALSE(sum_of_squares_jumps(smooth));
  const Minimum near = coarse_search(smooth, scan(problem, runout_starts(problem)));
  const double cell = 2.0 * pi / 180.0;
  EXPECT_NEAR(near.p[1], 0.301, 0.5 * cell);
  const Minimum exact = refine_between_jumps(problem, near.p);
  EXPECT_NEAR(exact.p[1], 0.301, 1e-6);
  EXPECT_LT(exact.rss, 1e-6);
}

TEST(Search, OneStartServesAllNumbersOfTheTeeth) {
  const std::vector<Record> runs = {made_record(with_offsets(4, 30.0), steel(), {})};
  const force::Setup setup = without_runout(with_offsets(4, 30.0));
  const Problem free = *prepare(setup, steel(), runs, {}).problem;
  const Problem known = *prepare(setup, steel(), runs, {.phase = 0.0}).problem;
  EXPECT_LT(runout_starts(free).size(),
            0.7 * static_cast<double>(runout_starts(known).size()));
}

}  // namespace trochoid::identification::search_test
