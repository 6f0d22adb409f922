#pragma once

#include <trochoid/files/file_ref.h>
#include <trochoid/force/sensor.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::files {

/// Of a force record.
enum class RecordFormat { csv, dynoware, mat, lvm, tdms, hdf5, npy, uff58 };

/// The names that files use.
constexpr std::string_view name_of(RecordFormat format) noexcept {
  switch (format) {
    case RecordFormat::csv:
      return "csv";
    case RecordFormat::dynoware:
      return "dynoware";
    case RecordFormat::mat:
      return "mat";
    case RecordFormat::lvm:
      return "lvm";
    case RecordFormat::tdms:
      return "tdms";
    case RecordFormat::hdf5:
      return "hdf5";
    case RecordFormat::npy:
      return "npy";
    case RecordFormat::uff58:
      return "uff58";
  }
  return {};
}

/// Which force record is meant, and what its file need not say.
struct RecordSource {
  FileRef file;
  std::optional<RecordFormat> format;  ///< absent: by its content
  /// What each channel reads, 1 to 8 of them; empty: forces in x, y and z.
  std::vector<force::ChannelAxis> axes = {};
  /// A name for each channel, an empty one for one that is not there; empty: found by name.
  std::vector<std::string> columns;
  std::string angle_column;           ///< empty: found by name
  std::string time_column;            ///< empty: found by name
  std::string pulse_column;           ///< one pulse a turn; empty: none
  std::string line_column;            ///< line of the NC program; empty: none
  std::optional<double> sample_rate;  ///< [Hz]
  /// N, N m or W per unit of each channel; empty: by unit.
  std::vector<double> scale;

  [[nodiscard]] std::size_t channels() const noexcept {
    return axes.empty() ? 3 : axes.size();
  }
};

}  // namespace trochoid::files
