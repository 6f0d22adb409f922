#include <trochoid/inputs/record_file.h>

#include <trochoid/base/error.h>
#include <trochoid/inputs/csv_table.h>
#include <trochoid/inputs/dynoware.h>
#include <trochoid/inputs/hdf5_record.h>
#include <trochoid/inputs/lvm.h>
#include <trochoid/inputs/mat.h>
#include <trochoid/inputs/npy.h>
#include <trochoid/inputs/numeric_table.h>
#include <trochoid/inputs/record_format.h>
#include <trochoid/inputs/record_table.h>
#include <trochoid/inputs/tdms.h>
#include <trochoid/inputs/uff58.h>
#include <trochoid/inputs/uff58_record.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace trochoid::inputs {

namespace {

/// A format that a record may have.
struct Reader {
  RecordFormat format;
  std::string_view title;                ///< `a DynoWare export`
  std::string_view sign;                 ///< what tells it from others, for a message
  bool (*recognises)(std::string_view);  ///< the first bytes of a file
  decltype(&read_csv_record) read;
};

/// All of them: the first that recognises a file reads it, and the last takes any text.
constexpr std::array readers{
    Reader{RecordFormat::dynoware, "a DynoWare export",
           "begins with `DynoWare,Version ...`", is_dynoware, read_dynoware_record},
    Reader{RecordFormat::lvm, "a LabVIEW measurement file",
           "begins with `LabVIEW Measurement`", is_lvm, read_lvm_record},
    Reader{RecordFormat::mat, "a MATLAB file", "begins with `MATLAB ... MAT-file`",
           is_mat, read_mat_record},
    Reader{RecordFormat::tdms, "a TDMS file", "begins with `TDSm`", is_tdms,
           read_tdms_record},
    Reader{RecordFormat::hdf5, "an HDF5 file", "begins with the byte 0x89 and `HDF`",
           is_hdf5, read_hdf5_record},
    Reader{RecordFormat::npy, "a NumPy array", "begins with the byte 0x93 and `NUMPY`",
           is_npy, read_npy_record},
    Reader{RecordFormat::uff58, "a universal file",
           "begins with a line that holds only -1", is_uff, read_uff58_record},
    Reader{RecordFormat::csv, "a CSV file", "is text",
           [](std::string_view) { return true; }, read_csv_record}};

/// Enough to recognise a format by.
constexpr std::size_t longest_head = 4096;

/// @return the first bytes of a file, which then stands at its beginning again
std::string first_bytes(std::istream& in) {
  std::string head(longest_head, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  if (!in.seekg(0)) {
    throw std::invalid_argument("read_record: the stream cannot be set back");
  }
  return head;
}

const Reader& reader_of(RecordFormat format) {
  return *std::find_if(readers.begin(), readers.end(),
                       [&](const Reader& reader) { return reader.format == format; });
}

/// @throws base::InputError where the case file says another format
void check_stated(const Reader& found, const std::optional<RecordFormat>& stated,
                  const std::string& name) {
  if (!stated || *stated == found.format) {
    return;
  }
  const bool by_content = &found != &readers.back();
  throw base::InputError(
      {name + ":1:1: " +
       (by_content ? fmt::format("this is {}, but the case file says format = \"{}\": "
                                 "\"{}\" is right",
                                 found.title, name_of(*stated), name_of(found.format))
                   : fmt::format("the case file says format = \"{}\", but {} {}",
                                 name_of(*stated), reader_of(*stated).title,
                                 reader_of(*stated).sign))});
}

}  // namespace

signal::Record read_record(std::istream& in, const std::string& name,
                           const Measurement& measurement) {
  if (!measurement.columns.empty() && measurement.columns.size() != 3) {
    throw std::invalid_argument("read_record: columns must hold 3 names or none");
  }
  const std::string head = first_bytes(in);
  const Reader& found =
      *std::find_if(readers.begin(), readers.end(),
                    [&](const Reader& reader) { return reader.recognises(head); });
  check_stated(found, measurement.format, name);
  return found.read(in, name, measurement);
}

signal::Record read_record(const Measurement& measurement) {
  if (measurement.in_memory) {
    return record_of(*measurement.in_memory, measurement.file.generic_string(),
                     measurement);
  }
  auto in = open_table(measurement.file, measurement.location, record_kind);
  return read_record(in, measurement.file.generic_string(), measurement);
}

}  // namespace trochoid::inputs
