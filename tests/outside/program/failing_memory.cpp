// Loaded before the C library: the FAULT_AT-th time that the program asks for memory it
// gets none. Counted from mallopt, the first that main calls.

#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>
#include <cstdlib>

extern "C" void* __libc_malloc(std::size_t size);

namespace {

std::atomic<long> calls{0};
std::atomic<long> fails_at{0};

}  // namespace

extern "C" {

int mallopt(int, int) noexcept {
  if (fails_at == 0) {
    const char* at = std::getenv("FAULT_AT");
    fails_at = at != nullptr ? std::atol(at) : -1;
  }
  return 1;
}

void* malloc(std::size_t size) noexcept {
  if (fails_at > 0 && ++calls == fails_at) {
    static const char said[] = "fault injected\n";
    const ssize_t written = write(STDERR_FILENO, said, sizeof said - 1);
    static_cast<void>(written);
    errno = ENOMEM;
    return nullptr;
  }
  return __libc_malloc(size);
}

}  // extern "C"
