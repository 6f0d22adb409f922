#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/file_ref.h>
#include <trochoid/structure/identify_actuator.h>

#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::files {

/// Which step is meant, and what the file need not say.
struct StepSource {
  FileRef file;
  std::optional<double> step;   ///< height of the commanded step [m]
  std::optional<double> start;  ///< when it was commanded [s]
};

struct StepFile {
  structure::StepRecord record;  ///< in SI
  std::vector<double> command;   ///< [m]; empty: no such column
  std::vector<base::Warning> notes;
};

/// @brief Read the record of a commanded step: CSV with columns `time`, `position` and,
/// unless the height of the step is given, `command`, units in the names.
/// @throws base::InputError with every problem of the file
StepFile read_step(const StepSource& source);

/// @brief The same from an open stream.
/// @param name  of the file, for messages
StepFile read_step(std::istream& in, const std::string& name, const StepSource& source);

}  // namespace trochoid::files
