#include <trochoid/files/transmission_file.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <string>

/// The measured response of a dynamometer.
namespace trochoid::files::transmission_file_test {

std::string problems_of(const std::string& text) {
  try {
    transmission_of(text, "plate.csv");
  } catch (const base::InputError& error) {
    std::string all;
    for (const std::string& line : error.problems()) all += line + "\n";
    return all;
  }
  return "";
}

TEST(TransmissionFile, IsATableOfDirectAndCrossResponses) {
  const TransmissionFile file = transmission_of(
      "freq_Hz,H11_re,H11_im,H12_mag,H12_phase_deg,H22_re,H22_im\n"
      "10,1,0,0.1,90,1.02,0\n"
      "20,1.2,-0.4,0.2,0,1.04,0\n",
      "plate.csv");
  const auto H = signal::at(file.transmission, 15 * unit::Hz);
  EXPECT_NEAR(H[0].real(), 1.1, 1e-12);
  EXPECT_NEAR(H[0].imag(), -0.2, 1e-12);
  EXPECT_NEAR(H[1].real(), 0.1, 1e-12);
  EXPECT_NEAR(H[1].imag(), 0.05, 1e-12);
  EXPECT_NEAR(H[4].real(), 1.03, 1e-12);
  EXPECT_EQ(H[8], 1.0) << "a channel that is not there is rigid";
  EXPECT_EQ(H[3], 0.0);
  const auto slow = signal::at(file.transmission, 0.0);
  EXPECT_EQ(slow[1].imag(), 0.0) << "a static response has no phase";
  ASSERT_EQ(file.notes.size(), 1U);
  EXPECT_EQ(file.notes[0].code, "channel_without_response");
}

TEST(TransmissionFile, OfOneResponseHoldsForAllChannels) {
  const TransmissionFile file =
      transmission_of("freq_Hz;mag;phase_deg\n10;0.7;0\n20;1.1;-90\n", "plate.csv");
  const auto H = signal::at(file.transmission, 20 * unit::Hz);
  for (const std::size_t k : {0U, 4U, 8U}) EXPECT_NEAR(H[k].imag(), -1.1, 1e-12);
  ASSERT_EQ(file.notes.size(), 3U);
  EXPECT_EQ(file.notes[0].code, "response_not_calibrated");
}

/// A universal file with one frequency response, as text.
std::string uff(int response, int reference, int ordinate) {
  return fmt::format(
      "    -1\n    58\nplate\nNONE\n22-Nov-26\nNONE\nNONE\n"
      "    4         1    1         0       NONE         1{:4}       NONE         1{:4}\n"
      "         5         2         1  1.00000e+01  1.00000e+01  0.00000e+00\n"
      "        18    0    0    0                 NONE                   Hz\n"
      "        {}    0    0    0                 NONE                    N\n"
      "        13    0    0    0                 NONE                    N\n"
      "         0    0    0    0                 NONE                 NONE\n"
      "  1.00000e+00  0.00000e+00  1.10000e+00 -2.00000e-01\n    -1\n",
      response, reference, ordinate);
}

TEST(TransmissionFile, IsAUniversalFileOfForceOverForce) {
  const TransmissionFile file = transmission_of(uff(2, -1, 13), "plate.uff");
  const auto H = signal::at(file.transmission, 20 * unit::Hz);
  EXPECT_NEAR(H[3].real(), -1.1, 1e-6) << "channel 2 over a force against channel 1";
  EXPECT_NEAR(H[3].imag(), 0.2, 1e-6);
}

TEST(TransmissionFile, IsRefusedWhereItIsNone) {
  EXPECT_NE(problems_of(uff(1, 1, 12)).find("not of force over force"),
            std::string::npos)
      << problems_of(uff(1, 1, 12));
  EXPECT_NE(problems_of(uff(1, 5, 13)).find("directions 1 and 5"), std::string::npos);
  EXPECT_NE(problems_of("freq_Hz,a,b\n1,2,3\n").find("no columns freq_Hz, and H11_re"),
            std::string::npos);
  EXPECT_NE(problems_of("freq_Hz,re,im\n20,1,0\n10,1,0\n").find("plate.csv:3:1"),
            std::string::npos);
}

}  // namespace trochoid::files::transmission_file_test
