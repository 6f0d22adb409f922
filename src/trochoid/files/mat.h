#pragma once

#include <trochoid/files/numeric_table.h>
#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>
#include <string_view>

/// MATLAB's files, versions 5 to 7.3. From 7.3 on they are HDF5.
namespace trochoid::files {

/// @param head  the first bytes of a file
bool is_mat(std::string_view head);

/// @brief Read a record; as read_record.
///
/// Columns are vectors, columns of matrices (`F(:,1)`) and fields of structs (`data.Fx`).
/// A matrix of 3 or 4 columns alone in the file is taken for Fx, Fy, Fz, with the time
/// before them.
signal::Record read_mat_record(std::istream& in, const std::string& name,
                               const RecordSource& source);

/// @brief Every array of numbers of a file of version 5, packed or not.
/// @param in  must outlive the table
/// @throws base::InputError where it is cut off or damaged
NumericTable mat5_table(std::istream& in, const std::string& name);

/// @brief Say of a file that what it holds only MATLAB can read, and how to save it.
/// @throws base::InputError
[[noreturn]] void refuse_matlab_object(const std::string& name);

}  // namespace trochoid::files
