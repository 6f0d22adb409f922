#include <trochoid/base/error.h>
#include <trochoid/inputs/case.h>

#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

namespace {

using trochoid::inputs::Command;

/// A folder of this process, so that relative names in a case lead nowhere.
std::filesystem::path folder() {
  return std::filesystem::temp_directory_path() /
         ("trochoid_fuzz_" + std::to_string(getpid()));
}

void read(const std::filesystem::path& file, std::optional<Command> command) {
  try {
    const auto read = trochoid::inputs::read_case(file, command);
    if (read.as_understood.empty()) std::abort();
  } catch (const trochoid::base::InputError& error) {
    if (error.problems().empty()) std::abort();
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = folder() / "case.toml";
  std::filesystem::create_directories(folder());
  {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  }
  read(file, std::nullopt);
  for (const auto command : {Command::simulate, Command::identify, Command::surface,
                             Command::calibrate, Command::stability}) {
    read(file, command);
  }
  std::filesystem::remove_all(folder());
  return 0;
}
