#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/cases/wall_readings.h>

#include <sstream>

namespace trochoid::files::surface_file_test {

std::vector<SurfaceReading> read(const std::string& text, int teeth = 0) {
  std::istringstream in(text);
  return read_surface(in, "wall.csv", teeth);
}

std::string refusal(const std::string& text, int teeth = 0) {
  try {
    static_cast<void>(read(text, teeth));
  } catch (const base::InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SurfaceFile, IsReadInSi) {
  const auto readings = read("x_mm,height_mm,error_mm\n0.2,0.5,0.048\n30,1.5,-0.002\n");
  ASSERT_EQ(readings.size(), 2U);
  EXPECT_DOUBLE_EQ(readings[0].x.value(), 0.2e-3);
  EXPECT_DOUBLE_EQ(readings[0].height, 0.5e-3);
  EXPECT_DOUBLE_EQ(readings[0].error, 48e-6);
  EXPECT_DOUBLE_EQ(readings[1].error, -2e-6);
  EXPECT_EQ(readings[1].line, 3U);
  EXPECT_FALSE(readings[0].step || readings[0].feed_offset);
  EXPECT_EQ(readings[0].tooth, 0);
}

TEST(SurfaceFile, KnowsEveryNameAndUnit) {
  const auto readings = read(
      "Tooth;DEVIATION [um];Z (mm);Feed_Offset_um;k;position / m\n"
      "2;48;0.5;200;7;0.03\n",
      3);
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].tooth, 2);
  EXPECT_DOUBLE_EQ(readings[0].error, 48e-6);
  EXPECT_DOUBLE_EQ(readings[0].height, 0.5e-3);
  EXPECT_DOUBLE_EQ(readings[0].feed_offset.value(), 0.2e-3);
  EXPECT_EQ(readings[0].step.value(), 7.0);
  EXPECT_DOUBLE_EQ(readings[0].x.value(), 0.03);
}

TEST(SurfaceFile, TakesUnitsBelowTheNames) {
  const auto readings = read("step,height,error,comment\n,mm,\xC2\xB5m,\n1,0.5,48,4\n");
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_EQ(readings[0].step.value(), 1.0);
  EXPECT_DOUBLE_EQ(readings[0].error, 48e-6);
  EXPECT_NE(refusal("step,height,error\nmm,mm,um\n1,0.5,48\n").find("plain number"),
            std::string::npos);
}

TEST(SurfaceFile, TakesSeparatorsCommentsCommasAndOtherColumns) {
  for (const std::string mark : {";", "\t"}) {
    const auto readings =
        read("\xEF\xBB\xBF# a machine\nx_mm" + mark + "note" + mark + "height_mm" +
             mark + "error_mm" + mark + "\r\n\r\n1,5" + mark + "fine" + mark + "0,25" +
             mark + "0,0481" + mark + "\r\n");
    ASSERT_EQ(readings.size(), 1U);
    EXPECT_DOUBLE_EQ(readings[0].x.value(), 1.5e-3);
    EXPECT_DOUBLE_EQ(readings[0].height, 0.25e-3);
    EXPECT_DOUBLE_EQ(readings[0].error, 48.1e-6);
    EXPECT_EQ(readings[0].line, 4U);
  }
  EXPECT_EQ(read("sep=;\nx_mm;height_mm;error_mm\n0;1;2\n").size(), 1U);
}

TEST(SurfaceFile, AcceptsReadingsThatAreAllZero) {
  EXPECT_EQ(read("x_mm,height_mm,error_mm\n0,0,0\n1,0,0\n2,0,0\n").size(), 3U);
}

TEST(SurfaceFile, TellsPlacesApartByEveryColumn) {
  const std::string names = "x_mm,step,feed_offset_mm,height_mm,error_mm,tooth\n";
  EXPECT_EQ(read(names + "1,2,0.2,0.5,0.048,1\n" + "2,2,0.2,0.5,0.048,1\n" +
                 "1,3,0.2,0.5,0.048,1\n" + "1,2,0.4,0.5,0.048,1\n" +
                 "1,2,0.2,0.7,0.048,1\n" + "1,2,0.2,0.5,0.048,2\n")
                .size(),
            6U);
  EXPECT_EQ(read(names + "1,2,0.2,0.5,0.048,1\n1,2,0.2,0.5,0.047,1\n").size(), 1U);
}

TEST(SurfaceFile, AToothMayHaveAnyNumberWhereTheCutterIsNotKnown) {
  const std::string text = "x_mm,height_mm,error_mm,tooth\n0,0.5,0.05,4\n";
  EXPECT_EQ(read(text).front().tooth, 4);
  EXPECT_EQ(read(text, 4).front().tooth, 4);
  EXPECT_NE(refusal(text, 3), "");
}

TEST(SurfaceFile, ReportsEveryBadRowAtOnce) {
  const std::string said = refusal(
      "x_mm,height_mm,error_mm\n0,0.5,inf\n0,0.5\n1,0.5,0.05\n2,a,0.05\n2,0.5,x\n");
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 4) << said;
  for (const auto* place :
       {"wall.csv:2:7", "wall.csv:3:1", "wall.csv:5:3", "wall.csv:6:7"}) {
    EXPECT_NE(said.find(place), std::string::npos) << said;
  }
}

TEST(SurfaceFile, AFileThatIsGoneIsToldWhereTheCaseNamesIt) {
  try {
    static_cast<void>(read_surface(
        {.file = {
             .name = "wall.csv", .path = "/no/wall.csv", .location = "c.toml:9:8"}}));
    FAIL();
  } catch (const base::InputError& error) {
    EXPECT_STREQ(error.what(),
                 "c.toml:9:8: file = /no/wall.csv: there is no such file\n");
  }
}

constexpr double mm = 1e-3;

cases::Case thin_wall() {
  cases::Case c;
  c.setup.cut.a_p = 3 * mm;
  c.machine.wall =
      cases::Wall{.length = 60 * mm, .height = 30 * mm, .thickness = 2 * mm};
  return c;
}

SurfaceFile one_reading(double x, double height) {
  return {.readings = {{.x = x, .height = height, .line = 5}}};
}

TEST(SurfaceReadings, LieWithinTheCutAndTheWall) {
  const cases::Case c = thin_wall();
  for (const double x : {0.0, 30 * mm, 60000 * 1e-6}) {
    for (const double height : {0.0, 3 * mm, 3000 * 1e-6}) {
      EXPECT_TRUE(
          cases::check_readings(one_reading(x, height), "w.csv", cases::wall_of(c))
              .empty());
    }
  }
  EXPECT_EQ(cases::check_readings(one_reading(0, 3.1 * mm), "w.csv", cases::wall_of(c)),
            std::vector<std::string>{
                "w.csv:5:1: the height of 3.1 mm is outside the cut: must be from 0 to "
                "axial_depth_mm = 3 mm, above the tip of the cutter"});
  EXPECT_EQ(cases::check_readings(one_reading(0, -0.1 * mm), "w.csv", cases::wall_of(c))
                .size(),
            1U);
  EXPECT_EQ(
      cases::check_readings(one_reading(60.1 * mm, mm), "w.csv", cases::wall_of(c)),
      std::vector<std::string>{"w.csv:5:1: x = 60.1 mm is outside the wall: must "
                               "be from 0 to length_mm = 60 mm"});
  EXPECT_EQ(
      cases::check_readings(one_reading(-0.1 * mm, 4 * mm), "w.csv", cases::wall_of(c))
          .size(),
      2U);
}

TEST(SurfaceReadings, NameTheUnitInWhichAllWouldLieInside) {
  const auto said = [](double x, double height, const char* unit) {
    SurfaceFile surface = one_reading(x, height);
    surface.readings.push_back({.x = x / 2, .height = height / 2});
    surface.x_unit = surface.height_unit = unit;
    return cases::check_readings(surface, "w.csv", cases::wall_of(thin_wall())).front();
  };
  const auto ends = [](const std::string& text, const std::string& unit) {
    return text.ends_with("; in " + unit + " all readings would lie inside");
  };
  EXPECT_TRUE(ends(said(0.03, 2.5, "m"), "mm instead of m"));
  EXPECT_TRUE(ends(said(0.03, 2.5, "mm"), "um instead of mm"));
  EXPECT_TRUE(ends(said(30.0, 0.0, "mm"), "um instead of mm"));
  EXPECT_TRUE(ends(said(0.0, 2.5 * 25.4e-3, "in"), "mm instead of in"));
  EXPECT_NE(said(0.0, -2.5 * mm, "mm").find("with the other sign"), std::string::npos);
  EXPECT_NE(said(0.0, 3.1 * mm, "mm").find("above the tip of the cutter"),
            std::string::npos);
  EXPECT_EQ(said(0.0, 3.1 * mm, "mm").find("instead"), std::string::npos)
      << "one a little too high is no wrong unit";
}

TEST(SurfaceReadings, AlongTheTurnOfAQuasiStaticModelOrARigidWallXIsFree) {
  cases::Case c = thin_wall();
  c.machine.surface.emplace().model = surface::Model::imprint;
  EXPECT_EQ(cases::check_readings(one_reading(61 * mm, mm), "w.csv", cases::wall_of(c))
                .size(),
            1U);
  c.machine.surface->model = surface::Model::quasi_static;
  EXPECT_TRUE(
      cases::check_readings(one_reading(61 * mm, mm), "w.csv", cases::wall_of(c))
          .empty());
  c = thin_wall();
  c.machine.wall.reset();
  EXPECT_TRUE(
      cases::check_readings(one_reading(61 * mm, mm), "w.csv", cases::wall_of(c))
          .empty());
}

}  // namespace trochoid::files::surface_file_test
