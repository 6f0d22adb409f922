#include <trochoid/base/error.h>
#include <trochoid/results/joint_of_fit.h>
#include <trochoid/results/json.h>

#include "../identification/made_record.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

namespace trochoid::results::joint_test {

using identification::Fit;
using identification::made_record;
using identification::RunoutUnknowns;
using identification::slot_setup;
using identification::steel;
using identification::without_runout;

force::Setup slot() {
  return slot_setup(3, 30.0, 3.0 * unit::mm);
}

Fit fit_of(const force::Setup& tool, RunoutUnknowns form) {
  std::vector<identification::Run> runs;
  for (const unsigned seed : {1U, 2U}) {
    runs.push_back(
        made_record(tool, steel(), {.per_turn = 120, .noise = 10.0, .seed = seed}));
    runs.back().group = seed == 1 ? "new" : "worn";
  }
  identification::Options options;
  options.runout = form;
  options.errors = identification::Errors::white;
  options.phase = 0.0;
  return identify(without_runout(tool), steel(), runs, options);
}

double half(const Joint& joint, std::size_t i) {
  return joint.factors[i] * std::sqrt(joint.covariance[i * (joint.names.size() + 1)]);
}

std::size_t place(const Joint& joint, const char* name) {
  return static_cast<std::size_t>(std::ranges::find(joint.names, name) -
                                  joint.names.begin());
}

TEST(JointOfAFit, HasTheIntervalsOfTheFit) {  // [U-1]
  force::Setup tool = slot();
  tool.runout.radial_offsets = {0.0, -8.0 * unit::um, 5.0 * unit::um};
  const Fit fit = fit_of(tool, RunoutUnknowns::offsets);
  ASSERT_TRUE(fit.ok) << fit.message;
  ASSERT_EQ(fit.groups.size(), 2U);
  const auto quantities = force::coefficient_quantities(fit.law);
  for (const std::size_t group : {std::size_t{0}, std::size_t{1}}) {
    const Joint joint = joint_of(fit, group);
    ASSERT_EQ(joint.names.size(), 8U) << "six coefficients of one group, two offsets";
    EXPECT_EQ(joint.law, "linear_edge");
    EXPECT_EQ(joint.teeth, 3U);
    for (std::size_t q = 0; q < 6; ++q) {
      const auto& K = *fit.groups[group].coefficients[q];
      EXPECT_EQ(joint.names[q], "force." + std::string(quantities[q].key));
      EXPECT_DOUBLE_EQ(joint.values[q], K.value / quantities[q].unit);
      EXPECT_NEAR(half(joint, q) * 2 * quantities[q].unit / (K.high - K.low), 1, 1e-9);
    }
    const std::size_t third = place(joint, "runout.radial_offsets_mm[3]");
    ASSERT_EQ(third, 7U);
    EXPECT_NEAR(half(joint, third) * unit::mm /
                    (fit.interval_factor * *fit.radial_offsets_se[2]),
                1, 1e-9);
  }
}

TEST(JointOfAFit, HasTheComponentsOfAnEccentricityThatMayBeNone) {
  const Fit fit = fit_of(slot(), RunoutUnknowns::eccentricity);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_TRUE(identification::unidentifiable(fit, "eccentricity_mm"));
  const Joint joint = joint_of(fit, 0);
  const std::size_t x = place(joint, "runout.e_x_mm");
  ASSERT_EQ(place(joint, "runout.e_y_mm"), x + 1);
  ASSERT_LT(x + 1, joint.names.size());
  EXPECT_LT(std::abs(joint.values[x]), 2 * half(joint, x));
  EXPECT_TRUE(joint.not_found.empty());
}

TEST(JointOfAFit, HasNoRunoutWithoutOne) {
  const Fit fit = fit_of(slot(), RunoutUnknowns::none);
  const Joint joint = joint_of(fit, 0);
  EXPECT_EQ(joint.names.size(), 6U);
  EXPECT_EQ(joint.teeth, 0U);
}

TEST(ReadJoint, ReadsBackTheSameBits) {
  const Fit fit = fit_of(slot(), RunoutUnknowns::offsets);
  Joint joint = joint_of(fit, 0);
  joint.not_found = {{"force.K_ae_N_per_mm", "why, \"so\""}};
  const auto file = std::filesystem::temp_directory_path() / "trochoid_joint.json";
  std::ofstream(file) << json_text(Object{
      {"trochoid", Object{}},
      {"command", "identify"},
      {"status", "ok"},
      {"result", Object{{"verdict", "do not use"},
                        {"covariance", joint_value(joint)},
                        {"groups", Array{Object{{"group", "worn"},
                                                {"covariance",
                                                 joint_value(joint_of(fit, 1))}}}}}}});
  const ReadJoint back = read_joint(file, "");
  EXPECT_EQ(back.joint.names, joint.names);
  EXPECT_EQ(back.joint.values, joint.values);
  EXPECT_EQ(back.joint.factors, joint.factors);
  EXPECT_EQ(back.joint.covariance, joint.covariance);
  EXPECT_EQ(back.joint.not_found, joint.not_found);
  EXPECT_TRUE(back.do_not_use);
  EXPECT_EQ(read_joint(file, "worn").joint.values, joint_of(fit, 1).values);
  EXPECT_THROW(read_joint(file, "old"), base::InputError);
  std::filesystem::remove(file);
}

}  // namespace trochoid::results::joint_test
