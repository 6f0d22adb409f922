#include <trochoid/chip/harmonics.h>
#include <trochoid/chip/near_marks.h>

#include "made_slice.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace trochoid::chip::near_marks_test {

/// A cutter of many teeth at the largest feed that near_marks may be asked of.
MadeSlice crowded_slice(std::mt19937& random) {
  const double D = 12e-3;
  const int teeth = std::uniform_int_distribution<int>(2, 24)(random);
  const double share = std::uniform_real_distribution<double>(0.01, 0.95)(random);
  const double f_z = share * largest_feed * pi * D / teeth;
  MadeSlice out = made_slice(D, teeth, f_z);
  std::uniform_real_distribution<double> offset(-3 * f_z, 3 * f_z);
  geometry::Runout runout;
  for (int k = 0; k < teeth; ++k) {
    runout.radial_offsets.push_back(std::clamp(offset(random), -0.02 * D, 0.02 * D));
  }
  geometry::edge_positions(runout, geometry::tooth_angles(out.cutter), D / 2, 0.0,
                           out.teeth);
  return out;
}

TEST(NearMarks, LeaveOutNoneThatBoundsAChip) {
  std::mt19937 random(11);
  std::size_t kept = 0;
  std::size_t all = 0;
  for (int i = 0; i < 200; ++i) {
    MadeSlice made = crowded_slice(random);
    if (i % 2 == 1) made.cut.engagement = geometry::UpMilling{3e-3};
    const Passage passage = made.passage();
    std::vector<std::pmr::vector<int>> near;
    for (int j = 0; j < passage.teeth; ++j) {
      near.push_back(near_marks(passage, made.slice(), j));
      kept += near.back().size();
      all += static_cast<std::size_t>(passage.marks);
    }
    Slice few = made.slice();
    few.near = near;
    for (int j = 0; j < passage.teeth; ++j) {
      for (const double theta : steps(-pi / 2, 3 * pi / 2, 0.013)) {
        const Chip whole = chip_at(passage, made.slice(), j, theta);
        const Chip chip = chip_at(passage, few, j, theta);
        ASSERT_EQ(chip.h, whole.h) << i << " " << j << " " << theta;
        ASSERT_EQ(chip.in_cut, whole.in_cut);
      }
    }
  }
  EXPECT_LT(3 * kept, all);
}

}  // namespace trochoid::chip::near_marks_test
