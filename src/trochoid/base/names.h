#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

/// The names that files give the enumerators of an enumeration.
///
/// They stand once, beside the enumeration, in an exhaustive switch
/// `constexpr std::string_view name_of(Enum)` that yields an empty text after its end: an
/// enumerator without a name does not compile. Enumerators count from 0.
namespace trochoid::base {

template <class Enum>
constexpr std::size_t count_of() noexcept {
  std::size_t count = 0;
  while (!name_of(static_cast<Enum>(count)).empty()) {
    ++count;
  }
  return count;
}

/// All names, in the order of the enumerators.
template <class Enum>
inline constexpr auto names = [] {
  std::array<std::string_view, count_of<Enum>()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = name_of(static_cast<Enum>(i));
  }
  return all;
}();

/// @return the enumerator of that name, if there is one
template <class Enum>
constexpr std::optional<Enum> named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < names<Enum>.size(); ++i) {
    if (names<Enum>[i] == name) {
      return static_cast<Enum>(i);
    }
  }
  return std::nullopt;
}

}  // namespace trochoid::base
