#pragma once

#include <trochoid/files/numeric_table.h>
#include <trochoid/files/record_source.h>

#include <istream>
#include <string>
#include <string_view>

/// National Instruments' TDMS, as LabVIEW and its kin write it, DAQmx data included.
namespace trochoid::files {

/// @param head  the first bytes of a file
bool is_tdms(std::string_view head);

/// @brief Every channel of numbers. Channels of text are passed over.
/// @param in  must outlive the table
/// @throws base::InputError where the file is damaged or of a kind that is not read
NumericTable tdms_table(std::istream& in, const std::string& name);

/// @brief Read a record; as read_record.
signal::Record read_tdms_record(std::istream& in, const std::string& name,
                                const RecordSource& source);

}  // namespace trochoid::files
