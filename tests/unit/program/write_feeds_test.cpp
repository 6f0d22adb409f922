#include <trochoid/program/write_feeds.h>

#include <trochoid/base/units.h>
#include <trochoid/program/read_program.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

namespace trochoid::program::write_feeds_test {

namespace {

constexpr double per_minute = 1e-3 / 60;  // mm/min

Program read(const std::string& text) {
  ReadOptions options;
  options.offsets["G54"] = {0.0, 0.0, 0.0};
  options.offsets["G55"] = {0.06, 0.0, 0.0};
  ProgramText out = read_program(text, options);
  for (const Problem& p : out.problems) {
    ADD_FAILURE() << p.place.line << ":" << p.place.column << ": " << p.text << "\n"
                  << text;
  }
  return std::move(out.program);
}

bool is_fed(const Move& move) {
  return move.kind != MoveKind::rapid && move.kind != MoveKind::dwell;
}

/// A feed for all of a line, or for two parts of it.
std::vector<FeedPart> parts_of_line(
    const Program& program, std::uint32_t line,
    std::vector<std::pair<double, double>> to_and_feed) {
  std::vector<FeedPart> out;
  for (std::uint32_t m = 0; m < program.moves.size(); ++m) {
    if (program.moves[m].line != line || !is_fed(program.moves[m])) continue;
    double from = 0.0;
    for (const auto& [to, feed] : to_and_feed) {
      out.push_back({m, from, to, feed * per_minute});
      from = to;
    }
  }
  return out;
}

std::string written(const std::string& text, std::uint32_t line,
                    std::vector<std::pair<double, double>> to_and_feed,
                    bool split = true) {
  const Program program = read(text);
  return write_feeds(text, program,
                     parts_of_line(program, line, std::move(to_and_feed)), split);
}

}  // namespace

const std::string head = "G21 G90\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0\n";

TEST(WriteFeeds, ChangesNothingWithoutParts) {
  const std::string text =
      head + "N5 g1x10 y5.5 f600 (fast)\r\nG2 X20 I5 ; arc\r\nM2\r\n";
  EXPECT_EQ(write_feeds(text, read(text), {}), text);
}

TEST(WriteFeeds, ReplacesFAndGivesTheOldOneBack) {
  EXPECT_EQ(written(head + "G1 X10 F600\nX20\nX30\n", 6, {{1.0, 123.456}}),
            head + "G1 X10 F600\nX20 F123.4\nX30 F600\n");
  EXPECT_EQ(written(head + "G1 X10 F600.\nX20\n", 5, {{1.0, 400}}),
            head + "G1 X10 F400.\nX20 F600.\n");
}

TEST(WriteFeeds, RoundsDown) {
  EXPECT_EQ(written(head + "G1 X10 F9000\n", 5, {{1.0, 1234.9}}),
            head + "G1 X10 F1234\n");
  EXPECT_EQ(written(head + "G1 X10 F9000\n", 5, {{1.0, 0.123456}}),
            head + "G1 X10 F0.1234\n");
}

TEST(WriteFeeds, SplitsALine) {
  EXPECT_EQ(
      written(head + "N7 G1 X10 Y20 F600 (side)\nX0\n", 5, {{0.25, 600}, {1, 200}}),
      head + "N7 G1 X2.5 Y5. F600 (side)\nX10 Y20 F200\nX0 F600\n");
  EXPECT_EQ(written(head + "G91 G1 X10 F600\n", 5, {{0.5, 300}, {1, 200}}),
            head + "G91 G1 X5. F300\nX5. F200\n");
}

TEST(WriteFeeds, ALastLineWithoutAnEndIsSplitAsTheOthersEnd) {
  EXPECT_EQ(written("G21 G90\rT1 M6\rS1000 M3\rG0 X0 Y0 Z0\rG1 X10 F600", 5,
                    {{0.25, 600}, {1, 200}}),
            "G21 G90\rT1 M6\rS1000 M3\rG0 X0 Y0 Z0\rG1 X2.5 F600\rX10 F200");
}

TEST(WriteFeeds, SplitsAnArc) {
  EXPECT_EQ(written(head + "G1 X1 F600\nG3 X-1 I-1\n", 6, {{0.5, 600}, {1, 200}}),
            head + "G1 X1 F600\nG3 X0. I-1 Y1.\nG3 X-1 Y0. I0. J-1. F200\n");
  EXPECT_EQ(written(head + "G1 X1 F600\nG3 X-1 R1\n", 6, {{0.5, 600}, {1, 200}}),
            head + "G1 X1 F600\nG3 X0. I-1. J0. Y1.\nG3 X-1 Y0. I0. J-1. F200\n");
}

TEST(WriteFeeds, ASplitHalfCircleByItsRadiusStaysOnItsCircle) {
  const std::string text = head + "G1 X50.123 Y7.457 F600\nG3 X-49.877 R50.\n";
  const Program after = read(written(text, 6, {{0.0137, 600}, {0.993, 200}, {1, 600}}));
  ASSERT_EQ(after.moves.size(), 5U);
  for (std::size_t m = 2; m < 5; ++m) {
    const Move& arc = after.moves[m];
    const auto& start = after.moves[m - 1].end;
    const double from = std::atan2(start[1] - arc.center[1], start[0] - arc.center[0]);
    const double r = std::hypot(start[1] - arc.center[1], start[0] - arc.center[0]);
    for (const double u : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const double x = arc.center[0] + r * std::cos(from + u * arc.turn);
      const double y = arc.center[1] + r * std::sin(from + u * arc.turn);
      EXPECT_NEAR(std::hypot(x - 0.123e-3, y - 7.457e-3), 50e-3, 1.5e-6) << m;
    }
  }
}

TEST(WriteFeeds, AFeedBesideADwellOrBehindASlashIsWrittenAgain) {
  EXPECT_EQ(written(head + "G1 X10 F300\n/X20 F100\nX30\n", 5, {{1, 30}}),
            head + "G1 X10 F30\n/X20 F100\nX30 F100\n");
  EXPECT_EQ(written(head + "G1 X10 F300\nG4 P0.1 F300\nG1 X20\nX30\n", 7, {{1, 30}}),
            head + "G1 X10 F300\nG4 P0.1 F300\nG1 X20 F30\nX30 F300\n");
  const std::string slow = "G1 X10 F300\nX15 F30\n";
  const std::string given = head + "G1 X10 F300\nX15\nG4 P0.1 F300\nG1 X20\n";
  EXPECT_EQ(
      write_feeds(
          given, read(given),
          [&] {
            auto parts = parts_of_line(read(given), 6, {{1, 30}});
            for (const FeedPart& part : parts_of_line(read(given), 8, {{1, 30}})) {
              parts.push_back(part);
            }
            return parts;
          }()),
      head + slow + "G4 P0.1 F300\nG1 X20 F30\n");
}

TEST(WriteFeeds, DoesNotSplitWhatHoldsMoreThanAMove) {
  for (const std::string block :
       {"G1 X10 F600 M0", "G1 X10 F600 H1", "/G1 X10 F600", "G1 G9 X10 F600",
        "G1 X10 F600 M5", "G18 G2 X10 Z0 R5 F600"}) {
    std::string slow = block;
    slow.replace(slow.find("600"), 3, "200");
    EXPECT_EQ(written(head + block + "\n", 5, {{0.5, 600}, {1, 200}}),
              head + slow + "\n");
  }
  EXPECT_EQ(written(head + "G1 X10 F600\n", 5, {{0.5, 600}, {1, 200}}, false),
            head + "G1 X10 F200\n");
}

TEST(WriteFeeds, KnowsOtherUnitsOfTheFeed) {
  EXPECT_EQ(written(head + "G95 G1 X10 F0.6\n", 5, {{1, 200}}),
            head + "G95 G1 X10 F0.2\n");
  EXPECT_EQ(written(head + "G93 G1 X10 F60\nX20 F60\n", 5, {{0.5, 300}, {1, 150}}),
            head + "G93 G1 X5. F60\nX10 F30\nX20 F60\n");
  EXPECT_EQ(
      written("G20 G90\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0\nG1 X1 F10\n", 5, {{1, 127}}),
      "G20 G90\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0\nG1 X1 F5\n");
}

TEST(WriteFeeds, ADwellOfSinumerikIsNoFeed) {
  const std::string text =
      "G710 G90\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0\nG1 X10 F600\nG4 F2\nX=AC(20)\n";
  EXPECT_EQ(
      written(text, 5, {{1, 300}}),
      "G710 G90\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0\nG1 X10 F300\nG4 F2\nX=AC(20) F600\n");
}

namespace {

/// Program with every kind of move that is fed.
const std::string mixed =
    "G21 G90 G54\nT1 M6\nS3000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F200\nN10 G1 X10.123 Y-3.5 F900\n"
    "G2 X20.123 Y-3.5 I5 J0\nG3 X20.123 Y-3.5 I-4 J0 F700\nG91 G1 X5 Y1 Z-.5\nG2 X2 Y2 R4\n"
    "G3 X-3 Y1 R-5\nG90.1 G90 G3 X34.123 Y.5 I29.123 J.5\nG91.1 G55 G1 X0 Y0 F800.\n"
    "G81 X5 Y5 Z-3 R2 F150\nX8\nG80\nG20\nF30\nG1 X.5 Y.25\nG2 X.75 Y.25 I.125\n"
    "G94 G21\nF500\nG1 X0\nG3 X0 Y10 Z-2 J1.825 (helix)\nM2\n";

/// Ends of the fed moves that a program has, without those that a split added.
void expect_same_path(const Program& before, const Program& after) {
  std::size_t k = 0;
  for (const Move& move : before.moves) {
    double length = 0.0;
    double time = 0.0;
    for (; k < after.moves.size(); ++k) {
      const Move& part = after.moves[k];
      length += is_fed(part) ? part.feed * part.time : 0.0;
      time += part.time;
      const double far =
          std::hypot(part.end[0] - move.end[0], part.end[1] - move.end[1],
                     part.end[2] - move.end[2]);
      const double rest = is_fed(move) ? move.feed * move.time - length : 0.0;
      if (!(far > 1e-9) && std::abs(rest) < 20e-6) break;  // NaN: not known
    }
    ASSERT_LT(k, after.moves.size()) << "line " << move.line;
    if (is_fed(move)) {
      EXPECT_NEAR(length, move.feed * move.time, 20e-6);
      EXPECT_GE(time, 0.999 * move.time) << "no feed is higher than asked for";
    }
    ++k;
  }
  EXPECT_EQ(k, after.moves.size());
}

}  // namespace

TEST(WriteFeeds, LeavesThePathAsItIs) {
  const Program program = read(mixed);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> factor(0.2, 1.0);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<FeedPart> parts;
    std::vector<double> slowest;
    for (std::uint32_t m = 0; m < program.moves.size(); ++m) {
      const Move& move = program.moves[m];
      if (!is_fed(move) || random() % 3 == 0) continue;
      const std::size_t n = 1 + random() % 4;
      for (std::size_t i = 0; i < n; ++i) {
        const auto part = [&](std::size_t k) {
          return static_cast<double>(k) / static_cast<double>(n);
        };
        parts.push_back({m, part(i), part(i + 1), factor(random) * move.feed});
      }
    }
    const std::string text = write_feeds(mixed, program, parts);
    expect_same_path(program, read(text));
    if (HasFailure()) {
      FAIL() << text;
    }
  }
}

}  // namespace trochoid::program::write_feeds_test
