#include <trochoid/run/identify.h>

#include <trochoid/base/units.h>

#include <gtest/gtest.h>

namespace trochoid::run::fit_options_test {

TEST(FitOptions, AreWhatTheCaseAsksFor) {
  cases::Case given;
  given.identify.runout = identification::RunoutUnknowns::eccentricity;
  given.identify.phase = 20 * unit::deg;
  given.identify.band_harmonics = 4;
  given.identify.channel_offsets = cases::ChannelOffset::fit;
  const auto options = fit_options(given, chip::Model::feed);
  EXPECT_EQ(options.chip_model, chip::Model::feed);
  EXPECT_EQ(options.runout, identification::RunoutUnknowns::eccentricity);
  EXPECT_EQ(options.phase, 20 * unit::deg);
  EXPECT_EQ(options.band_harmonics, 4);
  EXPECT_TRUE(options.fit_channel_offsets);
}

/// Offsets read off the idle parts are gone before anything is fitted.
TEST(FitOptions, FitNoOffsetsThatWereTakenOut) {
  cases::Case given;
  for (const auto offsets : {cases::ChannelOffset::none, cases::ChannelOffset::idle}) {
    given.identify.channel_offsets = offsets;
    EXPECT_FALSE(fit_options(given, chip::Model::feed).fit_channel_offsets);
  }
}

TEST(AxesProblem, TakesTheLastOfTheModels) {
  cases::Case given;
  given.setup.cut.f_z = 0.1 * unit::mm;
  given.law = force::Power{};
  given.identify.chip_models = {chip::Model::none, chip::Model::feed};
  const auto problem = axes_problem(given);
  EXPECT_EQ(problem.options.chip_model, chip::Model::feed);
  EXPECT_DOUBLE_EQ(problem.setup.cut.f_z, 0.1 * unit::mm);
  EXPECT_TRUE(std::holds_alternative<force::Power>(problem.law));
}

}  // namespace trochoid::run::fit_options_test
