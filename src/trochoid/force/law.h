#pragma once

#include <trochoid/force/linear_edge.h>
#include <trochoid/force/power.h>
#include <trochoid/force/power_edge.h>

#include <array>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace trochoid::force {

/// @brief A force law. Each has a file of its own with what is known of it.
///
/// A law that lacks a name, a form or its numbers does not compile; nor does one that is
/// unknown where a law is looked at closer, which is done by std::visit without a default.
using Law = std::variant<LinearEdge, Power, PowerEdge>;

/// One of each kind, in the order in which files and help name them.
inline constexpr auto law_kinds = []<std::size_t... i>(std::index_sequence<i...>) {
  return std::array<Law, sizeof...(i)>{std::variant_alternative_t<i, Law>{}...};
}
(std::make_index_sequence<std::variant_size_v<Law>>{});

constexpr std::string_view name_of(const Law& law) {
  return std::visit([](const auto& l) { return name_of(l); }, law);
}
/// Of each of law_kinds.
inline constexpr auto law_names = [] {
  std::array<std::string_view, law_kinds.size()> names{};
  for (std::size_t i = 0; i < names.size(); ++i) {
    names[i] = name_of(law_kinds[i]);
  }
  return names;
}();

Form form(const Law& law);
Terms terms(const Law& law);

/// What the numbers of a law are, in the order of files.
std::vector<Quantity> quantities(const Law& law);
/// The same without its exponents: the columns of [C].
std::vector<Quantity> coefficient_quantities(const Law& law);
/// Its exponents, of t, r, a; or none.
std::vector<Quantity> exponent_quantities(const Law& law);

/// @brief How a law's coefficients enter the force linearly: F = C K.
///
/// K_t, K_r, K_a of cutting, then those of the edge where the law has any.
std::vector<double> coefficients(const Law& law);
/// The same law with other coefficients; exponents stay.
/// @throws std::invalid_argument unless there is one for each
Law with_coefficients(const Law& law, std::span<const double> K);

/// The same law with other exponents of t, r, a; one without exponents stays as it is.
Law with_exponents(const Law& law, std::span<const double, 3> m);

/// The same law with another value of the number of that key.
/// @throws std::invalid_argument where the law has no such number
Law with_number(const Law& law, std::string_view key, double value);

/// Length on which edge coefficients act.
enum class EdgeLength {
  true_length,  ///< dS, the length of the edge in space
  axial,        ///< dz
};

/// The names that files use.
constexpr std::string_view name_of(EdgeLength length) noexcept {
  switch (length) {
    case EdgeLength::true_length:
      return "true";
    case EdgeLength::axial:
      return "axial";
  }
  return {};
}

}  // namespace trochoid::force
