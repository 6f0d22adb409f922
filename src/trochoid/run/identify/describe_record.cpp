#include <trochoid/run/identify/describe_record.h>

#include <trochoid/base/units.h>
#include <trochoid/run/shared/used_part.h>
#include <trochoid/signal/revolutions.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::run {

namespace {

std::string duration_text(const signal::Record& record) {
  if (record.time.size() < 2) {
    return "no time";
  }
  std::string text = fmt::format("{:.4g} s", record.time.back() - record.time.front());
  return record.sample_rate > 0
             ? text + fmt::format(" at {:.6g} Hz", record.sample_rate)
             : text + ", unevenly sampled";
}

std::string revolutions_text(const signal::Record& record, const geometry::Cut& cut) {
  if (!record.angle.empty()) {
    const auto angle = signal::unwrapped(record.angle);
    return fmt::format("{:.2f} revolutions by their angles",
                       std::abs(angle.back() - angle.front()) / unit::turn);
  }
  const double duration = record.time.back() - record.time.front();
  return fmt::format("about {:.1f} revolutions at the stated {:g} rpm",
                     duration * cut.Omega / unit::turn, unit::in(cut.Omega, unit::rpm));
}

/// Which column tells where the spindle stands.
std::string axis_text(const signal::Record& record) {
  if (!record.angle.empty()) {
    return fmt::format("  angle from column {}\n", record.angle_column);
  }
  return record.time_column.empty()
             ? std::string("  time from the sampling rate\n")
             : fmt::format("  time from column {}\n", record.time_column);
}

}  // namespace

std::string describe_record(const signal::Record& record,
                            const inputs::Measurement& measurement) {
  std::string text =
      fmt::format("{}: {} samples, {}, {}\n", record.file, record.size(),
                  duration_text(record), revolutions_text(record, measurement.cut));
  text += axis_text(record);
  const UsedPart used =
      used_part(record, stated_angle(record, measurement.cut), measurement);
  if (!used.why.empty()) {
    text += "  " + used.why + "\n";
  }
  for (std::size_t c = 0; c < 3; ++c) {
    if (!record.measured[c]) {
      text += fmt::format("  channel {} was not measured\n", c + 1);
      continue;
    }
    const auto& values = record.channel[c];
    const auto [lo, hi] = std::minmax_element(values.begin(), values.end());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) /
                        static_cast<double>(values.size());
    text +=
        fmt::format("  channel {} from column {}: {:.1f} to {:.1f} N, mean {:.1f} N\n",
                    c + 1, record.channel_column[c], *lo, *hi, mean);
  }
  return text;
}

}  // namespace trochoid::run
