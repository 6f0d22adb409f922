#include <trochoid/run/channel_offsets.h>

#include <trochoid/signal/curved_drift.h>
#include <trochoid/signal/drift.h>

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace trochoid::run {

namespace {

/// Channels beyond the third, three at a time.
void take_drift_out_of(std::vector<std::vector<double>>& channels,
                       std::span<const double> angle, const DriftParts& parts) {
  for (std::size_t first = 0; first < channels.size(); first += 3) {
    std::array<std::vector<double>, 3> three;
    const std::size_t count = std::min<std::size_t>(3, channels.size() - first);
    for (std::size_t c = 0; c < 3; ++c) {
      three[c] = c < count ? std::move(channels[first + c])
                           : std::vector<double>(angle.size(), 0.0);
    }
    if (const auto drift = signal::idle_drift(three, angle, parts.air, parts.cut)) {
      signal::remove_drift(three, *drift);
    }
    signal::remove_drift(three,
                         signal::curved_drift(three, angle, parts.air, parts.cut));
    for (std::size_t c = 0; c < count; ++c) channels[first + c] = std::move(three[c]);
  }
}

void warn_of_curve(const signal::Record& record, const signal::CurvedDrift& curve,
                   std::vector<base::Warning>& warnings) {
  const auto most = std::ranges::max_element(curve.bend);
  if (!(*most > 0)) return;
  warnings.push_back(
      {"curved_drift",
       fmt::format(
           "{}: channel {} drifts along a curve, up to {:.3g} N from a straight "
           "line. The curve was removed, as the mean force of a steady cut does "
           "not change.",
           record.file, most - curve.bend.begin() + 1, *most)});
}

}  // namespace

TakenOut take_drift_out(const cases::Case& given, std::span<const double> angle,
                        const DriftParts& parts, signal::Record& record,
                        std::vector<base::Warning>& warnings) {
  using cases::ChannelOffset;
  const ChannelOffset how = given.identify.channel_offsets;
  if (how != ChannelOffset::idle && how != ChannelOffset::automatic) {
    return {};
  }
  const auto drift = signal::idle_drift(record.channel, angle, parts.air, parts.cut);
  if (drift) {
    signal::remove_drift(record.channel, *drift);
  } else if (how == ChannelOffset::idle) {
    warnings.push_back({"no_idle_part",
                        record.file +
                            ": nothing in the record is free of cutting, so the offset "
                            "of the channels cannot be read off it; it is left in. "
                            "channel_offsets = \"fit\" estimates it with the rest."});
  }
  const signal::CurvedDrift curve =
      signal::curved_drift(record.channel, angle, parts.air, parts.cut);
  signal::remove_drift(record.channel, curve);
  take_drift_out_of(record.further, angle, parts);
  warn_of_curve(record, curve, warnings);
  TakenOut out{.offset = drift.has_value()};
  for (std::size_t c = 0; c < 3 && drift; ++c) {
    out.offset_se[c] =
        curve.terms[c].empty() ? drift->se_in_cut[c] : curve.offset_se[c];
  }
  return out;
}

}  // namespace trochoid::run
