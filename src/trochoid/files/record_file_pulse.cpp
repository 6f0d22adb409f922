#include <trochoid/files/record_file_pulse.h>

#include <trochoid/base/units.h>
#include <trochoid/signal/pulse.h>

#include <fmt/core.h>

namespace trochoid::files {

void take_pulses(signal::Record& record, const std::string& column,
                 std::span<const double> values, Problems& problems) {
  if (record.time.size() != values.size()) {
    problems.add(0, 0,
                 "pulses need times or a sampling rate: name time_column, or give "
                 "sample_rate_Hz in the case file");
    return;
  }
  auto found = signal::angle_of_pulses(values, record.time);
  if (!found.why.empty()) {
    problems.add(
        0, 0, fmt::format("the pulses of column {}: {}", excerpt(column), found.why));
    return;
  }
  record.angle = std::move(found.angle);
  record.angle_column = column;
  record.notes.push_back(
      {"pulses",
       fmt::format(
           "{} pulses were found in column {}{}; the spindle turns at {:.2f} to "
           "{:.2f} rpm by them.",
           found.found, excerpt(column),
           found.filled == 0
               ? ""
               : fmt::format(", {} that were missing were filled in", found.filled),
           found.slowest / unit::rpm, found.fastest / unit::rpm)});
}

}  // namespace trochoid::files
