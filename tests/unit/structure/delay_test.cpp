#include "made_response.h"

#include <trochoid/structure/delay.h>
#include <trochoid/structure/identify_modes.h>

#include <gtest/gtest.h>

namespace trochoid::structure::delay_test {

TEST(DelayedFit, TakesADelayBetweenTheChannelsOut) {  // [M-36]
  const std::vector<Mode> truth = {made::mode_of(800, 0.02, 0.8),
                                   made::mode_of(1900, 0.03, 0.5)};
  for (const double delay : {25e-6, -40e-6, 0.0}) {
    auto response = made::response(truth, ResponseKind::accelerance, {100, 3000, 8},
                                   {.fraction = 0.01});
    for (std::size_t i = 0; i < response.H.size(); ++i) {
      response.H[i] *= std::polar(1.0, -response.omega[i] * delay);
    }
    const ModesFit direct = identify_modes(response, {});
    ASSERT_TRUE(direct.ok);
    const auto found = delayed_fit(response, {}, direct);
    ASSERT_EQ(found.has_value(), delay != 0) << delay;
    if (!found) continue;
    EXPECT_NEAR(found->delay.time.value, delay, 4 * found->delay.time.se);
    EXPECT_LT(found->delay.time.se, 1e-6);
    EXPECT_GT(std::abs(found->delay.mass_error), 0.002);
    ASSERT_EQ(found->fit.modes.size(), truth.size());
    for (std::size_t r = 0; r < truth.size(); ++r) {
      const FittedMode& mode = found->fit.modes[r];
      EXPECT_NEAR(mode.mass.value, truth[r].mass, 4 * mode.mass.se);
      EXPECT_NEAR(mode.stiffness.value, truth[r].stiffness, 4 * mode.stiffness.se);
    }
  }
}

TEST(DelayedFit, ATurnedModeIsNoDelay) {  // [M-36]
  // One mode of two is turned: a delay would turn the other as well.
  auto response = made::response({made::mode_of(600, 0.02, 0.8)},
                                 ResponseKind::accelerance, {100, 3000, 8});
  const auto other = made::response({made::mode_of(1900, 0.02, 0.5)},
                                    ResponseKind::accelerance, {100, 3000, 8});
  for (std::size_t i = 0; i < response.H.size(); ++i) {
    response.H[i] = response.H[i] * std::polar(1.0, 0.3) + other.H[i];
  }
  const ModesFit direct = identify_modes(response, {});
  const auto complex = complex_check(direct);
  ASSERT_TRUE(complex.has_value());
  EXPECT_TRUE(complex->complex());
  EXPECT_FALSE(delayed_fit(response, {}, direct).has_value());
}

TEST(DelayedFit, IsNotLookedForWithoutModes) {
  const auto response = made::response({made::mode_of(5000, 0.02, 0.8)},
                                       ResponseKind::receptance, {100, 1000, 8});
  const ModesFit none = identify_modes(response, {});
  ASSERT_FALSE(none.ok);
  EXPECT_FALSE(delayed_fit(response, {}, none).has_value());
}

}  // namespace trochoid::structure::delay_test
