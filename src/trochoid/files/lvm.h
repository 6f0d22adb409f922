#pragma once

#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>
#include <string_view>

/// LabVIEW's measurement files (.lvm): a head, heads of segments, tables in text.
namespace trochoid::files {

/// @param head  the first bytes of a file
bool is_lvm(std::string_view head);

/// @brief Read the first segment; as read_record.
signal::Record read_lvm_record(std::istream& in, const std::string& name,
                               const RecordSource& source);

}  // namespace trochoid::files
