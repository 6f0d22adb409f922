#include "uff58_made.h"

#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/frf_file.h>

#include <numbers>
#include <string>

namespace trochoid::files::frf_file_test {

using structure::ResponseKind;

constexpr double Hz = 2 * std::numbers::pi;

FrfFile read(const std::string& text, const FrfSource& source = {}) {
  return read_frf(text, "made.txt", source);
}

TEST(FrfFile, UnitsOfAResponse) {
  const auto unit = [](std::string_view text) { return response_unit(text).value(); };
  EXPECT_EQ(unit("m/N").kind, ResponseKind::receptance);
  EXPECT_EQ(unit("um/N").factor, 1e-6);
  EXPECT_EQ(unit("\xC2\xB5m/N").factor, 1e-6);
  EXPECT_EQ(unit("m/s/N").kind, ResponseKind::mobility);
  EXPECT_EQ(unit("(m/s^2)/N").kind, ResponseKind::accelerance);
  EXPECT_EQ(unit("m/s\xC2\xB2/N").kind, ResponseKind::accelerance);
  EXPECT_EQ(unit("(1/N)*(m/s\xB2)").kind, ResponseKind::accelerance);
  EXPECT_DOUBLE_EQ(unit("[g/kN]").factor, 9.80665e-3);
  EXPECT_DOUBLE_EQ(unit("in/lbf").factor, 0.0254 / 4.4482216152605);
  EXPECT_EQ(unit("in/s^2/lbf").kind, ResponseKind::accelerance);
  EXPECT_FALSE(response_unit("N/m"));
  EXPECT_FALSE(response_unit("m"));
  EXPECT_FALSE(response_unit("V/N"));
}

TEST(FrfFile, TableWithNamesAndUnits) {
  const auto file = read("freq_Hz,re_mm/N,im_mm/N\n10,1,-2\n20,3,4\n");
  EXPECT_EQ(file.response.kind, ResponseKind::receptance);
  ASSERT_EQ(file.response.omega.size(), 2u);
  EXPECT_DOUBLE_EQ(file.response.omega[1], 20 * Hz);
  EXPECT_EQ(file.response.H[0], std::complex<double>(1e-3, -2e-3));
  EXPECT_TRUE(file.notes.empty());
}

TEST(FrfFile, MagnitudesMayBeDecibels) {
  for (const auto* const name :
       {"mag_dB re 1 m/N", "Magnitude (dB ref 1 m/N)", "Magnitude [dB re m/N]"}) {
    const auto file = read(std::string("f_Hz;") + name + ";phase_deg\n5;-120;90\n");
    EXPECT_EQ(file.response.kind, ResponseKind::receptance) << name;
    EXPECT_NEAR(std::abs(file.response.H[0] - std::complex<double>(0, 1e-6)), 0.0,
                1e-15)
        << name;
  }
  const auto silent =
      read("f_Hz;mag_dB;phase_deg\n5;-20;0\n", {.kind = ResponseKind::mobility});
  EXPECT_NEAR(silent.response.H[0].real(), 0.1, 1e-12);
}

TEST(FrfFile, MagnitudeAndPhaseInAnyOrder) {
  const auto file = read("phase_deg; frequency [Hz]; magnitude [m/s^2/N]\n90;5;2\n");
  EXPECT_EQ(file.response.kind, ResponseKind::accelerance);
  EXPECT_NEAR(std::abs(file.response.H[0] - std::complex<double>(0, 2)), 0.0, 1e-15);
}

TEST(FrfFile, PlainTableOfATapTest) {
  FrfSource source;
  source.kind = ResponseKind::receptance;
  const std::string text =
      "% written by a tap-test program\nFrequency Real Imag\n"
      " 1.000E+1   1.5e-08  -2.0E-08\n 1.100E+1\t1.6e-08 -2.1E-08\n";
  const auto file = read(text, source);
  ASSERT_EQ(file.response.H.size(), 2u);
  EXPECT_EQ(file.response.H[0], std::complex<double>(1.5e-8, -2e-8));
  ASSERT_EQ(file.notes.size(), 1u);
  EXPECT_EQ(file.notes[0].code, "unit_assumed");
  const auto comma = read("10,5;1,5;-2,25\n11,5;1,25;-2,5\n", source);
  EXPECT_EQ(comma.response.H[0], std::complex<double>(1.5, -2.25));
}

TEST(FrfFile, UniversalFile) {
  MadeSet set{.x = {1, 2, 3}, .y = {{1, 1}, {2, 0}, {3, -1}}, .unit = "g"};
  const auto file = read(as_binary(set, true));
  EXPECT_EQ(file.response.kind, ResponseKind::accelerance);
  EXPECT_NEAR(file.response.H[2].real(), 3 * 9.80665, 1e-12);
  EXPECT_NE(file.description.find("7-x for a force at 7+x"), std::string::npos)
      << file.description;
  const std::string two = as_text(set) + as_text(set);
  FrfSource source;
  source.dataset = 2;
  EXPECT_EQ(read(two, source).response.H.size(), 3u);
}

void expect_problem(const std::string& text, const std::string& place,
                    const std::string& words, const FrfSource& source = {}) {
  try {
    read(text, source);
    FAIL() << "accepted: " << words;
  } catch (const base::InputError& error) {
    const auto& line = error.problems().front();
    EXPECT_EQ(line.substr(0, place.size() + 1), place + ":") << line;
    EXPECT_NE(line.find(words), std::string::npos) << line;
  }
}

TEST(FrfFile, WhatIsWrongIsToldWithItsPlace) {
  expect_problem("", "made.txt:1:1", "no row of numbers");
  expect_problem("1,2,3\n2,3,4\n", "made.txt:1:1", "--kind");
  expect_problem("freq_Hz,re,im\n1,2,3\n", "made.txt:1:9", "says no unit");
  expect_problem("freq_Hz,re_V/N,im_V/N\n1,2,3\n", "made.txt:1:9", "no unit of a resp");
  expect_problem("freq_Hz,re_m/N,im_m/N\n1,2,x\n", "made.txt:2:1", "no row of numbers");
  expect_problem("freq_Hz,re_m/N,im_m/N\n1,2,3\n2,3,x\n", "made.txt:3:5",
                 "not a number");
  expect_problem("freq_Hz,re_m/N,im_m/N\n1,2,3\n2,3\n", "made.txt:3:1", "complete");
  expect_problem("freq_Hz,re_m/N,im_m/N\n1,2,nan\n", "made.txt:2:5", "finite");
  expect_problem("freq_Hz,re_m/N,im_m/N\n2,2,3\n1,2,3\n", "made.txt:3:1", "increase");
  expect_problem("freq_Hz,re_m/N,im_m/N\n-2,2,3\n", "made.txt:2:1", "negative");
  expect_problem("freq_rpm,re_m/N,im_m/N\n2,2,3\n", "made.txt:1:1", "Hz is right");
  expect_problem("f,mag_m/N,phase\n2,2,3\n", "made.txt:1:11", "phase_deg or phase_rad");
  expect_problem("f,abc,d\n2,2,3\n", "made.txt:1:1",
                 "the columns are \"f\", \"abc\", \"d\"");
  expect_problem("f,re_m/N,im_m/N,real_m/N\n2,2,3,4\n", "made.txt:1:17", "could both");
  FrfSource wrong;
  wrong.kind = ResponseKind::mobility;
  expect_problem("f,re_m/N,im_m/N\n2,2,3\n", "made.txt:1:3",
                 "does not fit the given kind", wrong);
}

TEST(FrfFile, WhatIsWrongWithAUniversalFile) {
  MadeSet set{.x = {1, 2, 3}, .y = {{1, 1}, {2, 0}, {3, -1}}};
  MadeSet cut = set;
  cut.promised = 4000;
  expect_problem(as_text(cut), "made.txt:2:1", "cut off");
  expect_problem(as_text(set) + as_text(set), "made.txt:1:1", "choose one");
  MadeSet real = set;
  real.type = 2;
  expect_problem(as_text(real), "made.txt:2:1", "phase is lost");
  MadeSet time = set;
  time.function = 1;
  expect_problem(as_text(time), "made.txt:1:1", "no frequency response");
  expect_problem(as_text(time), "made.txt:1:1", "1 measured function (time record)");
  expect_problem(
      "    -1\n    15\n         1         0         0        11  0. 0. 0.\n    -1\n",
      "made.txt:1:1", "only 1 data set of other kinds (the first is a 15)");
}

}  // namespace trochoid::files::frf_file_test
