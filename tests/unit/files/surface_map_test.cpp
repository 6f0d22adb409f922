#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/cases/wall_readings.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>
#include <string>

#include "surface_made.h"

namespace trochoid::files::surface_map_test {

using namespace made;

constexpr double mm = 1e-3;
constexpr double um = 1e-6;
constexpr double gap = std::numeric_limits<double>::quiet_NaN();

SurfaceFile read(const std::string& bytes, SurfaceSource measurement = {}) {
  std::istringstream in(bytes);
  measurement.file.path = "wall.x3p";
  return read_surface_file(in, measurement, 3);
}

std::string refusal(const std::string& bytes, const SurfaceSource& measurement = {}) {
  try {
    static_cast<void>(read(bytes, measurement));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

bool says(const std::string& text, const std::string& what) {
  return text.find(what) != std::string::npos;
}

/// Points with z = 1, 2, 3 / 4, -, 6 um; the fifth was not measured.
void expect_the_map(const SurfaceFile& surface, double y0, const std::string& what) {
  EXPECT_TRUE(surface.map);
  ASSERT_EQ(surface.readings.size(), 5U) << what;
  EXPECT_EQ(surface.counts.skipped, 1U) << what;
  const auto& last = surface.readings.back();
  EXPECT_NEAR(last.x.value(), 1 * mm, 1e-12) << what;
  EXPECT_NEAR(last.height, y0 + 0.25 * mm, 1e-12) << what;
  EXPECT_NEAR(last.error, 6 * um, 1e-12) << what;
  EXPECT_NEAR(surface.readings[1].error, 2 * um, 1e-12) << what;
  EXPECT_NEAR(surface.readings[1].x.value(), 0.5 * mm, 1e-12) << what;
  EXPECT_NEAR(surface.readings[1].height, y0, 1e-12) << what;
}

const std::vector<double> heights{1e-6, 2e-6, 3e-6, 4e-6, gap, 6e-6};

TEST(SurfaceX3p, IsReadInEveryTypeOfNumber) {
  expect_the_map(read(x3p_file({}, all_little(heights))), 1 * mm, "double");
  expect_the_map(read(x3p_file({.type = "F"}, all_little(std::vector<float>(
                                                  heights.begin(), heights.end())))),
                 1 * mm, "float");
  const X3p whole{.type = "I",
                  .z_axis = "<Increment>1e-6</Increment><Offset>1e-5</Offset>",
                  .links = "<ValidPointsLink>bindata/valid.bin</ValidPointsLink>"};
  expect_the_map(
      read(x3p_file(whole, all_little(std::vector<std::int16_t>{-9, -8, -7, -6, 0, -4}),
                    std::string(1, '\x2F'))),
      1 * mm, "16 bits");
  X3p longer = whole;
  longer.type = "L";
  expect_the_map(
      read(x3p_file(longer,
                    all_little(std::vector<std::int32_t>{-9, -8, -7, -6, 0, -4}),
                    std::string(1, '\x2F'))),
      1 * mm, "32 bits");
}

TEST(SurfaceX3p, SaysWhatIsWrong) {
  const std::string points = all_little(heights);
  const auto wrong = [&](const X3p& x) { return refusal(x3p_file(x, points)); };
  EXPECT_TRUE(says(wrong({.type = "Q"}), "must be I, L, F or D"));
  EXPECT_TRUE(says(wrong({.feature = "PCL"}), "a cloud of points"));
  EXPECT_TRUE(
      says(wrong({.size = "<SizeX>4</SizeX><SizeY>2</SizeY>"}), "has 48 bytes"));
  EXPECT_TRUE(says(wrong({.size = "<SizeX>4000000</SizeX><SizeY>4000000</SizeY>"}),
                   "at most 4194304 are read"));
  EXPECT_TRUE(
      says(wrong({.size = "<SizeX>-1</SizeX><SizeY>2</SizeY>"}), "at least one"));
  EXPECT_TRUE(says(wrong({.size = "<SizeX>3</SizeX>"}), "SizeY"));
  EXPECT_TRUE(says(refusal(zip_file({{"main.xml", x3p_description({})}})),
                   "has no \"bindata/data.bin\""));
  EXPECT_TRUE(
      says(refusal(zip_file({{"sheet1.xml", "<a/>"}})), "perhaps a spreadsheet"));
  std::string damaged = x3p_file({}, points);
  damaged[60] = static_cast<char>(damaged[60] ^ 1);
  EXPECT_TRUE(says(refusal(damaged), "is damaged"));
  SurfaceSource in_mm;
  in_mm.unit = LengthUnit::mm;
  EXPECT_TRUE(says(refusal(x3p_file({}, points), in_mm), "are in metres"));
  const std::vector<double> gaps{gap, gap, gap, gap, 1e-6, 2e-6};
  EXPECT_TRUE(says(refusal(x3p_file({}, all_little(gaps))), "4 of 6 points"));
}

TEST(SurfaceX3p, LiesAsTheFrameSays) {
  SurfaceSource m;
  m.frame = SurfaceFrame{{1 * mm, 1 * mm, 0},
                         Direction{-1, 0, 0},
                         Direction{0, 0, -1},
                         Direction{0, 1, 0}};
  const auto surface = read(x3p_file({}, all_little(heights)), m);
  ASSERT_EQ(surface.readings.size(), 5U);
  EXPECT_NEAR(surface.readings[0].x.value(), 1 * mm, 1e-12);
  EXPECT_NEAR(surface.readings[0].height, 0.0, 1e-12);
  EXPECT_NEAR(surface.readings[4].error, -6 * um, 1e-12);
}

TEST(SurfaceX3p, AProfileLiesAtTheHeightThatTheCaseSays) {
  SurfaceSource trace;
  trace.height = 0.5 * mm;
  const std::string profile =
      x3p_file({.size = "<SizeX>2</SizeX><SizeY>1</SizeY>", .feature = "PRF"},
               all_little(std::vector<double>{1e-6, 2e-6}));
  const auto surface = read(profile, trace);
  ASSERT_EQ(surface.readings.size(), 2U);
  EXPECT_EQ(surface.readings[1].height, 0.5 * mm);
  EXPECT_NEAR(surface.readings[1].error, 2 * um, 1e-15);
  EXPECT_TRUE(
      says(refusal(x3p_file({}, all_little(heights)), trace), "heights of its own"));
}

TEST(SurfaceSdf, IsReadAsTextAndInBinary) {
  expect_the_map(read(sdf_text("1 2 3\r\n4 BAD 6")), 0.0, "text");
  expect_the_map(read(sdf_head(7, 1.0) + all_little(heights)), 0.0, "double");
  expect_the_map(read(sdf_head(5, 1e-6) +
                      all_little(std::vector<std::int16_t>{1, 2, 3, 4, -32768, 6})),
                 0.0, "16 bits");
  expect_the_map(read(sdf_head(2, 1e-6) + all_little(std::vector<std::uint32_t>{
                                              1, 2, 3, 4, 0xFFFFFFFFU, 6})),
                 0.0, "32 bits without a sign");
}

TEST(SurfaceSdf, SaysWhatIsWrong) {
  EXPECT_TRUE(says(refusal(sdf_text("1 2 3 4 5")), "point 6 of 6"));
  EXPECT_TRUE(says(refusal(sdf_text("1 2 3 4 five 6")), "\"five\""));
  EXPECT_TRUE(says(refusal(sdf_head(7, 1.0)), "it is cut off"));
  EXPECT_TRUE(says(refusal(sdf_head(9, 1.0)), "must be from 0 to 7"));
  EXPECT_TRUE(says(refusal(sdf_head(7, 0.0)), "Zscale"));
  EXPECT_TRUE(says(refusal(sdf_head(7, 1.0, 1)), "compressed"));
  EXPECT_TRUE(says(refusal("bISO-1.0"), "ends within its head"));
  EXPECT_TRUE(says(refusal("aISO-1.0\nNumPoints = many\n"), "a number is needed"));
}

TEST(SurfaceMaps, KeepWhatLiesInsideTheCut) {
  cases::Case c;
  c.setup.cut.a_p = 1.1 * mm;  // the first row of the map
  c.machine.wall =
      cases::Wall{.length = 0.6 * mm, .height = 30 * mm, .thickness = 2 * mm};
  const auto file = std::string(testing::TempDir()) + "trochoid_map_inside.x3p";
  {
    std::ofstream out(file, std::ios::binary);
    out << x3p_file({}, all_little(heights));
  }
  const SurfaceSource m{.file = file_at(file)};
  const auto surface = cases::read_wall(m, cases::wall_of(c));
  EXPECT_EQ(surface.readings.size(), 2U);
  EXPECT_EQ(surface.counts.skipped, 4U);
  c.setup.cut.a_p = 0.9 * mm;
  EXPECT_THROW(static_cast<void>(cases::read_wall(m, cases::wall_of(c))),
               base::InputError);
}

}  // namespace trochoid::files::surface_map_test
