#include <trochoid/structure/cantilever.h>

#include <gtest/gtest.h>
#include <boost/math/quadrature/gauss_kronrod.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::structure::cantilever_test {

namespace {

constexpr Cantilever paper{.overhang = 83e-3,
                           .flute_length = 45e-3,
                           .shank_diameter = 12e-3,
                           .flute_diameter = 9.6e-3,
                           .youngs_modulus = 206e9};
constexpr std::array<double, 9> heights = {0,     0.5e-3, 1.5e-3, 3e-3, 44.9e-3,
                                           45e-3, 60e-3,  82e-3,  90e-3};

/// Virtual work: moment of the load times moment of a unit force, over E I, by
/// adaptive quadrature from the holder to the step and from there on.
double by_virtual_work(const Cantilever& c, double z1, double z2) {
  const auto integrand = [&](double s) {
    const double moment = std::max(c.overhang - z1 - s, 0.0);
    const double unit = std::max(c.overhang - z2 - s, 0.0);
    const bool arbor = s < c.overhang - c.flute_length;
    const double d = arbor ? c.shank_diameter : c.flute_diameter;
    return moment * unit / (c.youngs_modulus * std::numbers::pi * std::pow(d, 4) / 64);
  };
  std::array<double, 4> ends = {0, c.overhang - c.flute_length, c.overhang - z1,
                                c.overhang - z2};
  for (double& end : ends) {
    end = std::clamp(end, 0.0, c.overhang);
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    if (ends[i] > ends[i - 1]) {
      sum += boost::math::quadrature::gauss_kronrod<double, 15>::integrate(
          integrand, ends[i - 1], ends[i], 5, 1e-13);
    }
  }
  return sum;
}

double tip_of_a_bar(double length, double diameter) {
  return 64 * length * length * length /
         (3 * 206e9 * std::numbers::pi * std::pow(diameter, 4));
}

}  // namespace

TEST(Cantilever, IsTheWorkOfTheMoments) {  // [B-1] [B-2]
  for (const double flute : {0.0, 1e-3, 45e-3, 83e-3, 100e-3}) {
    Cantilever c = paper;
    c.flute_length = flute;
    for (const double z1 : heights) {
      for (const double z2 : heights) {
        const double want = by_virtual_work(c, z1, z2);
        EXPECT_NEAR(compliance(c, z1, z2), want, 1e-11 * want + 1e-25)
            << flute << ' ' << z1 << ' ' << z2;
      }
    }
  }
}

TEST(Cantilever, DoesNotCareWhichPointIsLoaded) {  // [B-1]
  for (const double z1 : heights) {
    for (const double z2 : heights) {
      EXPECT_EQ(compliance(paper, z1, z2), compliance(paper, z2, z1));
      const auto parts = compliance_parts(paper, z1, z2);
      EXPECT_NEAR(parts.arbor_deflection + parts.arbor_slope + parts.fluted,
                  compliance(paper, z1, z2), 1e-12 * compliance(paper, 0, 0));
    }
  }
}

TEST(Cantilever, IsTheTextbookBarAtItsTip) {  // [B-1]
  Cantilever bar = paper;
  bar.flute_length = 0;
  EXPECT_NEAR(compliance(bar, 0, 0) / tip_of_a_bar(83e-3, 12e-3), 1, 1e-14);
  bar.flute_length = bar.overhang;
  EXPECT_NEAR(compliance(bar, 0, 0) / tip_of_a_bar(83e-3, 9.6e-3), 1, 1e-14);
}

TEST(Cantilever, PartsAreTheThreeTermsOfThePaper) {  // [B-2]
  const double load = 1.5e-3;
  const double h = 0.5e-3;
  const double L_s = 38e-3;
  const double p = 45e-3 - load;
  const double u = 45e-3 - h;
  const double EI_s = 206e9 * std::numbers::pi * std::pow(12e-3, 4) / 64;
  const double EI_t = 206e9 * std::numbers::pi * std::pow(9.6e-3, 4) / 64;
  const auto parts = compliance_parts(paper, h, load);
  EXPECT_NEAR(parts.arbor_deflection * EI_s / (L_s * L_s * L_s / 3 + p * L_s * L_s / 2),
              1, 1e-13);
  EXPECT_NEAR(parts.arbor_slope * EI_s / ((L_s * L_s / 2 + p * L_s) * u), 1, 1e-13);
  EXPECT_NEAR(
      parts.fluted * 6 * EI_t / (3 * p * u * u - u * u * u + std::pow(load - h, 3)), 1,
      1e-13);
}

TEST(Cantilever, ACoupleIsTheSlopeOfTheCompliance) {  // [B-12]
  const double d = 1e-5;
  for (const double seen : {0.0, 20e-3, 60e-3}) {
    for (const double at : {1e-3, 30e-3, 50e-3, 70e-3}) {
      const double slope =
          (compliance(paper, seen, at + d) - compliance(paper, seen, at - d)) / (2 * d);
      EXPECT_NEAR(couple_compliance(paper, seen, at), slope,
                  1e-6 * std::abs(couple_compliance(paper, 0, 0)));
    }
  }
  Cantilever bar = paper;  // M L^2/(2 E I), the textbook
  bar.flute_length = bar.overhang;
  const double EI = 206e9 * std::numbers::pi * std::pow(9.6e-3, 4) / 64;
  EXPECT_NEAR(couple_compliance(bar, 0, 0) * 2 * EI / (83e-3 * 83e-3), -1, 1e-13);
  EXPECT_EQ(couple_compliance(paper, 83e-3, 0), 0);
  EXPECT_EQ(couple_compliance(paper, 0, 90e-3), 0);
}

TEST(Cantilever, StandsStillInTheHolder) {  // [B-1]
  for (const double z : {83e-3, 90e-3}) {
    EXPECT_EQ(compliance(paper, z, 0), 0);
    EXPECT_EQ(compliance(paper, 0, z), 0);
  }
}

}  // namespace trochoid::structure::cantilever_test
