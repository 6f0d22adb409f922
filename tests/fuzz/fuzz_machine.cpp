#include <trochoid/base/error.h>
#include <trochoid/files/command_file.h>
#include <trochoid/files/step_file.h>
#include <trochoid/files/transmission_file.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <sstream>
#include <string>

#include "bytes.h"

namespace {

using trochoid::fuzz::demand;

/// Finite, and each larger than the one before.
bool increasing(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || (i > 0 && !(values[i] > values[i - 1]))) {
      return false;
    }
  }
  return !values.empty();
}

bool finite(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(),
                     [](double x) { return std::isfinite(x); });
}

void read_command(const std::string& text) {
  std::istringstream in(text);
  const auto table = trochoid::files::read_command(in, "command");
  demand(increasing(table.angle) && finite(table.command));
  demand(table.command.size() == table.angle.size());
  demand(table.angle.back() - table.angle.front() < 6.2832);
  demand(std::isfinite(trochoid::dynamics::command_at(table, 1.0)));
}

void read_step(const std::string& text, bool height, bool start) {
  trochoid::files::StepSource source;
  if (height) source.step = 1e-5;
  if (start) source.start = 0.01;
  std::istringstream in(text);
  const auto file = trochoid::files::read_step(in, "step", source);
  const auto& record = file.record;
  demand(increasing(record.time) && finite(record.position));
  demand(record.position.size() == record.time.size());
  demand(file.command.empty() || file.command.size() == record.time.size());
  demand(finite(file.command));
  demand(std::isfinite(record.step) && record.step != 0.0);
}

void read_transmission(const std::string& text) {
  const auto file = trochoid::files::transmission_of(text, "frf");
  const auto& omega = file.transmission.omega;
  demand(increasing(omega) && omega.front() >= 0.0);
  demand(file.transmission.H.size() == omega.size());
  const auto between = trochoid::signal::at(file.transmission, omega.back() / 2.0);
  for (const auto& h : between) {
    demand(std::isfinite(h.real()) && std::isfinite(h.imag()));
  }
}

}  // namespace

/// The first byte says which file of a machine this is, and what its case says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string text(reinterpret_cast<const char*>(data) + 1, size - 1);
  try {
    if (data[0] % 4 == 0) {
      read_command(text);
    } else if (data[0] % 4 == 1) {
      read_transmission(text);
    } else {
      read_step(text, (data[0] & 4U) != 0, (data[0] & 8U) != 0);
    }
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
  }
  return 0;
}
