#include "case_text.h"

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::cases::case_plan_test {

using test::CaseFolder;

const std::string slot = test::tool + test::cut + test::force;

TEST(CasePlan, AnEmptyTableLooksAroundTheCut) {
  const CaseFolder folder;
  const Case c = folder.read(slot + "[plan]\n", Command::plan);
  EXPECT_EQ(c.plan.engagements.size(), 3U);
  ASSERT_EQ(c.plan.feeds.size(), 5U);
  EXPECT_DOUBLE_EQ(c.plan.feeds[0], 20e-6);
  EXPECT_DOUBLE_EQ(c.plan.feeds[4], 80e-6);
  EXPECT_EQ(c.plan.axial_depths, std::vector{2 * unit::mm});
  ASSERT_EQ(c.plan.radial_depths.size(), 4U);
  EXPECT_DOUBLE_EQ(c.plan.radial_depths[3], 6 * unit::mm);
  EXPECT_EQ(c.plan.quantities, (std::vector<std::string>{"K_tc", "K_rc", "runout"}));
  EXPECT_EQ(c.plan.turns, 10);
  EXPECT_FALSE(c.plan.noise || c.plan.max_force);
  EXPECT_NE(c.as_understood.find("feed_per_tooth_mm = [0.02, 0.03, 0.04, 0.06, 0.08]"),
            std::string::npos)
      << c.as_understood;
  EXPECT_EQ(folder.problems(c.as_understood, Command::plan), "");
  EXPECT_EQ(folder.read(slot, Command::plan).plan.feeds, c.plan.feeds)
      << "without the table";
}

TEST(CasePlan, TakesEveryKey) {
  const CaseFolder folder;
  const Plan p = folder
                     .read(slot + R"([plan]
engagement = ["down"]
feed_per_tooth_mm = [0.05]
axial_depth_mm = [1, 3]
radial_depth_mm = [0.5]
turns = 3
samples_per_rev = 90
noise_N = 4
max_force_N = 300
quantities = ["K_te_N_per_mm", "K_ac", "coefficients"]
)",
                           Command::plan)
                     .plan;
  EXPECT_EQ(p.engagements, std::vector{PlannedEngagement::down});
  EXPECT_EQ(p.axial_depths.size(), 2U);
  EXPECT_DOUBLE_EQ(p.radial_depths.at(0), 0.5e-3);
  EXPECT_EQ(p.turns, 3);
  EXPECT_EQ(p.samples_per_rev, 90);
  EXPECT_EQ(p.noise, 4.0);
  EXPECT_EQ(p.max_force, 300.0);
  EXPECT_EQ(p.quantities, (std::vector<std::string>{"K_te", "K_ac", "coefficients"}));
}

TEST(CasePlan, ARunoutThatIsNotLookedForIsNotPlanned) {
  const CaseFolder folder;
  const std::string fixed = slot + "[identify]\nrunout = \"fixed\"\n";
  EXPECT_EQ(folder.read(fixed, Command::plan).plan.quantities,
            (std::vector<std::string>{"K_tc", "K_rc"}));
  EXPECT_NE(
      folder.problems(fixed + "[plan]\nquantities = [\"runout\"]\n", Command::plan)
          .find("\"runout\" is not looked for"),
      std::string::npos);
}

TEST(CasePlan, TheNamesFollowTheLaw) {
  const CaseFolder folder;
  const std::string power =
      test::tool + test::cut +
      "[force]\nlaw = \"power\"\nK_t1_MPa = 1500\nK_r1_MPa = 700\n"
      "K_a1_MPa = 300\nm_t = 0.2\nm_r = 0.3\nm_a = 0.2\n";
  EXPECT_EQ(folder.read(power, Command::plan).plan.quantities.front(), "K_t1");
  EXPECT_EQ(folder.problems(power + "[plan]\nquantities = [\"m_t\"]\n", Command::plan),
            "");
  EXPECT_NE(folder.problems(power + "[plan]\nquantities = [\"K_tc\"]\n", Command::plan)
                .find("\"K_tc\" is none; must be of \"coefficients\", \"runout\", "
                      "\"K_t1\", \"K_r1\", \"K_a1\", \"m_t\""),
            std::string::npos);
}

TEST(CasePlan, NewPlanLacksOnlyItsRecord) {
  const CaseFolder folder;
  const std::string text = new_case(Command::plan);
  const std::string problem = folder.problems(text, Command::plan);
  EXPECT_NE(problem.find("measurement[1].file = \"record.csv\": there is no such file"),
            std::string::npos)
      << problem;
  EXPECT_EQ(std::count(problem.begin(), problem.end(), '\n'), 1);
  static_cast<void>(folder.write("record.csv", "x"));
  EXPECT_EQ(folder.problems(text, Command::plan), "");
  EXPECT_EQ(folder.problems(text, std::nullopt), "");
  EXPECT_EQ(folder.problems(text, Command::identify), "");
}

}  // namespace trochoid::cases::case_plan_test
