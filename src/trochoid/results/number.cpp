#include <trochoid/results/number.h>

#include <array>
#include <charconv>
#include <cmath>

namespace trochoid::results {

bool append_number(std::string& text, double value) {
  if (!std::isfinite(value)) return false;
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  text.append(digits.data(), end);
  return true;
}

}  // namespace trochoid::results
