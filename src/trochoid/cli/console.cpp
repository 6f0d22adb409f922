#include <trochoid/cli/console.h>

#if defined(_WIN32)
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cstdio>
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

}  // namespace trochoid::cli
