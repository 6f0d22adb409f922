#include <trochoid/base/units.h>

#include <array>
#include <charconv>

namespace trochoid::unit {

double in(double value, double unit) noexcept {
  const double plain = value / unit;
  std::array<char, 32> text{};
  const auto printed = std::to_chars(text.data(), text.data() + text.size(), plain,
                                     std::chars_format::general, 15);
  double shorter = plain;
  std::from_chars(text.data(), printed.ptr, shorter);
  return shorter * unit == value ? shorter : plain;
}

}  // namespace trochoid::unit
