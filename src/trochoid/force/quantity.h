#pragma once

#include <string_view>

namespace trochoid::force {

/// What a number of a law does in it.
enum class Role { cutting, edge, exponent };

/// A number of a law, as files name it.
struct Quantity {
  std::string_view key;  ///< for example `K_tc_MPa`
  std::string_view meaning;
  double unit = 1.0;  ///< of the key [SI]
  Role role = Role::cutting;
  bool signed_value = true;  ///< false: not below 0
};

/// A number of a law and where it stands.
template <class Law>
struct Number {
  Quantity quantity;
  double Law::*value;
};

}  // namespace trochoid::force
