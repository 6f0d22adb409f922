#pragma once

#include <trochoid/files/csv_table.h>
#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>

/// Force records that are a table of numbers in text.
namespace trochoid::files {

inline constexpr TableKind record_kind{.noun = "a record",
                                       .files = "a CSV file or a DynoWare text export",
                                       .row = "sample",
                                       .example = "angle_deg,Fx_N,Fy_N,Fz_N"};

/// @brief Read a CSV file; as read_record.
signal::Record read_csv_record(std::istream& in, const std::string& name,
                               const RecordSource& source);

/// @brief Read an export of DynoWare, whose head comes before the table; as read_record.
signal::Record read_dynoware_record(std::istream& in, const std::string& name,
                                    const RecordSource& source);

}  // namespace trochoid::files
