#include <trochoid/program/read_program.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// What a text makes the machine do: every kind of word once.
namespace trochoid::program::read_program_test {

namespace {

constexpr double mm = 1e-3;

ProgramText read(const std::string& text, Dialect dialect = Dialect::iso) {
  ReadOptions options;
  options.dialect = dialect;
  return read_program(text, options);
}

/// Ready to cut at X0 Y0 Z0, moving at F.
const std::string head = "G21 G90 G17\nT1 M6\nS1000 M3\nG0 X0 Y0 Z0\nF600\n";

std::vector<Move> moves_behind_head(const std::string& text,
                                    Dialect dialect = Dialect::iso) {
  ProgramText read_text = read(head + text, dialect);
  for (const Problem& p : read_text.problems) ADD_FAILURE() << p.text;
  auto moves = read_text.program.moves;
  if (!moves.empty()) moves.erase(moves.begin());
  return moves;
}

/// `line:column` of every problem.
std::string places(const ProgramText& text) {
  std::string all;
  for (const Problem& p : text.problems) {
    all += std::to_string(p.place.line) + ':' + std::to_string(p.place.column) + ' ';
  }
  return all;
}

std::string warnings(const ProgramText& text) {
  std::string all;
  for (const Remark& r : text.remarks) {
    all += std::string(r.code) + '@' + std::to_string(r.place.line) + ' ';
  }
  return all;
}

}  // namespace

TEST(ReadProgram, AWordMayBeWrittenInManyWays) {
  const auto moves =
      moves_behind_head("g01 x 1.5 y+2 f100.\r\nN5G1X1.5Y-.5\r\n\tG01X+.5");
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[0].end[0], 1.5 * mm);
  EXPECT_EQ(moves[0].end[1], 2 * mm);
  EXPECT_NEAR(moves[0].feed, 100 * mm / 60, 1e-15);
  EXPECT_EQ(moves[1].end[1], -0.5 * mm);
  EXPECT_EQ(moves[1].block, 5);
  EXPECT_EQ(moves[1].line, 7U);
  EXPECT_EQ(moves[2].end[0], 0.5 * mm);
  EXPECT_EQ(moves[2].block, -1);
}

TEST(ReadProgram, LinesEndAsOnAnySystem) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto text = read("G21" + end + end + "G1 X5" + end);
    EXPECT_EQ(places(text), "3:4 ");
  }
}

TEST(ReadProgram, ColumnsCountCharacters) {
  EXPECT_EQ(places(read("(\xC3\xA4\xC3\xB6) G1 E5\n")), "1:9 ");
  EXPECT_EQ(places(read("(\xE4\xF6) G1 E5\n")), "1:9 ") << "Latin 1";
  EXPECT_EQ(places(read("\xEF\xBB\xBF"
                        "E5\n")),
            "1:1 ")
      << "a byte order mark is no character";
}

TEST(ReadProgram, IncrementsAddUp) {
  const auto moves = moves_behind_head("G91 G1 X1 Y2\nX1\nG90 X7");
  ASSERT_EQ(moves.size(), 3U);
  EXPECT_EQ(moves[1].end[0], 2 * mm);
  EXPECT_EQ(moves[1].end[1], 2 * mm);
  EXPECT_EQ(moves[2].end[0], 7 * mm);
}

TEST(ReadProgram, AToolThatIsOnlyLoadedIsNone) {
  const auto text = read(head + "T7\nG1 X5\nT3\nM6\nG1 X6\nT9\n");
  EXPECT_EQ(text.program.tools, (std::vector<std::string>{"1", "3"}));
  EXPECT_EQ(text.program.moves.back().tool, 1);
}

TEST(ReadProgram, APlaneOfZerosStaysLevel) {
  const std::string level =
      "CYCLE800(0,\"TC1\",0,27,0,0,0, 0,-0.0,0,0,0,0,-1)\nG1 X5\n";
  EXPECT_EQ(moves_behind_head(level, Dialect::sinumerik).size(), 1U);
  // With a first argument it lifts: where to is not in the program.
  const auto lifted = moves_behind_head(
      "CYCLE800(1,\"TC1\",200000,27,,,,0,0,0,,,,1,,0)\nG0 X7\nZ1\nG1 Z0\n",
      Dialect::sinumerik);
  ASSERT_EQ(lifted.size(), 4U);
  EXPECT_TRUE(std::isnan(lifted[0].end[2]));
  EXPECT_EQ(lifted[2].end[2], 1 * mm);
  const auto tilted = read(head + "CYCLE800(0,\"TC1\",0,27,0,0,0,0,30,0,0,0,0,-1)\n",
                           Dialect::sinumerik);
  EXPECT_EQ(places(tilted), "6:1 ");
}

TEST(ReadProgram, AFixedPointOfTheMachineIsUnknown) {
  const auto moves = moves_behind_head("G1 X5\nG75 X0 Z0\n", Dialect::sinumerik);
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[1].note, MoveNote::retract);
  EXPECT_TRUE(std::isnan(moves[1].end[0]));
  EXPECT_EQ(moves[1].end[1], 0.0);
  EXPECT_TRUE(std::isnan(moves[1].end[2]));
}

TEST(ReadProgram, InchesCount25Point4) {
  const auto moves = moves_behind_head("G20\nG1 X1 F10");
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_NEAR(moves[0].end[0], 25.4 * mm, 1e-15);
  EXPECT_NEAR(moves[0].feed, 254 * mm / 60, 1e-15);
}

TEST(ReadProgram, AFeedIsForgottenWithItsUnit) {
  EXPECT_EQ(places(read(head + "G20\nG1 X1")), "7:1 ");
  EXPECT_EQ(places(read(head + "G20 F10\n")), "6:5 ") << "in which unit?";
  EXPECT_EQ(places(read(head + "G95\nG1 X1")), "7:1 ");
  EXPECT_EQ(places(read(head + "G21\nG1 X1")), "") << "no change";
}

TEST(ReadProgram, FeedIsByMinuteByTurnOrByTime) {
  EXPECT_NEAR(moves_behind_head("G95 G1 X5 F0.2")[0].feed, 200 * mm / 60, 1e-15);
  const auto inverse = moves_behind_head("G93 G1 X3 Y4 F2");
  EXPECT_NEAR(inverse[0].feed, 10 * mm / 60, 1e-15) << "5 mm, twice a minute";
  EXPECT_NEAR(inverse[0].time, 30, 1e-12);
  EXPECT_EQ(places(read(head + "G93 G1 X3 F2\nX4")), "7:1 ") << "F in every block";
}

TEST(ReadProgram, AnArcTurnsAboutItsCenter) {
  const auto moves =
      moves_behind_head("G3 X10 Y10 J10\nG2 X0 Y0 R10\nG2 I5\nG3 X10 R-5.1");
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[0].kind, MoveKind::arc);
  EXPECT_NEAR(moves[0].center[1], 10 * mm, 1e-15);
  EXPECT_NEAR(moves[0].turn, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(moves[1].turn, -std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(moves[2].turn, -2 * std::numbers::pi, 1e-12) << "a whole circle";
  EXPECT_GT(moves[3].turn, std::numbers::pi) << "R < 0: the longer arc";
}

TEST(ReadProgram, AHalfCircleByItsRadiusIsExact) {
  // Coordinates in thousandths: R^2 less the square of half the chord is rounding.
  const auto moves = moves_behind_head(
      "G2 X0.1 Y0.7 R0.353553390593274\nG2 X10.1 R5\nG3 X16.1 Y8.7 R-5.\n");
  for (const program::Move& move : moves) {
    EXPECT_NEAR(std::abs(move.turn), std::numbers::pi, 1e-9);
  }
  EXPECT_NEAR(moves[1].center[0], 5.1e-3, 1e-15);
  EXPECT_NEAR(moves[1].center[1], 0.7e-3, 1e-15);
}

TEST(ReadProgram, AStartThatIsGivenLetsAFeedMoveBeTheFirst) {
  const std::string text = "G21 G90 S1000 M3 F100\nG1 X5 Z-1\nG28 Z0\nG1 Z-2";
  const auto without = program::read_program(text, {});
  ASSERT_EQ(without.problems.size(), 1U);
  EXPECT_NE(without.problems[0].text.find("start_mm"), std::string::npos);
  const auto given = program::read_program(
      text, {.origin = {1e-3, 0.0, 0.0}, .start = {{0.0, 2e-3, 3e-3}}});
  ASSERT_EQ(given.problems.size(), 1U) << "of the axis that left";
  EXPECT_EQ(given.problems[0].place.line, 4U);
  EXPECT_EQ(given.problems[0].text.find("start_mm"), std::string::npos);
  const auto moves =
      program::read_program("G21 G90 S1000 M3 F100\nG1 X5 Z-1",
                            {.origin = {1e-3, 0.0, 0.0}, .start = {{0.0, 2e-3, 3e-3}}})
          .program.moves;
  ASSERT_EQ(moves.size(), 2U);
  EXPECT_EQ(moves[0].note, program::MoveNote::start);
  EXPECT_NEAR(moves[0].end[0], 1e-3, 1e-15);
  EXPECT_NEAR(moves[1].end[0], 6e-3, 1e-15);
  EXPECT_NEAR(moves[1].end[1], 2e-3, 1e-15);
}

TEST(ReadProgram, TheEndOfAMirrorIsNoMove) {
  const auto moves = moves_behind_head("G0 X5 Y7\nG50.1 X0 Y0 Z0\nG1 X6 F100");
  ASSERT_EQ(moves.size(), 2u);
  EXPECT_NEAR(moves[1].end[0], 6e-3, 1e-15);
  EXPECT_NEAR(moves[1].end[1], 7e-3, 1e-15);
  EXPECT_EQ(places(read(head + "G0 X5\nG50.1 G1 X60 F600")), "7:10 ")
      << "the end of a mirror, or a place?";
}

TEST(ReadProgram, InchesAndMillimetresByG70AndG71) {
  for (const Dialect dialect : {Dialect::iso, Dialect::linuxcnc}) {
    const auto moves = moves_behind_head("G70 G0 X1\nG71 G0 X5", dialect);
    EXPECT_NEAR(moves[0].end[0], 25.4e-3, 1e-15);
    EXPECT_NEAR(moves[1].end[0], 5e-3, 1e-15);
  }
}

TEST(ReadProgram, ACenterIsMovedOntoTheBisector) {
  // The center is 4 um off: both ends are equally far from where it is put.
  const auto moves = moves_behind_head("G3 X20 Y0 I10.004 J0");
  ASSERT_EQ(moves.size(), 1U);
  EXPECT_NEAR(moves[0].center[0], 10 * mm, 1e-15);
  EXPECT_EQ(places(read(head + "G3 X20 Y0 I10.02 J0")), "6:11 ")
      << "20 um are too many";
}

TEST(ReadProgram, EndsThatAreNearlyTheSameAreNoCircle) {
  const auto text = read(head + "G2 X0.0005 I5 J0");
  ASSERT_EQ(text.program.moves.size(), 2U);
  EXPECT_EQ(text.program.moves[1].kind, MoveKind::line);
  EXPECT_EQ(warnings(text), "tiny_arc@6 ");
}

TEST(ReadProgram, AnArcOfAnotherPlaneBecomesChords) {
  const auto moves = moves_behind_head("G18 G2 X20 Z0 I10 K0");
  ASSERT_GT(moves.size(), 100U);
  double lowest = 0.0;
  for (const Move& m : moves) {
    EXPECT_EQ(m.kind, MoveKind::chord);
    EXPECT_EQ(m.line, 6U);
    EXPECT_NEAR(std::hypot(m.end[0] - 10 * mm, m.end[2]), 10 * mm, 1e-12);
    lowest = std::min(lowest, m.end[2]);
  }
  EXPECT_NEAR(lowest, -10 * mm, 1e-7) << "clockwise seen from +y";
  const double step = std::numbers::pi / static_cast<double>(moves.size());
  EXPECT_LT(10 * mm * (1 - std::cos(step / 2)), 0.1e-6) << "sagitta of a chord";
}

TEST(ReadProgram, TurnsOfAHelix) {
  const auto linuxcnc = moves_behind_head("G3 X0 Y0 Z-3 I5 P3", Dialect::linuxcnc);
  EXPECT_NEAR(linuxcnc.at(0).turn, 6 * std::numbers::pi, 1e-12);
  const auto sinumerik =
      moves_behind_head("G3 X0 Y0 Z-3 I5 J0 TURN=2", Dialect::sinumerik);
  EXPECT_NEAR(sinumerik.at(0).turn, 6 * std::numbers::pi, 1e-12);
}

TEST(ReadProgram, ADwellTakesSecondsOrMilliseconds) {
  EXPECT_EQ(moves_behind_head("G4 P0.5")[0].time, 0.5);
  EXPECT_EQ(moves_behind_head("G4 P500")[0].time, 0.5) << "Fanuc and Haas";
  EXPECT_EQ(moves_behind_head("G4 P500", Dialect::linuxcnc)[0].time, 500);
  EXPECT_EQ(moves_behind_head("G4 U1.5")[0].time, 1.5);
  const auto moves = moves_behind_head("G4 F2\nG1 X5", Dialect::sinumerik);
  EXPECT_EQ(moves[0].time, 2);
  EXPECT_NEAR(moves[1].feed, 600 * mm / 60, 1e-15) << "F of a dwell is no feed";
}

TEST(ReadProgram, AToolChangeStopsTheSpindle) {
  const auto moves = moves_behind_head("G1 X1\nT12 M6\nX2\nM6 T3 M3\nX3");
  EXPECT_GT(moves[0].spindle, 0);
  EXPECT_EQ(moves[1].spindle, 0);
  EXPECT_GT(moves[2].spindle, 0) << "M3 comes after M6 of its block";
  const auto text = read("T7\nS100 M3\nG0 X0 Y0 Z0\nG1 X1. F1\n");
  EXPECT_EQ(warnings(text), "tool_without_m6@1 ");
  EXPECT_EQ(text.program.tools, std::vector<std::string>{"7"});
}

TEST(ReadProgram, WhatIsNotInTheProgramIsNotKnown) {
  const auto text = read("G28 G91 Z0\nG90 G0 X1. Y2.\nZ5\nG53 Z0\n");
  ASSERT_EQ(places(text), "");
  const auto& moves = text.program.moves;
  ASSERT_EQ(moves.size(), 4U);
  EXPECT_EQ(moves[0].note, MoveNote::retract);
  EXPECT_TRUE(std::isnan(moves[1].end[2]));
  EXPECT_EQ(moves[1].time, 0);
  EXPECT_EQ(moves[2].end[2], 5 * mm);
  EXPECT_TRUE(std::isnan(moves[3].end[2]));
  EXPECT_EQ(places(read("G28 G91 Z5\n")), "1:9 ") << "from an unknown place";
  EXPECT_EQ(places(read("G1 X5 Y5 Z5 F100\n")), "1:4 ");
}

TEST(ReadProgram, WorkOffsetsNeedTheirPlaces) {
  ReadOptions options;
  options.offsets["G54"] = {1 * mm, 0, 0};
  options.offsets["G55"] = {2 * mm, 0, 0};
  options.origin = {10 * mm, 0, 0};
  const auto text = read_program("G54 G0 X0\nG55 X0\nG56 X0\n", options);
  EXPECT_EQ(places(text), "3:1 ");
  EXPECT_EQ(text.program.moves.at(0).end[0], 11 * mm);
  EXPECT_EQ(text.program.moves.at(1).end[0], 12 * mm);
}

TEST(ReadProgram, NothingBehindTheEndIsRead) {
  EXPECT_EQ(read("%\nG0 X1\n%\nnonsense").program.moves.size(), 1U);
  EXPECT_EQ(read("G0 X1\nM30\nnonsense").program.moves.size(), 1U);
}

TEST(ReadProgram, BlocksWithASlashMayBeLeftOut) {
  ReadOptions options;
  EXPECT_EQ(read_program("G0 X1\n/G0 X2\n", options).program.moves.size(), 2U);
  options.block_delete = true;
  EXPECT_EQ(read_program("G0 X1\n/G0 X2 nonsense\n", options).program.moves.size(), 1U);
}

TEST(ReadProgram, WordsAreIgnoredByConsentOnly) {
  ReadOptions options;
  EXPECT_EQ(places(read_program("M10 P2\n", options)), "1:1 ");
  options.ignored_words = {"M10"};
  EXPECT_EQ(places(read_program("m010 P2\n", options)), "");
  options.ignored_words = {"M98"};
  EXPECT_EQ(places(read_program("M98 P2\n", options)), "1:1 ")
      << "what the load depends on stays a problem";
}

TEST(ReadProgram, CompensationIsRefusedOrOfWear) {
  ReadOptions options;
  EXPECT_EQ(places(read_program("G0 X0 Y0 Z0\nG41 D1 G1 X1 F9\n", options)), "2:1 ");
  options.wear_zero = true;
  EXPECT_EQ(places(read_program("G0 X0 Y0 Z0\nG41 D1 G1 X1 F9\n", options)), "");
}

TEST(ReadProgram, TheDialectShows) {
  const auto found = [](const std::string& text, const std::string& name = "") {
    ReadOptions options;
    options.name = name;
    return read_program(text, options).program.dialect;
  };
  EXPECT_EQ(found("G0 X1 (CR=5 IC(3)\n"), Dialect::iso) << "comments do not count";
  EXPECT_EQ(found("G0 X1\n", "a.ngc"), Dialect::linuxcnc);
  EXPECT_EQ(found("G0 X1\n", "a.MPF"), Dialect::sinumerik);
  EXPECT_EQ(found("G2 X1 CR = 5\n", "a.nc"), Dialect::sinumerik);
  EXPECT_EQ(found("G710\n"), Dialect::sinumerik);
  EXPECT_EQ(found("G64 P0.01\n"), Dialect::linuxcnc);
  EXPECT_EQ(found("o100 sub\n"), Dialect::linuxcnc);
}

TEST(ReadProgram, AtMostFiftyProblemsAreTold) {
  std::string text;
  for (int i = 0; i < 200; ++i) text += "E1 E2 E3\n";
  EXPECT_EQ(read(text).problems.size(), 50U);
}

TEST(ReadProgram, WhatFollowsFromAProblemIsNotTold) {
  EXPECT_EQ(places(read(head + "G41 G1 X5 D1 R3\nX6\nG2 X7\n")), "6:1 8:4 ");
  EXPECT_EQ(places(read("G1 X5\nX6\nX7\n")), "1:4 ");
}

TEST(ReadProgram, ProgramsOfHeidenhainAreNamed) {
  const auto text = read("0 BEGIN PGM ABC MM\n1 L X+5 R0 FMAX\n");
  ASSERT_EQ(places(text), "1:3 ");
  EXPECT_EQ(text.problems[0].fault, Fault::dialect);
}

TEST(ReadProgram, ACycleLeadsToItsHoleByARapid) {
  const auto text =
      read("G21 G90 G17\nT1 M6\nS1000 M3\nG0 Z5.\nG81 X1. Y2. Z-1. R1. F60.\n");
  EXPECT_EQ(places(text), "");
  ASSERT_GE(text.program.moves.size(), 3U);
  EXPECT_EQ(text.program.moves[1].kind, MoveKind::rapid);
  EXPECT_EQ(text.program.moves[1].end, (std::array<double, 3>{1 * mm, 2 * mm, 5 * mm}));
}

TEST(ReadProgram, PecksMayBecomeSmaller) {
  const auto moves = moves_behind_head("G83 X0. Z-1. R0. I.5 J.2 K.1\n");
  std::vector<double> depths;
  for (const Move& move : moves) {
    if (move.kind == MoveKind::line)
      depths.push_back(std::round(move.end[2] / mm * 1e6) / 1e6);
  }
  EXPECT_EQ(depths, (std::vector<double>{-0.5, -0.8, -0.9, -1.0}));
  EXPECT_EQ(places(read(head + "G83 X0. Z-1. R0. I.5 J.2\n")), "6:18 ");
}

TEST(ReadProgram, ASlashMayStandWithinABlock) {
  EXPECT_EQ(moves_behind_head("G1 X1. /M8\n").size(), 1U);
  ReadOptions options;
  options.dialect = Dialect::iso;
  options.block_delete = true;
  const auto text = read_program(head + "G1 X1. /Y5.\n", options);
  EXPECT_EQ(text.program.moves.back().end[1], 0.0);
}

TEST(ReadProgram, TheLengthsOfACycleMayBeManyBeforeItIsRefused) {
  EXPECT_EQ(places(read(head + "G83 X1. Z-5. R1. Q0.0001\n")), "6:5 ");
  EXPECT_EQ(places(read(head + "G81 X1. Z-5. R1. L1000000\n")), "6:18 ");
  EXPECT_EQ(places(read(head + "G18 G2 X1000. I500. P100000\n", Dialect::linuxcnc)),
            "6:5 ");
}

}  // namespace trochoid::program::read_program_test
