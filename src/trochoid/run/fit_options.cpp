#include <trochoid/run/fit_options.h>

namespace trochoid::run {

identification::Options fit_options(const inputs::Case& given, chip::Model model) {
  return {.chip_model = model,
          .runout = given.identify.runout,
          .phase = given.identify.phase,
          .band_harmonics = given.identify.band_harmonics,
          .fit_channel_offsets =
              given.identify.channel_offsets == inputs::ChannelOffset::fit};
}

}  // namespace trochoid::run
