#include <trochoid/chip/teeth_at_height.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/volume.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::chip::teeth_at_height_test {

constexpr double mm = 1e-3;
constexpr double um = 1e-6;

geometry::Cutter face_mill() {
  return {.profile = geometry::taper(80 * mm, 45 * unit::deg),
          .pitch = geometry::equal_pitch(5),
          .helix = 0.0,
          .lag_diameter = 80 * mm};
}

const geometry::Cut slot{
    .engagement = geometry::Slot{}, .a_p = 2 * mm, .f_z = 0.2 * mm};

TEST(TeethAtHeight, AToothThatIsNotThereLeavesItsFeedToTheNext) {  // [C-20]
  const geometry::Cutter c = face_mill();
  const geometry::ToothEdges edges(
      c, {.axial_offsets = {0.0, -50 * um, 0.0, -50 * um, -50 * um}});
  TeethAtHeight teeth(edges, passage(c, slot, {}));
  teeth.stand_at(20 * um);
  EXPECT_TRUE(teeth.there(0));
  EXPECT_FALSE(teeth.there(1));
  const double ahead = 90 * unit::deg;
  // Tooth 1 follows tooth 3, three pitches before; tooth 3 follows tooth 1, two before.
  EXPECT_NEAR(teeth.chip(0, ahead).h, 3 * slot.f_z, 1e-9);
  EXPECT_NEAR(teeth.chip(2, ahead).h, 2 * slot.f_z, 1e-9);
  EXPECT_EQ(teeth.nearest_mark(0, ahead), 3);
  EXPECT_EQ(teeth.nearest_mark(2, ahead), 2);
  EXPECT_EQ(teeth.chip(1, ahead).h, 0.0);
  EXPECT_EQ(teeth.nearest_mark(1, ahead), 0);
}

TEST(TeethAtHeight, TheLastToothBeforeMayBeTheToothItself) {  // [C-20]
  const geometry::Cutter c = face_mill();
  const geometry::ToothEdges edges(
      c, {.axial_offsets = {0.0, -50 * um, -50 * um, -50 * um, -50 * um}});
  TeethAtHeight teeth(edges, passage(c, slot, {.lookback = Lookback::previous}));
  teeth.stand_at(20 * um);
  EXPECT_NEAR(teeth.chip(0, 90 * unit::deg).h, 5 * slot.f_z, 1e-9);
  EXPECT_EQ(teeth.nearest_mark(0, 90 * unit::deg), 5);
}

TEST(TeethAtHeight, ChipsOfATurnAreFeedTimesWidth) {  // [C-8] [C-20]
  geometry::Cutter c{.profile = geometry::cylinder(12 * mm),
                     .pitch = geometry::equal_pitch(3),
                     .helix = 25 * unit::deg,
                     .lag_diameter = 12 * mm,
                     .helices = {0.3, 0.4, 0.35}};
  c.serration =
      geometry::Serration{.amplitude = 60 * um, .wavelength = 1.5 * mm, .shift = {}};
  const geometry::ToothEdges edges(
      c,
      {.axial_offsets = {0.0, 0.1 * mm, -0.05 * mm}, .tilt = 1e-3, .tilt_angle = 0.3});
  const geometry::Cut band{
      .engagement = geometry::Band{-4 * mm, 5 * mm}, .a_p = 4 * mm, .f_z = 0.08 * mm};
  TeethAtHeight teeth(edges, passage(c, band, {}));
  for (const double z : {-0.08 * mm, 0.0, 0.4 * mm, 3.1 * mm}) {
    teeth.stand_at(z);
    std::size_t some = 0;
    while (!teeth.there(some)) ++some;
    const Removal removed = removal(teeth.passage(), teeth.slice(some));
    EXPECT_NEAR(removed.removed / removed.available, 1.0, 1e-8) << z;
  }
}

TEST(TeethAtHeight, HelixAnglesThatDifferArePitchesThatDiffer) {  // [C-20]
  geometry::Cutter c{.profile = geometry::cylinder(10 * mm),
                     .pitch = geometry::equal_pitch(4),
                     .helix = 0.0,
                     .lag_diameter = 10 * mm,
                     .helices = {0.6, 0.7, 0.6, 0.7}};
  const double z = 5 * mm;
  const geometry::ToothEdges edges(c, {});
  geometry::Cutter at_z = c;
  at_z.helices.clear();
  for (std::size_t j = 0; j < 4; ++j) {
    const double next = j + 1 < 4 ? edges.edge_at(j + 1, z).omega
                                  : edges.edge_at(0, z).omega + unit::turn;
    at_z.pitch[j] = next - edges.edge_at(j, z).omega;
  }
  TeethAtHeight one(edges, passage(c, slot, {}));
  const geometry::ToothEdges straight(at_z, {});
  TeethAtHeight other(straight, passage(at_z, slot, {}));
  one.stand_at(z);
  other.stand_at(z);
  for (std::size_t j = 0; j < 4; ++j) {
    for (const double theta : {0.1, 0.8, 2.0, 3.0}) {
      EXPECT_NEAR(one.chip(j, theta).h, other.chip(j, theta).h, 1e-15);
    }
  }
}

}  // namespace trochoid::chip::teeth_at_height_test
