#include "made_wall.h"

#include <trochoid/surface/stepwise_turn.h>

#include <gtest/gtest.h>

namespace trochoid::surface::march_test {

constexpr Coefficients K = {800e6, 300e6, 2e3, 1e3};

/// Largest and root mean square difference in F_y from steady_state, of its peak.
std::pair<double, double> difference(const MadeCut& s, Feedback feedback) {
  const Compliance compliance(cutter_only()(0.0), s.cut.a_p, 0.0, Load::distributed);
  const force::Law edges_only = law(0, 0, K[2], K[3]);
  const EdgeMoments edges(s, edges_only, compliance.basis());
  const SteadyState exact = steady_state(edges, K, compliance, feedback, 1e-6);
  EXPECT_TRUE(exact.converged);
  const StepwiseTurn turn =
      stepwise_steady_state(s, edges_only, K, compliance, feedback);
  EXPECT_TRUE(turn.converged);
  const auto straight = with_coefficients(unit_moments(edges, 1e-5), K);
  const auto marched = with_feedback(straight, turn);
  const std::size_t F_y = marched.functions() - 1;
  double peak = 0.0;
  double worst = 0.0;
  double sum = 0.0;
  const auto at = angles(360);
  for (const double phi : at) {
    const double d = value_at(marched, phi, F_y) - value_at(exact.moments, phi, F_y);
    peak = std::max(peak, std::abs(value_at(exact.moments, phi, F_y)));
    worst = std::max(worst, std::abs(d));
    sum += d * d;
  }
  return {worst / peak, std::sqrt(sum / static_cast<double>(at.size())) / peak};
}

TEST(March, FindsTheSteadyState) {  // [E-10] [E-25]
  for (const auto model : {chip::Model::radial, chip::Model::trochoidal}) {
    for (const bool down : {true, false}) {
      MadeCut s = with_runout(made_cut(down), 5e-6, 1.2);
      s.chip.model = model;
      for (const Feedback feedback : {Feedback::entry, Feedback::regenerative}) {
        const auto [worst, rms] = difference(s, feedback);
        EXPECT_LT(worst, 0.03) << static_cast<int>(model) << down;  // at an entry
        EXPECT_LT(rms, 0.004) << static_cast<int>(model) << down;
      }
    }
  }
}

TEST(March, BeginsFromAnotherTurn) {  // [E-25]
  const MadeCut s = with_runout(made_cut(), 5e-6, 1.2);
  const Compliance compliance(cutter_only()(0.0), s.cut.a_p, 0.0, Load::distributed);
  const Coefficients softer = {780e6, 310e6, 0.0, 0.0};
  const StepwiseTurn there =
      stepwise_steady_state(s, law(0, 0), softer, compliance, Feedback::regenerative);
  const Coefficients here = {800e6, 300e6, 0.0, 0.0};
  const StepwiseTurn cold =
      stepwise_steady_state(s, law(0, 0), here, compliance, Feedback::regenerative);
  const StepwiseTurn warm = stepwise_steady_state(s, law(0, 0), here, compliance,
                                                  Feedback::regenerative, &there);
  ASSERT_TRUE(cold.converged && warm.converged);
  double peak = 0.0;
  for (const double m : cold.moments) {
    peak = std::max(peak, std::abs(m));
  }
  for (std::size_t k = 0; k < cold.moments.size(); ++k) {
    EXPECT_NEAR(warm.moments[k], cold.moments[k], 2e-3 * peak);
  }
}

}  // namespace trochoid::surface::march_test
