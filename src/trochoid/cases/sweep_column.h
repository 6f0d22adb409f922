#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::cases {

/// @brief The numbers of one column of a CSV file, as they stand in it.
/// @param location  `file:line:col` of its name in the case
/// @throws base::InputError with every problem
std::vector<double> column_of_file(const std::filesystem::path& file,
                                   std::string_view column,
                                   const std::string& location);

}  // namespace trochoid::cases
