#pragma once

#include <trochoid/base/table.h>

#include <string>

namespace trochoid::results {

/// Whether this program was built with the HDF5 library.
bool has_hdf5() noexcept;

/// @brief A table as an HDF5 file: of each column a dataset with its name, of doubles, or
/// of UTF-8 texts padded with zeros to the longest. No time is kept: the same table gives
/// the same bytes.
/// @param table  columns equally long, their names without `/`
/// @throws std::runtime_error where the library fails, or is not here
std::string hdf5_table(const base::Table& table);

}  // namespace trochoid::results
