#include "made_response.h"

#include <gtest/gtest.h>
#include <trochoid/structure/stabilisation.h>

#include <algorithm>
#include <cmath>

namespace trochoid::structure::stabilisation_test {

using made::Hz;
using made::mode_of;

TEST(Stabilisation, ModesStandInColumnsAndNoiseDoesNot) {  // [M-18]
  const auto poles = stabilisation(
      made::response({mode_of(500, 0.02, 1.0), mode_of(1200, 0.03, 0.5)},
                     ResponseKind::accelerance, {100, 2000, 2}, {.floor = 0.01}),
      7);
  for (const double f : {500.0, 1200.0}) {
    for (int order = 4; order <= 7; ++order) {
      EXPECT_TRUE(std::any_of(poles.begin(), poles.end(),
                              [&](const TriedPole& p) {
                                return p.order == order &&
                                       p.standing == PoleStanding::stable &&
                                       std::abs(p.omega - f * Hz) < 0.01 * f * Hz;
                              }))
          << f << " at order " << order;
    }
  }
  EXPECT_TRUE(std::any_of(poles.begin(), poles.end(), [](const TriedPole& p) {
    return p.order > 4 && p.standing == PoleStanding::fresh;
  })) << "poles of noise move";
  EXPECT_TRUE(std::all_of(poles.begin(), poles.end(), [](const TriedPole& p) {
    return p.order > 1 || p.standing == PoleStanding::fresh;
  })) << "before the first order there is none";
}

TEST(Stabilisation, AModeIsIndicatedAtItsNaturalFrequency) {  // [M-19]
  const Mode mode = mode_of(700, 0.02, 1.0);
  for (const auto kind :
       {ResponseKind::receptance, ResponseKind::mobility, ResponseKind::accelerance}) {
    const auto lines = made::response({mode}, kind, {100, 1300, 100});
    const auto mif = mode_indicator(lines);
    EXPECT_NEAR(mif[6], 1.0, 1e-12);
    const double f = 100;  // far below: the phase is -atan(2 zeta r/(1 - r^2))
    const double r = f / 700;
    const double t = 2 * 0.02 * r / (1 - r * r);
    EXPECT_NEAR(mif[0], t * t / (1 + t * t), 1e-12);
  }
}

}  // namespace trochoid::structure::stabilisation_test
