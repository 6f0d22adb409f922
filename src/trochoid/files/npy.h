#pragma once

#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>
#include <string_view>

/// One array of NumPy, as `numpy.save` writes it.
namespace trochoid::files {

/// @param head  the first bytes of a file
bool is_npy(std::string_view head);

/// @brief Read a record; as read_record.
///
/// Columns are the fields of a structured array of one dimension, or those of a matrix: 3
/// are Fx, Fy, Fz and 4 a time and these, with a note.
signal::Record read_npy_record(std::istream& in, const std::string& name,
                               const RecordSource& source);

}  // namespace trochoid::files
