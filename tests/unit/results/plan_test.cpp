#include <trochoid/results/plan.h>

#include <trochoid/base/units.h>
#include <trochoid/results/json.h>

#include <gtest/gtest.h>

#include <cmath>

namespace trochoid::results::plan_test {

PlanResult made() {
  PlanResult r;
  r.quantities = {{"K_tc_MPa", "K_tc", unit::MPa, true, 2000e6, 100e6},
                  {"radial_offset_2_mm", "offset of tooth 2", unit::mm, false, -8e-6,
                   std::nullopt}};
  r.cuts = {
      {{geometry::UpMilling{4e-3}, 2e-3, 80e-6, 100.0}, 412.0, {20e6, 5e-7}, -4.0},
      {{geometry::Slot{}, 2e-3, 80e-6, 100.0}, 512.0, {30e6, 6e-7}, -3.0}};
  r.left_out = {{"above max_force_N = 600 N", 3}};
  r.looked_at = 5;
  r.parameters = 2;
  r.factor_before = 2.0;
  r.factor_after = 2.0;
  r.diameter = 8e-3;
  r.noise = 5.0;
  r.noise_from = "given";
  r.turns = 10;
  r.samples_per_rev = 360;
  r.heading.message = next_cut_sentence(r);
  return r;
}

TEST(PlanAnswer, SaysWhichCutAndWhatItBrings) {
  EXPECT_EQ(made().heading.message,
            "Cut next: up milling, radial depth 4 mm, axial depth 2 mm, feed 0.08 mm "
            "per tooth, 10 turns. It narrows K_tc from +- 10 % to +- 2 %, and tells "
            "offset of tooth 2 to +- 1 um (95 %).");
}

TEST(PlanAnswer, HasIntervalsBeforeAndAfter) {
  const Answer answer = answer_of(made());
  const Value& result = answer.result;
  const auto& cuts = std::get<Array>(find(result, "cuts")->data);
  ASSERT_EQ(cuts.size(), 2U);
  EXPECT_EQ(json_text(*find(cuts[0], "engagement")), "\"up\"");
  EXPECT_EQ(json_text(*find(cuts[0], "feed_per_tooth_mm")), "0.08");
  EXPECT_EQ(json_text(*find(cuts[1], "radial_depth_mm")), "8") << "of a slot";
  EXPECT_EQ(json_text(*find(cuts[0], "narrows")), "null") << "the offset is not known";
  const Value* K = find(*find(cuts[0], "predicted"), "K_tc_MPa");
  EXPECT_EQ(json_text(*find(*K, "low")), "1960");
  EXPECT_EQ(json_text(*find(*K, "high")), "2040");
  const Value* before = find(result, "before");
  EXPECT_EQ(json_text(*find(*find(*before, "K_tc_MPa"), "high")), "2200");
  EXPECT_EQ(json_text(*find(*before, "radial_offset_2_mm")), "null");
  const auto& left_out = std::get<Array>(find(result, "left_out")->data);
  ASSERT_EQ(left_out.size(), 1U);
  EXPECT_EQ(json_text(*find(left_out[0], "count")), "3");
}

TEST(PlanAnswer, TellsHowMuchNarrowerTheJointRegionIs) {  // [I-21]
  PlanResult r = made();
  r.log_determinant = -4.0 + 4.0 * std::log(3.0);
  const Answer answer = answer_of(r);
  const auto& cuts = std::get<Array>(find(answer.result, "cuts")->data);
  EXPECT_NEAR(std::get<double>(find(cuts[0], "narrows")->data), 3.0, 1e-12);
  const base::Table& table = answer.tables.at(0);
  EXPECT_EQ(table.file, "plan.csv");
  EXPECT_EQ(table.columns[0].values, (std::vector{1.0, 0.0})) << "up, slot";
  EXPECT_EQ(table.columns[5].name, "narrows");
  EXPECT_EQ(table.columns[7].name, "half_width_radial_offset_2_mm");
  EXPECT_NEAR(table.columns[7].values[1], 1.2e-3, 1e-15);
  EXPECT_NE(answer.short_table.find("so far"), std::string::npos);
  EXPECT_EQ(answer.short_table.find("coefficients of"), std::string::npos);
  r.group = "\"worn\"";
  EXPECT_TRUE(answer_of(r).short_table.ends_with("coefficients of \"worn\"\n"));
  EXPECT_NE(answer.short_table.find("2 of 5 cuts compared; 3 left out: above"),
            std::string::npos);
}

TEST(PlanAnswer, IsNoneWithoutACut) {
  PlanResult r = made();
  r.cuts.clear();
  r.heading.ok = false;
  r.heading.message = "nothing can be cut";
  const Answer answer = answer_of(r);
  EXPECT_EQ(answer.short_table, "No answer: nothing can be cut\n");
  EXPECT_TRUE(answer.tables.empty());
}

}  // namespace trochoid::results::plan_test
