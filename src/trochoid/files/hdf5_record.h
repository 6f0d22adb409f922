#pragma once

#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>
#include <string_view>

/// HDF5 files, by the HDF5 library.
namespace trochoid::files {

/// @param head  the first bytes of a file
bool is_hdf5(std::string_view head);

/// Whether a file follows MATLAB's customs: arrays by columns, classes as attributes.
enum class Hdf5Kind { plain, matlab };

/// @brief Read a record; as read_record.
///
/// Columns are data sets of one dimension at any depth (`run1/Fx`), columns of matrices
/// (`F(:,1)`) and members of compounds (`table.Fx`). The attributes unit, sample_rate_Hz and
/// dt [s] of a data set, or of a group around it, are heeded. Where the library was built
/// without HDF5, the file is refused.
signal::Record read_hdf5_columns(std::istream& in, const std::string& name,
                                 const RecordSource& source, Hdf5Kind kind);

/// @brief The same of a plain file.
signal::Record read_hdf5_record(std::istream& in, const std::string& name,
                                const RecordSource& source);

}  // namespace trochoid::files
