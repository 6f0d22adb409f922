#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/surface_file.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

namespace trochoid::files::surface_forms_test {

constexpr double mm = 1e-3;
constexpr double um = 1e-6;
constexpr double inch = 25.4e-3;

SurfaceFile read(const std::string& text, SurfaceSource measurement = {}) {
  std::istringstream in(text);
  measurement.file.path = "wall.csv";
  return read_surface_file(in, measurement, 3);
}

std::string refusal(const std::string& text, const SurfaceSource& measurement = {}) {
  try {
    static_cast<void>(read(text, measurement));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

std::string note(const SurfaceFile& surface, const std::string& code) {
  for (const auto& one : surface.notes) {
    if (one.code == code) return one.message;
  }
  return "";
}

/// A file with one reading at x 10 mm, height 0.5 mm, error 48 um.
void expect_the_reading(const SurfaceFile& surface, const std::string& text) {
  ASSERT_EQ(surface.readings.size(), 1U) << text;
  EXPECT_NEAR(surface.readings[0].x.value(), 10 * mm, 1e-12) << text;
  EXPECT_NEAR(surface.readings[0].height, 0.5 * mm, 1e-12) << text;
  EXPECT_NEAR(surface.readings[0].error, 48 * um, 1e-12) << text;
}

TEST(SurfaceUnits, StandInNamesInARowOrInTheCase) {
  const std::string inches = "0.39370078740157,0.019685039370079,0.0018897637795276\n";
  for (const std::string names :
       {"x_in,height_in,error_in\n", "x [in],z [inch],deviation [inches]\n",
        "x / \",z / \",dev / \"\n", "\"x / \"\"\",\"z / \"\"\",\"dev / \"\"\"\n",
        "X (IN),Z (IN),DEV (IN)\n", "x,height,error\nin,in,in\n"}) {
    expect_the_reading(read(names + inches), names);
  }
  for (const std::string unit : {"thou", "mil", "mils"}) {
    expect_the_reading(
        read("x_mm;height_mm;error [" + unit + "]\n10;0.5;1.8897637795276\n"), unit);
  }
  for (const std::string unit : {"um", "micron", "\xC2\xB5m", "\xCE\xBCm", "\xB5m"}) {
    expect_the_reading(read("x_mm;height_mm;error [" + unit + "]\n10;0.5;48\n"), unit);
  }
  SurfaceSource in_inches;
  in_inches.unit = LengthUnit::in;
  expect_the_reading(read("x,height,error\n" + inches, in_inches), "of the case");
  expect_the_reading(
      read("x,height,error_um\n0.39370078740157,0.019685039370079,48\n", in_inches),
      "a column's own unit stands");
  EXPECT_TRUE(says(refusal("x,height_mm,error_mm\n1,1,1\n"), "says no unit"));
}

TEST(SurfaceText, IsSkippedAboveAndBelowAndTold) {
  const auto surface = read(
      "CALYPSO 7.2\n"
      "Date: 2026-03-04; Operator: K. Meyer, Part 7\n"
      "\n"
      "Points 2\n"
      "x_mm  height_mm  error_mm\n"
      "----  ---------  --------\n"
      "10  0.5  0.048\n"
      "% a comment\n"
      "11  0.5  0.047\n"
      "\n"
      "Mean    0.0475\n"
      "Max   = 0.048 mm\n");
  ASSERT_EQ(surface.readings.size(), 2U);
  EXPECT_EQ(surface.readings[1].line, 9U);
  EXPECT_EQ(
      note(surface, "lines_skipped"),
      "Text was skipped: lines 1 to 4 before the row of names, lines 11 to 12 after "
      "the last reading.");
  EXPECT_EQ(surface.counts.skipped, 0U);
}

TEST(SurfaceText, StatisticsMayKeepToTheColumns) {
  const auto surface = read(
      "point;x_mm;z_mm;dev_mm\nP1;10;0.5;0.048\nP2;;0.5;\nP3;12;0.5;0.046\n"
      "Statistics;;;\nMean;;;0.047\n");
  EXPECT_EQ(surface.readings.size(), 2U);
  EXPECT_EQ(surface.counts.skipped, 1U);
  EXPECT_TRUE(says(note(surface, "lines_skipped"), "lines 5 to 6 after"));
  const auto failed = read(
      "point;x_mm;z_mm;dev_mm\nP1;10;0.5;0.048\nP2;;;\nP3;;0.5;0.046\n"
      "P4;11;0.5;0.046\n");
  EXPECT_EQ(failed.readings.size(), 2U);
  EXPECT_EQ(failed.counts.skipped, 2U);
}

TEST(SurfaceText, NamesMayStandAgainOnEveryPage) {
  const auto surface = read("x_mm,z_mm,dev_um\n1,1,48\nx_mm,z_mm,dev_um\n2,1,47\n");
  EXPECT_EQ(surface.readings.size(), 2U);
  EXPECT_TRUE(says(note(surface, "lines_skipped"), "stands again (1)"));
}

TEST(SurfaceText, NamesMayStandInTheCommentAboveTheNumbers) {
  const auto surface = read("# by savetxt\n# x_mm height_mm error_um\n10 0.5 48\n");
  expect_the_reading(surface, "comment");
  EXPECT_TRUE(surface.notes.empty());
}

TEST(SurfaceText, IsSeparatedByAnythingUsual) {
  for (const std::string mark : {",", ";", "\t", " ", "   ", " \t "}) {
    std::string text = "x_mm|height_mm|error_um\n10|0.5|48\n";
    for (auto at = text.find('|'); at != std::string::npos; at = text.find('|')) {
      text.replace(at, 1, mark);
    }
    expect_the_reading(read(text), text);
  }
  expect_the_reading(read("x [mm]   height [mm]   error [um]\n  10   0,5   48\n"),
                     "wide");
  expect_the_reading(read("x [mm] height [mm] error / um\n10 0,5 48\n"), "one blank");
  expect_the_reading(read("sep=|\nx_mm|height_mm|error_um\n10|0.5|48\n"), "stated");
}

TEST(SurfaceText, RowsMayHaveBlanksWhereTheNamesHaveCommas) {
  expect_the_reading(read("x_mm, height_mm, error_um\n10 0.5 48\n"), "commas");
  expect_the_reading(read("# x_mm, height_mm, error_um\n10 0.5 48\n"), "a comment");
}

TEST(SurfaceText, UnitsInColumnsStandBelowTheirNames) {
  expect_the_reading(read("  Point       X      height    error\n"
                          "            [mm]      [mm]      [um]\n"
                          "      1       10       0.5        48\n"),
                     "in columns");
  EXPECT_TRUE(
      says(refusal("no   x   height   error\n    mm     mm\n1   10   0.5   48\n"),
           "\"error\" says no unit"));
}

TEST(SurfaceText, WithoutNamesOrNumbersIsRefusedInWords) {
  EXPECT_TRUE(says(refusal("10 0.5 0.048\n11 0.5 0.047\n"),
                   "wall.csv:1:1: the first row has numbers"));
  EXPECT_TRUE(says(refusal("x_mm,z_mm,dev_mm\nten,1,1\neleven,1,1\n"),
                   "wall.csv:2:1: this line is no row of numbers"));
}

/// A roughness instrument traces along the feed at one height.
TEST(SurfaceTraces, LieAtTheHeightThatTheCaseSays) {
  SurfaceSource trace;
  trace.height = 0.5 * mm;
  expect_the_reading(read("No.,X(mm),Z(um)\n1,10,48\n", trace), "x, z");
  expect_the_reading(read("x_mm,dev_um\n10,48\n", trace), "x, deviation");
  expect_the_reading(read("x_mm,z_mm,dev_um\n10,7,48\n", trace), "both");
  EXPECT_TRUE(says(refusal("x_mm,height_mm,dev_um\n10,7,48\n", trace),
                   "wall.csv:1:6: column \"height_mm\" has the heights"));
  EXPECT_TRUE(says(refusal("x_mm,z_um\n10,48\n"), "the case says height_mm"));
  trace.frame = SurfaceFrame{
      {12 * mm, 0, 0}, Direction{-1, 0, 0}, Direction{0, 0, 1}, Direction{0, 1, 0}};
  expect_the_reading(read("x_mm,z_um\n2,48\n", trace), "in a frame");
}

TEST(SurfaceNames, AreThoseOfMeasuringMachines) {
  for (const std::string names :
       {"X [mm];Z [mm];Dev [mm]", "pos_mm;H\xC3\xB6he [mm];Abw. [mm]",
        "x_mm;h\xF6he_mm;Abweichung (mm)"}) {
    expect_the_reading(read(names + "\n10;0,5;0,048\n"), names);
  }
  for (const std::string names : {"Soll;Ist", "Nominal;Actual", "NOM;MEAS"}) {
    SurfaceSource measurement;
    measurement.unit = LengthUnit::mm;
    expect_the_reading(read("x;z;" + names + "\n10;0.5;-5.000;-4.952\n", measurement),
                       names);
    expect_the_reading(
        read("x;z;" + names + ";dev\n10;0.5;-5.000;-4.952;0.0480\n", measurement),
        names);
    EXPECT_TRUE(says(
        refusal("x;z;" + names + ";dev\n10;0.5;-5.000;-4.952;0.0520\n", measurement),
        "wall.csv:2:22: "));
  }
}

/// Rounded numbers may differ by half of their last decimals; whole ones are exact then.
TEST(SurfaceNames, OfThreeValuesMustAgreeToTheirLastDecimals) {
  const std::string names = "x_mm;z_mm;soll_mm;ist_mm;abw_um\n10;0.5;";
  EXPECT_EQ(refusal(names + "-5;-4.952;48.4\n"), "");
  EXPECT_EQ(refusal(names + "-5.000;-4.952;49.0\n"), "");
  EXPECT_TRUE(says(refusal(names + "-5;-4.952;48.8\n"), "turn its sign round"));
  EXPECT_TRUE(says(refusal(names + "-5;-4.952;-48\n"), "turn its sign round"));
  EXPECT_EQ(refusal("x;z;soll;ist;abw\num;um;um;um;um\n10;5;5000;5048;48\n"), "");
  EXPECT_NE(refusal("x;z;soll;ist;abw\num;um;um;um;um\n10;5;5000;5048;40\n"), "");
}

TEST(SurfaceGaps, AreLeftOutAndCounted) {
  std::string text = "x_mm,height_mm,error_mm,note\n";
  const std::string signs[] = {"", "NaN", "-", "---", "*****", "n/a", "-nan"};
  for (const auto& sign : signs) {
    text += "1,0.5," + sign + ",\n" + std::to_string(text.size()) + ",0.5,-0.01,\n";
  }
  text += ",,,\n";  // as spreadsheets end
  const auto surface = read(text);
  EXPECT_EQ(surface.readings.size(), std::size(signs));
  EXPECT_EQ(surface.counts.skipped, std::size(signs));
  EXPECT_EQ(
      note(surface, "readings_skipped"),
      "7 of 14 rows were left out because a value is missing, the first in line 2.");
  EXPECT_TRUE(says(refusal("x_mm,z_mm,dev_mm\n1,1,\n2,1,NaN\n3,1,0.1\n"),
                   "wall.csv:2:1: 2 of 3 rows"));
}

TEST(SurfaceRepeats, AreAveragedAndPooled) {
  const auto surface = read(
      "x_mm,height_mm,error_um\n1,0.5,10\n2,0.5,50\n1,0.5,14\n1.0,0.50,12\n2,0.5,54\n"
      "3,0.5,7\n");
  ASSERT_EQ(surface.readings.size(), 3U);
  EXPECT_NEAR(surface.readings[0].error, 12 * um, 1e-15);
  EXPECT_NEAR(surface.readings[1].error, 52 * um, 1e-15);
  EXPECT_NEAR(surface.readings[2].error, 7 * um, 1e-15);
  EXPECT_EQ(surface.readings[0].line, 2U);
  EXPECT_EQ(surface.counts.repeats, 3U);
  // Squares about the means: 4 + 4 + 0 and 4 + 4, over 2 + 1 degrees of freedom.
  EXPECT_NEAR(surface.counts.repeatability().value(), std::sqrt(16.0 / 3.0) * um,
              1e-12);
  EXPECT_TRUE(says(note(surface, "repeats_averaged"), "3 of 6 rows repeat a place"));
  EXPECT_FALSE(read("x_mm,z_mm,dev_mm\n1,1,0\n").counts.repeatability());
}

SurfaceFrame frame_of(Direction feed, Direction normal, Direction up) {
  return {{12 * mm, -5 * mm, 40 * mm}, feed, normal, up};
}

TEST(SurfaceFrames, TurnCoordinatesIntoPlaceAndError) {
  SurfaceSource m;
  m.frame = frame_of({1, 0, 0}, {0, -1, 0}, {0, 0, 1});
  expect_the_reading(read("X_mm,Y_mm,Z_mm\n22,-5.048,40.5\n", m), "by Y");
  expect_the_reading(read("X_mm,Z_mm,dev_um\n22,40.5,48\n", m), "by deviation");
  expect_the_reading(read("X_mm,Y_mm,Z_mm,dev_um\n22,7,40.5,48\n", m), "both");
  expect_the_reading(read("X_mm,Y_mm,Z_mm,nominal_mm\n22,-5.148,40.5,-5.1\n", m),
                     "by nominal Y");
  m.frame = frame_of({0, 0, -1}, {1, 0, 0}, {0, 1, 0});
  expect_the_reading(read("X_mm,Y_mm,Z_mm\n12.048,-4.5,30\n", m), "turned");
  const double c = 0.6;
  const double s = 0.8;
  m.frame = frame_of({c, s, 0}, {s, -c, 0}, {0, 0, 1});
  // 10 mm along the feed and 0.048 along the normal from the origin.
  expect_the_reading(read("X_mm,Y_mm,Z_mm\n18.0384,2.9712,40.5\n", m), "askew");
  EXPECT_TRUE(says(refusal("X_mm,Z_mm,dev_mm\n1,1,1\n", m), "no column is named Y"));
  EXPECT_TRUE(says(refusal("X_mm,Y_mm,Z_mm,nom_mm\n1,1,1,1\n", m), "deviations"));
}

TEST(SurfaceFile, TwoHundredThousandRowsAreReadWhole) {
  constexpr int rows = 200000;
  std::string text = "x_mm,height_mm,error_mm\n";
  for (int i = 0; i < rows; ++i) {
    text +=
        std::to_string(i % 1000) + ".5," + std::to_string(i / 1000) + ".25,0.0481\n";
  }
  EXPECT_EQ(read(text).readings.size(), static_cast<std::size_t>(rows));
}

}  // namespace trochoid::files::surface_forms_test
