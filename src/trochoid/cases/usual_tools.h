#pragma once

#include <trochoid/cases/tables.h>

#include <span>
#include <string_view>

namespace trochoid::cases {

/// @brief A kind of cutter to start from, with a cut that suits it.
///
/// Its numbers are usual ones of the trade, of no maker: each is to be replaced.
struct UsualTool {
  std::string_view name;     ///< as `trochoid new --tool` takes it
  std::string_view meaning;  ///< in words
  void (*put)(CaseTables&);  ///< tool, cut and runout
};

/// Face mills, round inserts and others that no drawing of an end mill shows.
std::span<const UsualTool> usual_tools();

}  // namespace trochoid::cases
