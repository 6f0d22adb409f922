#include <trochoid/base/error.h>
#include <trochoid/cases/case.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>

#include "bytes.h"
#include "folder.h"

namespace {

using trochoid::cases::Command;
using trochoid::fuzz::demand;
using trochoid::fuzz::Folder;
using trochoid::fuzz::write;

/// The commands in their order, and none: that which the tables show.
std::optional<Command> command_of(std::uint8_t byte) {
  constexpr int commands = static_cast<int>(Command::program) + 1;
  const int which = byte % (commands + 1);
  return which == commands ? std::nullopt : std::optional(static_cast<Command>(which));
}

}  // namespace

/// The first byte says the command. A case as it was understood is understood again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder("trochoid_fuzz");
  if (size == 0) return 0;
  const auto command = command_of(data[0]);
  const auto file = folder.path / "case.toml";
  write(file, {reinterpret_cast<const char*>(data) + 1, size - 1});
  std::string understood;
  try {
    understood = trochoid::cases::read_case(file, command, folder.path).as_understood;
  } catch (const trochoid::base::InputError& error) {
    demand(!error.problems().empty());
    return 0;
  }
  demand(!understood.empty());
  write(file, understood);
  demand(trochoid::cases::read_case(file, command, folder.path).as_understood ==
         understood);
  return 0;
}
