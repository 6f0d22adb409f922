#include "made_program.h"

#include <trochoid/engagement/feed.h>
#include <trochoid/stock/path.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::engagement::feed_test {

const stock::Initial block = box({-40, -40, -10}, {40, 40, 0});

/// A wall, then a corner of the pocket before: more stock.
MadeProgram corner() {
  MadeProgram made(6000, 1200);
  made.rapid(-50, 44, 5).rapid(-50, 44, -2).line(20, 44, -2).line(20, 20, -2);
  return made;
}

TEST(LargestFeeds, AStepIsAtItsLimitOrAtTheEndOfTheRange) {  // [N-14]
  const Tool tool = end_mill(10, 3, 30, {4, -3, -1});
  const MadeProgram made = corner();
  const Job job{made.program, std::span(&tool, 1), block, {}};
  Limits limits;
  limits.peak_xy = 150;
  int held = 0;
  for (const WantedFeed& w : largest_feeds(job, limits, {0.1, 1.5})) {
    EXPECT_TRUE(w.reachable);
    EXPECT_LE(w.feed, 1.5 * w.programmed * (1 + 1e-12));
    if (w.held != Held::peak_xy) continue;
    ++held;
    // The same turn in a program that has this feed from the start.
    MadeProgram slow(6000, w.feed / unit::mm_per_min);
    slow.rapid(-50, 44, 5).rapid(-50, 44, -2).line(20, 44, -2).line(20, 20, -2);
    const double piece = w.line == 3 ? 70e-3 : 24e-3;
    const Step step = at(slow, tool, block, w.line, 0.5 * (w.from + w.to) / piece);
    EXPECT_LE(step.forces.peak_xy, limits.peak_xy * 1.001);
  }
  EXPECT_GT(held, 20);
}

TEST(LargestFeeds, SayWhereNoFeedKeepsALimit) {
  const Tool tool = end_mill(10, 3, 30);
  const MadeProgram made = corner();
  const Job job{made.program, std::span(&tool, 1), block, {}};
  Limits limits;
  limits.peak_xy = 15;  // edge forces alone are more
  const auto wanted = largest_feeds(job, limits, {0.2, 1.0});
  const auto bad = std::ranges::find(wanted, false, &WantedFeed::reachable);
  ASSERT_NE(bad, wanted.end());
  EXPECT_NEAR(bad->feed, 0.2 * bad->programmed, 1e-12);
  EXPECT_EQ(wanted.front().held, Held::not_cutting);
  EXPECT_EQ(wanted.front().feed, wanted.front().programmed);
}

TEST(LargestFeeds, SayWhereTheEdgesRub) {
  const Tool tool = end_mill(10, 3, 30);
  const MadeProgram made = corner();
  const Job job{made.program, std::span(&tool, 1), block, {}};
  Limits limits;
  limits.chip = 20e-6;
  limits.least_chip = 15e-6;
  for (const WantedFeed& w : largest_feeds(job, limits, {0.01, 1.0})) {
    EXPECT_FALSE(w.rubs && w.held == Held::chip);
  }
  limits.peak_xy = 40;
  const auto wanted = largest_feeds(job, limits, {0.01, 1.0});
  EXPECT_TRUE(std::ranges::any_of(wanted, &WantedFeed::rubs));
}

TEST(LargestFeeds, PowerOfTheSpindleDependsOnItsSpeed) {
  Limits limits;
  limits.power_curve = {{100, 1000}, {200, 3000}};
  EXPECT_DOUBLE_EQ(power_at(limits, 50), 1000);
  EXPECT_DOUBLE_EQ(power_at(limits, 150), 2000);
  EXPECT_DOUBLE_EQ(power_at(limits, 900), 3000);
  limits.power = 500;
  EXPECT_DOUBLE_EQ(power_at(limits, 150), 500);
}

TEST(FeedParts, CoverEachMoveAndNeverExceedAStep) {
  const Tool tool = end_mill(10, 3, 30, {4, -3, -1});
  const MadeProgram made = corner();
  const Job job{made.program, std::span(&tool, 1), block, {}};
  Limits limits;
  limits.peak_xy = 150;
  const auto wanted = largest_feeds(job, limits, {0.1, 1.5});
  const auto parts = feed_parts(job, wanted);
  double end = 1.0;
  std::uint32_t move = 0;
  for (const program::FeedPart& part : parts) {
    EXPECT_DOUBLE_EQ(part.from, part.move == move ? end : 0.0);
    if (part.move != move) {
      EXPECT_DOUBLE_EQ(end, 1.0);
    }
    move = part.move;
    end = part.to;
    const double length = part.move == 2 ? 70e-3 : 24e-3;
    for (const WantedFeed& w : wanted) {
      const bool within = w.line == made.program.moves[part.move].line &&
                          w.to > part.from * length + 1e-9 &&
                          w.from < part.to * length - 1e-9;
      if (within) {
        EXPECT_LE(part.feed, w.feed * (1 + 1e-12));
      }
    }
  }
  EXPECT_DOUBLE_EQ(end, 1.0);
}

TEST(FeedParts, BeginASlowPartAsEarlyAsBrakingDoes) {  // [N-15]
  const Tool tool = end_mill(10, 3, 30);
  const MadeProgram made = corner();
  Job job{made.program, std::span(&tool, 1), block, {}};
  const stock::Path path = stock::path(made.program.moves, 1.0);
  const auto first = static_cast<std::uint32_t>(
      std::ranges::find_if(path.pieces, [](const auto& p) { return p.feed > 0; }) -
      path.pieces.begin());
  std::vector<WantedFeed> wanted;
  for (int i = 0; i < 70; ++i) {  // 1 mm each
    wanted.push_back({.piece = first,
                      .from = i * 1e-3,
                      .to = (i + 1) * 1e-3,
                      .along = (i + 0.5) * 1e-3,
                      .programmed = 0.02,
                      .feed = i < 40 ? 0.02 : 0.005});
  }
  const auto slow_from = [&] {
    const auto parts = feed_parts(job, wanted);
    EXPECT_EQ(parts.size(), 2U);
    EXPECT_DOUBLE_EQ(parts.back().feed, 0.005);
    return parts.back().from * 70;
  };
  EXPECT_NEAR(slow_from(), 40, 1e-9);
  // (0.02^2 - 0.005^2)/(2 * 0.02) is 9.375 mm of path.
  job.options.drives = stock::Drives{.acceleration = {0.02, 0.02, 0.02}};
  EXPECT_NEAR(slow_from(), 30, 1e-9);
}

}  // namespace trochoid::engagement::feed_test
