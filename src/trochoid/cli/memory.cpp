#include <trochoid/cli/commands.h>
#include <trochoid/cli/memory.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

namespace trochoid::cli {

namespace {

std::atomic<std::size_t>& refused() noexcept {
  static std::atomic<std::size_t> bytes{0};
  return bytes;
}

const char*& command_running() noexcept {
  static const char* command = "";
  return command;
}

/// Libraries promise `noexcept` and ask for memory all the same.
[[noreturn]] void end() noexcept {
  if (refused() == 0) {
    std::abort();
  }
  say_no_memory(command_running());
  std::_Exit(our_bug);
}

}  // namespace

void say_no_memory(const char* command) noexcept {
  constexpr double mebibyte = 1024.0 * 1024.0;
  std::fprintf(stderr,
               "trochoid %s: there is no memory for it: %.3g MiB more were asked for; "
               "nothing was written\n",
               command, static_cast<double>(refused_bytes()) / mebibyte);
}

void say_no_memory_at_the_end_of(const char* command) noexcept {
  command_running() = command;
  std::set_terminate(end);
}

std::size_t refused_bytes() noexcept {
  return refused();
}

}  // namespace trochoid::cli

void* operator new(std::size_t size) {
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) {
    trochoid::cli::refused() = size;
    throw std::bad_alloc{};
  }
  return memory;
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}
