#include <trochoid/run/identify/fit_options.h>

namespace trochoid::run {

identification::Options fit_options(const inputs::Case& given, chip::Model model) {
  return {
      .chip_model = model,
      .runout = given.identify.runout.value_or(identification::RunoutUnknowns::offsets),
      .phase = given.identify.phase,
      .band_harmonics = given.identify.band_harmonics.value_or(0),
      .fit_channel_offsets =
          given.identify.channel_offsets == inputs::ChannelOffset::fit,
      .errors = given.identify.errors};
}

identification::AxesProblem axes_problem(const inputs::Case& given) {
  return {given.setup, given.law,
          fit_options(given, given.identify.chip_models.back())};
}

Step axes_progress(double part) {
  return {"finding the axes of the dynamometer", part};
}

}  // namespace trochoid::run
