#pragma once

#include <trochoid/inputs/case.h>

#include <string_view>

namespace trochoid::inputs {

/// Of a force record.
enum class RecordFormat : int { csv, dynoware, mat, lvm, tdms, hdf5, npy, uff58 };

/// Names of files.
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

}  // namespace trochoid::inputs
