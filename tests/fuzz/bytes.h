#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>

/// What the fuzzers share.
namespace trochoid::fuzz {

/// A promise: where it is broken the fuzzer stops, and keeps the input.
inline void demand(bool condition) {
  if (!condition) std::abort();
}

/// Takes the next bytes as they are; zeros when there are no more.
struct Bytes {
  const std::uint8_t* data;
  std::size_t left;

  template <class T>
  void fill(T& value) {
    const std::size_t n = left < sizeof value ? left : sizeof value;
    std::memset(&value, 0, sizeof value);
    if (n > 0) std::memcpy(&value, data, n);
    data += n;
    left -= n;
  }

  template <class T>
  T next() {
    T value{};
    fill(value);
    return value;
  }
};

/// A spindle that turns well: 90 revolutions a second, an index pulse each turn.
inline constexpr double turn_a_step = 0.09;
inline constexpr double step_s = 1e-3;

}  // namespace trochoid::fuzz
