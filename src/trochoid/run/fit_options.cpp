#include <trochoid/run/fit_options.h>

namespace trochoid::run {

identification::Options fit_options(const inputs::Case& given, chip::Model model) {
  using identification::RunoutUnknowns;
  identification::Options options{
      .chip_model = model,
      .phase = given.identify.phase,
      .band_harmonics = given.identify.band_harmonics,
      .fit_channel_offsets =
          given.identify.channel_offsets == inputs::ChannelOffset::fit};
  switch (given.identify.runout) {
    case inputs::RunoutFit::none:
      options.runout = RunoutUnknowns::none;
      break;
    case inputs::RunoutFit::fixed:
      options.runout = RunoutUnknowns::fixed;
      break;
    case inputs::RunoutFit::offsets:
      options.runout = RunoutUnknowns::offsets;
      break;
    case inputs::RunoutFit::eccentricity:
      options.runout = RunoutUnknowns::eccentricity;
      break;
  }
  return options;
}

}  // namespace trochoid::run
