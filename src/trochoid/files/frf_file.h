#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/file_ref.h>
#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::files {

/// Which frequency response is meant.
struct FrfSource {
  FileRef file;
  /// Needed where the file does not say it.
  std::optional<structure::ResponseKind> kind;
  int dataset = 0;  ///< of the frequency responses of a universal file, from 1; 0: the
                    ///< only one
  /// Of blows in time: newtons per unit of the force, and SI units per unit of the
  /// response, whatever units the file names; empty: by those.
  std::vector<double> scale = {};
};

struct FrfFile {
  structure::FrequencyResponse response;  ///< in SI; only its kind where it is a tap
  std::optional<signal::TapRecord> tap;   ///< hammer blows in time, in SI
  std::string description;  ///< what it is, in words, where the file says it
  std::vector<base::Warning> notes;
};

/// A response and its directions, as a universal file says them.
struct DirectedFrf {
  structure::Axis motion = structure::Axis::x;
  structure::Axis force = structure::Axis::x;
  FrfFile file;  ///< a direction against an axis has turned its sign
};

/// @brief The responses of a universal file that are of one point, along x and y, with a
///        direct one, joined by a cross response, and none twice.
/// @return empty: it holds no such set, or is no universal file
/// @throws base::InputError with every problem of the file
std::vector<DirectedFrf> read_directed_frfs(const FrfSource& source);

/// @brief Read a measured frequency response.
///
/// Hammer blows in time are read as such: a table with columns for time, force and a
/// response, a universal file with time records of both, a TDMS or MATLAB 5 file.
/// A response itself has three forms, told apart by their content: a universal file with sets 58 or 58b; a
/// table with a row of names (`freq_Hz`, and `re` and `im` or `mag` and `phase_deg`,
/// the unit in the name); rows of three numbers, frequency in Hz, real and imaginary
/// part, in SI.
/// @throws base::InputError with every problem of the file
FrfFile read_frf(const FrfSource& source);

/// @brief The same from text.
/// @param name  of the file, for messages
FrfFile read_frf(const std::string& text, const std::string& name,
                 const FrfSource& source);

/// A unit of a response, and what it measures.
struct ResponseUnit {
  structure::ResponseKind kind = structure::ResponseKind::receptance;
  double factor = 1.0;  ///< to SI
};

/// @brief `m/N`, `mm/s/N`, `(m/s^2)/N`, `g/N` ...; none when it is no such unit.
std::optional<ResponseUnit> response_unit(std::string_view text);

}  // namespace trochoid::files
