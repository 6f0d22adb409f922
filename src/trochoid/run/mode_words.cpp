#include <trochoid/run/mode_words.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::run {

namespace {

constexpr std::size_t most_named = 4;

}  // namespace

std::string mode_words(std::span<const structure::FittedMode> modes) {
  std::string text =
      fmt::format("{} mode{}", modes.size(), modes.size() == 1 ? "" : "s");
  const std::size_t named = std::min(modes.size(), most_named);
  for (std::size_t i = 0; i < named; ++i) {
    const bool last = i + 1 == modes.size();
    text += i == 0 ? ": " : last ? " and " : ", ";
    text += fmt::format("{:.4g} Hz ({}{:.2g} %)", modes[i].omega.value / unit::Hz,
                        i == 0 ? "damping ratio " : "", 100 * modes[i].zeta.value);
  }
  return text + (named < modes.size() ? " and more" : "");
}

std::string unexplained_power(double explained) {
  const double left = 100 * std::max(0.0, 1 - explained);
  return left < 0.01
             ? "Less than 0.01 % of the power of the response stays unexplained"
             : fmt::format("{:.2g} % of the power of the response stays unexplained",
                           left);
}

}  // namespace trochoid::run
