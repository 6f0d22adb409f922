#pragma once

#include <trochoid/files/number_run.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::files {

/// A number of each item, or something else that is passed over.
struct NpyField {
  std::string name;                ///< empty: the items are plain numbers
  std::optional<NumberKind> kind;  ///< absent: text
  std::endian order = std::endian::little;
  std::uint64_t offset = 0;  ///< from the begin of the item
};

struct NpyHead {
  std::vector<NpyField> fields;
  std::uint64_t item_bytes = 0;
  bool fortran_order = false;
  std::vector<std::uint64_t> shape;
};

/// @brief Read the description that an array begins with, a literal of Python.
/// @throws base::InputError where it is no such one, or of numbers that are not read
NpyHead npy_head(std::string_view text, const std::string& name);

}  // namespace trochoid::files
