#include <trochoid/cli/system.h>

#include <trochoid/cli/commands.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <windows.h>
#else
#include <unistd.h>
#endif

namespace trochoid::cli {

#if defined(_WIN32)

namespace {

/// A console outlives the program, and has its letters back then.
struct Utf8Output {
  UINT before = ::GetConsoleOutputCP();
  Utf8Output() { ::SetConsoleOutputCP(CP_UTF8); }
  ~Utf8Output() { ::SetConsoleOutputCP(before); }
  Utf8Output(const Utf8Output&) = delete;
  Utf8Output& operator=(const Utf8Output&) = delete;
};

}  // namespace

void prepare_console() {
  static const Utf8Output till_the_end;
  ::_setmode(::_fileno(stdin), _O_BINARY);
  ::_setmode(::_fileno(stdout), _O_BINARY);
  ::_setmode(::_fileno(stderr), _O_BINARY);
}

bool clears_lines() {
  const HANDLE console = ::GetStdHandle(STD_ERROR_HANDLE);
  DWORD mode = 0;
  return ::GetConsoleMode(console, &mode) != 0 &&
         ::SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

#else

void prepare_console() {}

bool clears_lines() {
  return ::isatty(STDERR_FILENO) == 1;
}

#endif

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

// All forms are here, not some: memory of a form that a library or a sanitizer replaced
// by itself must not come back to a form that is replaced here.

void* operator new(std::size_t size) {
  void* memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) {
    trochoid::cli::refused() = size;
    throw std::bad_alloc{};
  }
  return memory;
}

/// Who asks like this goes on without: nothing was refused that ends the program.
void* operator new(std::size_t size, const std::nothrow_t& /*tag*/) noexcept {
  return std::malloc(size > 0 ? size : 1);
}

void* operator new[](std::size_t size) {
  return operator new(size);
}

void* operator new[](std::size_t size, const std::nothrow_t& tag) noexcept {
  return operator new(size, tag);
}

void operator delete(void* memory) noexcept {
  std::free(memory);
}

void operator delete(void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

void operator delete(void* memory, const std::nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}

void operator delete[](void* memory) noexcept {
  std::free(memory);
}

void operator delete[](void* memory, std::size_t /*size*/) noexcept {
  std::free(memory);
}

void operator delete[](void* memory, const std::nothrow_t& /*tag*/) noexcept {
  std::free(memory);
}
