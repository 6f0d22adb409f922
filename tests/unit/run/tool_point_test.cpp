#include "../cases/case_text.h"
#include "slot_case.h"

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/run/commands.h>
#include <trochoid/run/vibration.h>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <random>

namespace trochoid::run::tool_point_test {

using cases::Command;
using cases::test::CaseFolder;

const std::string slot =
    small_cut("engagement = \"slot\"", "0.3", 12000) + R"([stability]
spindle_rpm = [12000, 12500, 2]
axial_depth_mm = [0.1, 4, 10]
)";

struct Tap {
  double scale = 1.0;  ///< -1: the sensor points the wrong way
  double noise = 0.0;  ///< of the receptance, of its peak
  double from = 200;   ///< [Hz]
  double to = 4000;
  double step = 2;
};

/// A tap test of one mode of 922 Hz, in m/N.
std::string tapped(const Tap& tap, double mass = 0.03993, double hertz = 922) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  std::string text = "freq_Hz,re_m/N,im_m/N\n";
  const double k = mass * std::pow(hertz * unit::Hz, 2);
  const double c = 2 * 0.011 * std::sqrt(k * mass);
  const double peak = 1 / (0.022 * k);
  for (double f = tap.from; f <= tap.to; f += tap.step) {
    const double w = f * unit::Hz;
    std::complex<double> H = tap.scale / std::complex<double>(k - mass * w * w, c * w);
    H += tap.noise * peak * std::complex<double>(normal(random), normal(random));
    text += fmt::format("{},{},{}\n", f, H.real(), H.imag());
  }
  return text;
}

const std::string along_x = "[[measured_frf]]\nfile = \"x.csv\"\naxis = \"x\"\n";

results::StabilityResult answered(const std::string& csv,
                                  const std::string& more = along_x) {
  const CaseFolder folder;
  folder.write("x.csv", csv);
  return stability(
      cases::read_case(folder.write("case.toml", slot + more), Command::stability), {});
}

bool warned(const results::StabilityResult& r, const char* code) {
  return std::ranges::any_of(r.heading.warnings,
                             [&](const base::Warning& w) { return w.code == code; });
}

TEST(ToolPoint, GivesTheLimitWithoutModesAndWithThoseFittedToIt) {  // [D-22]
  const auto r = answered(tapped({}));
  ASSERT_TRUE(r.measured && r.measured->multi_frequency.limit && r.stability.limit);
  EXPECT_TRUE(r.measured->modes_fitted);
  const double limit = r.stability.limit->limit.depth;
  EXPECT_NEAR(limit, 2.1493e-3, 2e-6);
  // lines 2 Hz apart under a peak 20 Hz wide
  EXPECT_NEAR(r.measured->multi_frequency.limit->depth, limit, 3e-3 * limit);
  EXPECT_NEAR(r.measured->zeroth_order.limit->depth, 1.4314e-3, 5e-6);
  EXPECT_EQ(r.measured->multi_frequency.curve.size(), 2U);
  ASSERT_EQ(r.heading.warnings.size(), 1U);
  EXPECT_EQ(r.heading.warnings.front().code, "one_direction");
}

/// Motion along one axis over force along another of two modes askew by 20 degrees.
std::string askew(bool motion_y, bool force_y, double turned) {
  const double angle = turned * unit::deg;
  std::string text = "freq_Hz,re_m/N,im_m/N\n";
  for (double f = 200; f <= 4000; f += 2) {
    const double w = f * unit::Hz;
    std::complex<double> H;
    for (const bool second : {false, true}) {
      const double a = second ? angle + 90 * unit::deg : angle;
      const double hertz = second ? 1080 : 920;
      const double mass = second ? 0.07 : 0.08;
      const double k = mass * std::pow(hertz * unit::Hz, 2);
      H += (motion_y ? std::sin(a) : std::cos(a)) *
           (force_y ? std::sin(a) : std::cos(a)) /
           std::complex<double>(k - mass * w * w, 0.06 * std::sqrt(k * mass) * w);
    }
    text += fmt::format("{},{},{}\n", f, H.real(), H.imag());
  }
  return text;
}

TEST(ToolPoint, ACrossResponseTellsHowModesLie) {  // [D-25]
  for (const double turned : {20.0, -35.0}) {
    const CaseFolder folder;
    folder.write("x.csv", askew(false, false, turned));
    folder.write("y.csv", askew(true, true, turned));
    folder.write("xy.csv", askew(false, true, turned));
    std::vector<base::Warning> warnings;
    const auto given = cases::read_case(
        folder.write("case.toml",
                     slot + along_x +
                         "[[measured_frf]]\nfile = \"y.csv\"\naxis = \"y\"\n"
                         "[[measured_frf]]\nfile = \"xy.csv\"\naxis = \"x\"\n"
                         "force_axis = \"y\"\n"),
        Command::stability);
    const auto point = dynamics::tool_point(tool_responses(given, warnings), true);
    ASSERT_EQ(point.modes.modes.size(), 2U) << turned;
    const dynamics::ChipMode& first = point.modes.modes[0];
    const dynamics::ChipMode& second = point.modes.modes[1];
    EXPECT_NEAR(first.mass, 0.08, 1e-4);
    EXPECT_NEAR(second.mass, 0.07, 1e-4);
    EXPECT_NEAR(first.y / first.x, std::tan(turned * unit::deg), 1e-3);
    EXPECT_NEAR(-second.x / second.y, std::tan(turned * unit::deg), 1e-3);
    EXPECT_EQ(point.response.parts.size(), 4U) << "y to a force along x as well";
  }
}

TEST(ModesAskew, ChatterInTimeWhereTheMultiplierSaysSo) {  // [D-1] [D-2]
  const std::string modes =
      "[[mode]]\nbody = \"tool\"\naxis = \"x\"\nangle_deg = 35\nmass_kg = 0.04\n"
      "frequency_Hz = 920\ndamping_ratio = 0.03\n"
      "[[mode]]\nbody = \"tool\"\naxis = \"y\"\nangle_deg = 35\nmass_kg = 0.03\n"
      "frequency_Hz = 1080\ndamping_ratio = 0.03\n";
  const CaseFolder folder;
  const auto limit = stability(
      cases::read_case(folder.write("case.toml", slot + modes), Command::stability),
      {});
  ASSERT_TRUE(limit.stability.limit);
  const auto verdict_at = [&](double factor) {
    std::string text = slot;
    const std::string depth = "axial_depth_mm = 0.3";
    text.replace(text.find(depth), depth.size(),
                 fmt::format("axial_depth_mm = {}",
                             factor * limit.stability.limit->limit.depth / unit::mm));
    return dynamics(cases::read_case(folder.write("case.toml", text + modes),
                                     Command::dynamics),
                    {})
        .steady->verdict;
  };
  EXPECT_FALSE(dynamics::chatters(verdict_at(0.8)));
  EXPECT_TRUE(dynamics::chatters(verdict_at(1.3)));
}

/// One mode of 800 Hz whose residue is turned, as of a damper in one place.
std::string turned_response(double turned) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const double omega = 800 * unit::Hz;
  const double damped = omega * std::sqrt(1 - 0.03 * 0.03);
  const std::complex<double> pole(-0.03 * omega, damped);
  const std::complex<double> residue = omega * omega / 2e7 /
                                       std::complex<double>(0, 2 * damped) *
                                       std::polar(1.0, turned * unit::deg);
  std::string text = "freq_Hz,re_m/N,im_m/N\n";
  for (double f = 300; f <= 2000; f += 2) {
    const std::complex<double> s(0, f * unit::Hz);
    std::complex<double> H =
        residue / (s - pole) + std::conj(residue) / (s - std::conj(pole));
    H += (0.005 * std::abs(H) + 2e-10) *
         std::complex<double>(normal(random), normal(random));
    text += fmt::format("{},{:.6g},{:.6g}\n", f, H.real(), H.imag());
  }
  return text;
}

const std::string half_immersion =
    "[tool]\nteeth = 2\ndiameter_mm = 12\nhelix_deg = 0\n[cut]\nengagement = \"down\"\n"
    "radial_depth_mm = 6\naxial_depth_mm = 7\nfeed_per_tooth_mm = 0.05\n"
    "spindle_rpm = 9000\n[force]\nK_tc_MPa = 700\nK_rc_MPa = 200\nK_ac_MPa = 0\n"
    "K_te_N_per_mm = 0\nK_re_N_per_mm = 0\nK_ae_N_per_mm = 0\n"
    "[[measured_frf]]\nfile = \"y.csv\"\naxis = \"y\"\n"
    "[stability]\nspindle_rpm = [9000, 9000, 1]\naxial_depth_mm = [0.05, 12, 40]\n";

TEST(ToolPoint, OfComplexModesIsJudgedByThem) {  // [D-35] [M-30]
  for (const auto& [turned, limit] :
       {std::pair{-20.0, 5.851e-3}, {-10.0, 6.729e-3}, {10.0, 9.91e-3}}) {
    const CaseFolder folder;
    folder.write("y.csv", turned_response(turned));
    const auto r = stability(
        cases::read_case(folder.write("case.toml", half_immersion), Command::stability),
        {});
    EXPECT_EQ(r.judged_by, results::JudgedBy::complex_modes) << turned;
    ASSERT_TRUE(results::judged_limit(r)) << turned;
    EXPECT_NEAR(*results::judged_limit(r), limit, 0.02 * limit) << turned;
    EXPECT_EQ(results::judged_verdict(r), limit < 7e-3
                                              ? dynamics::StabilityVerdict::unstable
                                              : dynamics::StabilityVerdict::stable);
    EXPECT_FALSE(warned(r, "solutions_differ")) << turned;
  }
}

TEST(ToolPoint, WhatNoModesDescribeIsJudgedByItsResponse) {
  // With a cross response modes are real, and these do not describe a turned residue.
  const CaseFolder folder;
  const Tap stiff{.from = 300, .to = 2000};
  folder.write("y.csv", turned_response(-20));
  folder.write("x.csv", tapped(stiff, 2.0, 1700));
  folder.write("xy.csv", tapped({.scale = 0.01, .from = 300, .to = 2000}, 2.0, 1700));
  const std::string more =
      "[[measured_frf]]\nfile = \"xy.csv\"\naxis = \"x\"\nforce_axis = \"y\"\n";
  const auto r = stability(
      cases::read_case(folder.write("case.toml", half_immersion + along_x + more),
                       Command::stability),
      {});
  EXPECT_EQ(r.judged_by, results::JudgedBy::response);
  EXPECT_TRUE(warned(r, "solutions_differ"));
  ASSERT_TRUE(results::judged_limit(r));
  EXPECT_NEAR(*results::judged_limit(r), 5.85e-3, 0.1e-3);
  EXPECT_EQ(results::judged_verdict(r), dynamics::StabilityVerdict::unstable);
  EXPECT_TRUE(r.heading.message.starts_with("By the measured response: Unstable"))
      << r.heading.message;
}

TEST(ToolPoint, RefusesASensorThatPointsAgainstTheForce) {
  EXPECT_THROW(answered(tapped({.scale = -1})), base::InputError);
}

TEST(ToolPoint, RefusesABandWithoutLines) {
  EXPECT_THROW(answered(tapped({}), along_x + "band_Hz = [4100, 5000]\n"),
               base::InputError);
}

TEST(ToolPoint, SaysWhatAResponseCannotSay) {
  EXPECT_TRUE(warned(answered(tapped({.noise = 0.01})), "noise"));
  EXPECT_FALSE(warned(answered(tapped({.noise = 1e-4})), "noise"));
  EXPECT_TRUE(warned(answered(tapped({.to = 1200})), "band_short_above"));
  EXPECT_TRUE(warned(answered(tapped({.from = 800})), "band_short_below"));
  EXPECT_TRUE(warned(answered(tapped({.step = 7})), "few_lines"));
  EXPECT_FALSE(warned(answered(tapped({.noise = 0.01})), "few_lines"))
      << "a peak of noise is none";
  const auto cut_off = answered(tapped({.to = 921}));
  EXPECT_TRUE(warned(cut_off, "peak_at_the_edge"));
}

TEST(ToolPoint, WithoutModesTheResponseDecides) {
  // Half of the peak: no mode can be fitted.
  const auto r = answered(tapped({.to = 921}));
  EXPECT_FALSE(r.no_modes.empty());
  EXPECT_TRUE(warned(r, "no_modes"));
  EXPECT_TRUE(r.heading.ok);
  EXPECT_NE(r.heading.message.find("By the measured response"), std::string::npos);
}

}  // namespace trochoid::run::tool_point_test
