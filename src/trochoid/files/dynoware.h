#pragma once

#include <trochoid/files/csv.h>

#include <optional>
#include <string>
#include <string_view>

/// The text export of Kistler's DynoWare: lines `Key:,value`, names, units, rows.
namespace trochoid::files {

struct DynoWareHeader {
  char separator = ',';
  double sample_rate = 0.0;  ///< [Hz]; 0: not stated
  std::size_t rate_line = 0;
  std::optional<double>
      samples;  ///< of the whole record; an export may be a part of it
  std::size_t samples_line = 0;
  double delay = 0.0;  ///< time of the first sample of the whole record [s]
  std::string names;   ///< the first line that is no `Key:,value`; empty: none
};

/// @param head  the first bytes of a file
bool is_dynoware(std::string_view head);

/// @brief Read the header up to and with the row of names.
/// @param first_line  already taken from `lines`
DynoWareHeader read_dynoware_header(std::string_view first_line, LineReader& lines,
                                    Problems& problems);

/// What is known of an export once its rows have been read.
struct DynoWareExport {
  std::size_t rows = 0;
  std::optional<double> first_time;  ///< [s]; absent: no column of times
};

/// @brief Compare the number of rows with the header.
///
/// DynoWare states the samples of the whole record even when a part of it is exported.
/// Fewer rows are therefore in order; where they are the first ones, the file may also
/// have been cut off. More rows never are.
/// @return what to note about a part of a record; empty: nothing
std::string check_sample_count(const DynoWareHeader& header,
                               const DynoWareExport& found, Problems& problems);

}  // namespace trochoid::files
