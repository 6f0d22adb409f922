#include <trochoid/cli/memory.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace trochoid::cli {

namespace {

std::atomic<std::size_t>& refused() noexcept {
  static std::atomic<std::size_t> bytes{0};
  return bytes;
}

}  // namespace

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
