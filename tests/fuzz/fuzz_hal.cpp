#include <shim.h>

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <string_view>

#include "bytes.h"

namespace {

using trochoid::fuzz::Bytes;
using trochoid::fuzz::demand;

/// A file of this process.
struct File {
  std::filesystem::path path = std::filesystem::temp_directory_path() /
                               ("trochoid_hal_" + std::to_string(getpid()));
  ~File() {
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
};

/// Up to a byte 0, as a file.
void write_next(Bytes& bytes, const std::filesystem::path& file) {
  const std::string_view left(reinterpret_cast<const char*>(bytes.data), bytes.left);
  const auto text = left.substr(0, left.find('\0'));
  std::ofstream(file, std::ios::binary)
      .write(text.data(), static_cast<std::streamsize>(text.size()));
  const std::size_t taken = text.size() < left.size() ? text.size() + 1 : text.size();
  bytes.data += taken;
  bytes.left -= taken;
}

void read_files(TrochoidHal& hal, Bytes& bytes, std::uint8_t what) {
  static const File file;
  if ((what & 1U) != 0) {
    write_next(bytes, file.path);
    if (trochoid_hal_read_table(&hal, file.path.c_str()) == nullptr) {
      demand(hal.hal_points >= 2 && hal.hal_points <= TROCHOID_TABLE_POINTS);
      for (int i = 0; i < hal.hal_points; ++i)
        demand(std::isfinite(hal.hal_table_um[i]));
    }
  }
  if ((what & 2U) != 0) {
    write_next(bytes, file.path);
    const bool read = trochoid_hal_read_model(&hal, file.path.c_str()) == nullptr;
    demand(read ? hal.hal_model.teeth >= 2 && hal.hal_model.teeth <= 8
                : hal.hal_model.teeth == 0);
  }
}

/// Those of the component's pins, changed where the bytes say so.
TrochoidHalSettings settings_of(Bytes& bytes) {
  TrochoidHalSettings s{0,   60,  30,  20000, 0, 0, 1e-3, 0.01, 0.2, 1,  100,
                        0.1, 1.5, 0.1, 0,     0, 1, 50,   0.3,  1,   0.1};
  double* const numbers = &s.set_lower_um;
  constexpr unsigned count = sizeof s / sizeof(double);
  const auto which = bytes.next<std::uint32_t>();
  for (unsigned i = 0; i < count; ++i) {
    if ((which >> i & 1U) != 0) bytes.fill(numbers[i]);
  }
  return s;
}

}  // namespace

/// Whatever stands in its files, pins and memory: the command stays in the window.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes{data, size};
  const auto hal = std::make_unique<TrochoidHal>();
  const auto what = bytes.next<std::uint8_t>();
  read_files(*hal, bytes, what);
  const TrochoidHalSettings settings = settings_of(bytes);
  double turns = 0.3;
  for (int i = 0; i < 60 || bytes.left > 0; ++i) {
    const auto k = bytes.next<std::uint8_t>();
    const double before = turns;
    turns += trochoid::fuzz::turn_a_step;
    TrochoidHalIn in{};
    in.in_position = turns - std::floor(turns);
    in.in_speed = trochoid::fuzz::turn_a_step / trochoid::fuzz::step_s;
    in.in_gain = 1.0;
    in.in_force = 100.0 + 30.0 * std::floor(4.0 * in.in_position);
    in.in_dt = trochoid::fuzz::step_s;
    in.in_index = std::floor(turns) > std::floor(before) ? 1 : 0;
    in.in_enable = i > 0 && (k & 1U) == 0 ? 1 : 0;
    in.in_learn = (k & 2U) == 0 ? 1 : 0;
    if ((k & 4U) != 0) bytes.fill(in.in_force);
    if ((k & 8U) != 0) bytes.fill(in.in_gain);
    if ((k & 16U) != 0) {  // something else writes into its memory
      const std::size_t at = bytes.next<std::uint16_t>() % (sizeof *hal - 8);
      const auto value = bytes.next<std::uint64_t>();
      std::memcpy(reinterpret_cast<char*>(hal.get()) + at, &value, sizeof value);
    }
    TrochoidHalOut out;
    trochoid_hal_step(hal.get(), &settings, &in, &out);
    const TrochoidControllerConfig& c = hal->hal_controller.config;
    const double command = out.out_command_um * 1e-6;
    const double rounding = 1e-12;
    demand(out.out_state == TROCHOID_NOT_READY
               ? out.out_command_um == 0.0
               : command >= c.lower_m - rounding && command <= c.upper_m + rounding);
  }
  return 0;
}
