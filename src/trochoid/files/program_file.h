#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/files/file_ref.h>
#include <trochoid/program/read_program.h>
#include <trochoid/stock/solid.h>

#include <memory>
#include <string>
#include <vector>

namespace trochoid::files {

/// What an NC program in a file makes the machine do.
struct ProgramFile {
  std::shared_ptr<const std::string> text;  ///< as it stands in the file
  program::Program program;
  std::vector<base::Warning> notes;
};

/// @brief Read the NC program of `[program]`.
/// @throws base::InputError with its problems, at most 50, each with line and column
ProgramFile read_program(const FileRef& file, program::ReadOptions options);

/// @brief Read the faces of the body of `[stock]` from an STL file, text or binary; its
/// numbers are mm.
/// @throws base::InputError  what is wrong with the file: cut off, no face, not closed
std::vector<stock::Triangle> read_stl(const FileRef& file);

}  // namespace trochoid::files
