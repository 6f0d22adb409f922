#include "case_text.h"

#include <trochoid/base/units.h>
#include <trochoid/force/oblique.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

/// [orthogonal] in place of K_tc, K_rc and K_ac.
namespace trochoid::cases::case_orthogonal_test {

using test::CaseFolder;

const std::string edge =
    "[force]\nK_te_N_per_mm = 20\nK_re_N_per_mm = 40\nK_ae_N_per_mm = 0\n";
const std::string plain =
    "[orthogonal]\nshear_stress_MPa = [600]\nfriction_angle_deg = [25]\n"
    "shear_angle_deg = [30]\nrake_deg = 5\n";

const force::LinearEdge& law_of(const Case& c) {
  return std::get<force::LinearEdge>(c.law);
}

TEST(CaseOrthogonal, StandsForTheCoefficients) {
  const CaseFolder folder;
  const Case c = folder.read(test::tool + test::cut + edge + plain);
  const auto K = force::oblique_coefficients({.tau_s = 600 * unit::MPa,
                                              .phi_c = 30 * unit::deg,
                                              .beta_a = 25 * unit::deg,
                                              .alpha_n = 5 * unit::deg},
                                             c.setup.cutter.helix);
  EXPECT_NEAR(law_of(c).K_tc, K.K_tc, 1e-9 * K.K_tc);
  EXPECT_NEAR(law_of(c).K_rc, K.K_rc, 1e-9 * K.K_tc);
  EXPECT_NEAR(law_of(c).K_ac, K.K_ac, 1e-9 * K.K_tc);
  EXPECT_EQ(law_of(c).K_re, 40 * unit::N_per_mm);
  ASSERT_EQ(c.notes.size(), 1);
  EXPECT_EQ(c.notes[0].code, "orthogonal_cutting");
  // As it was understood it has the coefficients, and nothing is left to compute.
  EXPECT_EQ(c.as_understood.find("[orthogonal]"), std::string::npos) << c.as_understood;
  const Case again = folder.read(c.as_understood);
  EXPECT_EQ(law_of(again).K_tc, law_of(c).K_tc);
  EXPECT_TRUE(again.notes.empty());
}

TEST(CaseOrthogonal, IsTakenAtTheRakeAndTheMeanChip) {
  const CaseFolder folder;
  const std::string grown =
      "[orthogonal]\nshear_stress_MPa = [500, 2, 100]\nfriction_angle_deg = [20, 0.5]\n"
      "chip_ratio = [0.9, -0.01]\nchip_ratio_exponent = [0.2, -0.01]\nrake_deg = 10\n"
      "inclination_deg = 12\n";
  const Case c = folder.read(test::tool + test::cut + edge + grown);
  const double h = c.setup.cut.f_z * 2 / std::numbers::pi;  // of a slot
  const double ratio = 0.8 * std::pow(h / unit::mm, 0.1);
  const auto K =
      force::oblique_coefficients({.tau_s = (520 + 100 * h / unit::mm) * unit::MPa,
                                   .phi_c = force::shear_angle(ratio, 10 * unit::deg),
                                   .beta_a = 25 * unit::deg,
                                   .alpha_n = 10 * unit::deg},
                                  12 * unit::deg);
  EXPECT_NEAR(law_of(c).K_tc, K.K_tc, 1e-9 * K.K_tc);
  const Case thin =
      folder.read(test::tool + test::cut + edge + grown + "chip_mm = 0.01\n");
  EXPECT_GT(law_of(thin).K_tc, law_of(c).K_tc) << "a thinner chip is pressed more";
}

TEST(CaseOrthogonal, TheIncludingFileDecides) {
  const CaseFolder folder;
  folder.write("measured.toml", test::force);
  folder.write("tube.toml", edge + plain);
  const std::string rest = test::tool + test::cut;
  const Case computed = folder.read("include = \"measured.toml\"\n" + rest + plain);
  EXPECT_LT(law_of(computed).K_tc, 2500 * unit::MPa);
  EXPECT_EQ(law_of(computed).K_te, 7 * unit::N_per_mm);
  const Case measured = folder.read("include = \"tube.toml\"\n" + rest + test::force);
  EXPECT_EQ(law_of(measured).K_tc, 2620 * unit::MPa);
  EXPECT_TRUE(measured.notes.empty());
}

TEST(CaseOrthogonal, WhoeverFindsCoefficientsIsNotToldOfThese) {
  const CaseFolder folder;
  folder.write("run.csv", "time_s,Fx_N,Fy_N,Fz_N\n0,1,1,1\n1,1,1,1\n");
  const Case c = folder.read(
      test::tool + test::cut + edge + plain + "[[measurement]]\nfile = \"run.csv\"\n",
      Command::identify);
  EXPECT_TRUE(c.notes.empty());
}

TEST(CaseOrthogonal, MistakesAreTold) {
  const CaseFolder folder;
  const auto problems = [&](const std::string& text) {
    return folder.problems(test::tool + test::cut + text, Command::simulate);
  };
  EXPECT_EQ(
      problems(test::force + plain),
      "case.toml:11:12: force.K_tc_MPa: [orthogonal] says it as well; give one of "
      "them\n"
      "case.toml:12:12: force.K_rc_MPa: [orthogonal] says it as well; give one of "
      "them\n"
      "case.toml:13:12: force.K_ac_MPa: [orthogonal] says it as well; give one of "
      "them\n");
  EXPECT_NE(problems(edge + plain + "chip_ratio = [1]\n")
                .find("orthogonal.chip_ratio: shear_angle_deg says it as well"),
            std::string::npos);
  EXPECT_NE(problems(edge + "[orthogonal]\nshear_stress_MPa = [600]\n"
                            "friction_angle_deg = [75]\nshear_angle_deg = [30]\n"
                            "rake_deg = 5\n")
                .find("no chip flows so"),
            std::string::npos);
  EXPECT_EQ(folder
                .problems(test::tool + R"([cut]
engagement = "slot"
axial_depth_mm = 2.0
feed_rate_mm_per_min = -5
spindle_rpm = 875
)" + edge + plain)
                .find("no chip"),
            std::string::npos);
  EXPECT_NE(problems(edge + "[orthogonal]\nshear_stress_MPa = [600, 1, 2, 3]\n"
                            "friction_angle_deg = [25]\nshear_angle_deg = [30]\n"
                            "rake_deg = 5\n")
                .find("4 numbers; must be at most 3"),
            std::string::npos);
}

}  // namespace trochoid::cases::case_orthogonal_test
