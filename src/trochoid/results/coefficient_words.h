#pragma once

#include <fmt/core.h>

#include <string>
#include <string_view>

namespace trochoid::results {

/// @brief `K_tc = 812 +- 40 MPa` of `K_tc_MPa` and `812 +- 40`.
inline std::string coefficient_words(std::string_view key, std::string_view value) {
  const std::size_t at = key.find('_', key.find('_') + 1);
  const std::string_view unit = key.substr(at + 1);
  const std::size_t per = unit.find("_per_");
  const std::string shown =
      per == std::string_view::npos
          ? std::string(unit)
          : fmt::format("{}/{}", unit.substr(0, per), unit.substr(per + 5));
  return fmt::format("{} = {} {}", key.substr(0, at), value, shown);
}

}  // namespace trochoid::results
