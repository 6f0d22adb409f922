#pragma once

#include <trochoid/files/number_run.h>

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

/// The segments of a TDMS file: what each says of its objects, and where their data lie.
namespace trochoid::files {

/// Where a DAQmx channel stands among the bytes of one scan.
struct DaqmxScaler {
  NumberKind kind = NumberKind::i16;
  std::uint32_t buffer = 0;     ///< raw data come in several buffers, one after another
  std::uint32_t offset = 0;     ///< bytes from the begin of a scan
  std::optional<unsigned> bit;  ///< of a digital line
  std::uint32_t scale = 0;      ///< number of the scale that takes the raw number
};

/// How an object's data stand in a chunk of raw data.
struct TdmsLayout {
  std::optional<NumberKind> kind;  ///< absent: text, or numbers that are not read
  std::uint64_t values = 0;        ///< in a chunk
  std::uint64_t bytes = 0;         ///< in a chunk, where kind is absent
  std::optional<DaqmxScaler> daqmx;
  std::vector<std::uint32_t> widths;  ///< of the buffers of DAQmx, bytes a scan
};

using TdmsProperty = std::variant<double, std::string>;

struct TdmsObject {
  std::string group;
  std::string channel;  ///< empty: the file or a group
  std::map<std::string, TdmsProperty> properties;
  std::optional<TdmsLayout> layout;  ///< as said last
  bool has_data = false;             ///< in the segment that is read
  std::vector<NumberRun> runs;       ///< its numbers, in their order

  [[nodiscard]] std::uint64_t count() const;
};

struct TdmsFile {
  std::vector<TdmsObject> objects;
  bool unfinished = false;  ///< the last segment says no length: its writer was cut off
};

/// @throws base::InputError where sizes contradict the bytes that are there
TdmsFile read_tdms_segments(std::istream& in, const std::string& name);

/// @brief What one segment says of its objects.
/// @param metadata  stands behind the lead-in
/// @param known     objects so far, by path; new ones are added
/// @return places in `known` of the objects that this segment names
/// @throws base::InputError
std::vector<std::size_t> read_tdms_metadata(ByteCursor& metadata,
                                            const std::string& name,
                                            std::vector<TdmsObject>& known,
                                            std::map<std::string, std::size_t>& places);

}  // namespace trochoid::files
