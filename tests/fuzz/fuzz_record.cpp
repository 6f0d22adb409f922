#include <trochoid/base/error.h>
#include <trochoid/files/record_file.h>
#include <trochoid/signal/drift.h>
#include <trochoid/signal/revolutions.h>
#include <trochoid/signal/spindle_speed.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "bytes.h"

namespace {

using trochoid::files::RecordSource;
using trochoid::fuzz::demand;

/// The first byte chooses what the case file says about the record.
RecordSource said_by(std::uint8_t byte) {
  RecordSource m;
  if ((byte & 1) != 0) m.sample_rate = 1e4;
  if ((byte & 2) != 0) m.columns = {"a", "Fx", "b"};
  if ((byte & 4) != 0) m.angle_column = "angle_deg";
  if ((byte & 8) != 0) m.time_column = "time";
  if ((byte & 16) != 0) m.pulse_column = "Fz";
  if ((byte & 32) != 0) m.scale = {500, -1, 1e3};
  return m;
}

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double x) { return std::isfinite(x); });
}

/// What every record that is accepted must be, and must bear.
void use(const trochoid::signal::Record& record) {
  demand(record.size() >= 2);
  for (const auto& channel : record.channel) {
    demand(channel.size() == record.size() && finite(channel));
  }
  demand(record.angle.empty() || record.angle.size() == record.size());
  demand(record.time.empty() || record.time.size() == record.size());
  demand(!record.angle.empty() || !record.time.empty());
  demand(finite(record.angle) && finite(record.time));
  demand(std::isfinite(record.sample_rate) && record.sample_rate >= 0.0);
  if (!record.time.empty()) {
    trochoid::signal::spindle_speed(record, {.Omega = 600.0, .teeth = 2});
  }
  const auto angle = record.angle.empty()
                         ? trochoid::signal::angle_from_time(record.time, 600.0)
                         : trochoid::signal::unwrapped(record.angle);
  trochoid::signal::fold(record.channel, angle, 36);
  const auto passes = trochoid::signal::passes_of(record.channel, angle);
  trochoid::signal::idle_drift(record.channel, angle, passes.air,
                               trochoid::signal::longest_steady(passes));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::istringstream in(std::string(reinterpret_cast<const char*>(data) + 1, size - 1));
  try {
    use(trochoid::files::read_record(in, "record", said_by(data[0])));
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
