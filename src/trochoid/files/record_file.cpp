#include <trochoid/files/record_file.h>

#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/files/csv_table.h>
#include <trochoid/files/dynoware.h>
#include <trochoid/files/hdf5_record.h>
#include <trochoid/files/lvm.h>
#include <trochoid/files/mat.h>
#include <trochoid/files/npy.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/record_table.h>
#include <trochoid/files/tdms.h>
#include <trochoid/files/uff58.h>
#include <trochoid/files/uff58_record.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

namespace trochoid::files {

namespace {

/// A format that a record may have.
struct RecordReader {
  RecordFormat format;
  std::string_view title;                ///< `a DynoWare export`
  std::string_view sign;                 ///< what tells it from others, for a message
  bool (*recognises)(std::string_view);  ///< the first bytes of a file
  decltype(&read_csv_record) read;
};

/// All of them: the first that recognises a file reads it, and the last takes any text.
constexpr std::array record_readers{
    RecordReader{RecordFormat::dynoware, "a DynoWare export",
                 "begins with `DynoWare,Version ...`", is_dynoware,
                 read_dynoware_record},
    RecordReader{RecordFormat::lvm, "a LabVIEW measurement file",
                 "begins with `LabVIEW Measurement`", is_lvm, read_lvm_record},
    RecordReader{RecordFormat::mat, "a MATLAB file",
                 "begins with `MATLAB ... MAT-file`", is_mat, read_mat_record},
    RecordReader{RecordFormat::tdms, "a TDMS file", "begins with `TDSm`", is_tdms,
                 read_tdms_record},
    RecordReader{RecordFormat::hdf5, "an HDF5 file",
                 "begins with the byte 0x89 and `HDF`", is_hdf5, read_hdf5_record},
    RecordReader{RecordFormat::npy, "a NumPy array",
                 "begins with the byte 0x93 and `NUMPY`", is_npy, read_npy_record},
    RecordReader{RecordFormat::uff58, "a universal file",
                 "begins with a line that contains only -1", is_uff, read_uff58_record},
    RecordReader{RecordFormat::csv, "a CSV file", "is text",
                 [](std::string_view) { return true; }, read_csv_record}};
static_assert(record_readers.size() == base::count_of<RecordFormat>());

/// Enough to recognise a format by.
constexpr std::size_t longest_head = 4096;

const RecordReader& reader_of(RecordFormat format) {
  return *std::find_if(
      record_readers.begin(), record_readers.end(),
      [&](const RecordReader& reader) { return reader.format == format; });
}

/// @throws base::InputError where the case file says another format
void check_stated(const RecordReader& found, const std::optional<RecordFormat>& stated,
                  const std::string& name) {
  if (!stated || *stated == found.format) {
    return;
  }
  const bool by_content = &found != &record_readers.back();
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
                           const RecordSource& source) {
  if (!source.columns.empty() && source.columns.size() != source.channels()) {
    throw std::invalid_argument("read_record: columns must name each channel or none");
  }
  const std::string head = first_bytes(in, longest_head);
  const RecordReader& found = *std::find_if(
      record_readers.begin(), record_readers.end(),
      [&](const RecordReader& reader) { return reader.recognises(head); });
  check_stated(found, source.format, name);
  return found.read(in, name, source);
}

signal::Record read_record(const RecordSource& source) {
  const FileRef& file = source.file;
  if (file.numbers) return record_of(*file.numbers, file.path, source);
  return read_record(*open_table(file, record_kind), file.path, source);
}

}  // namespace trochoid::files
