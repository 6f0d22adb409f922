#pragma once

#include <trochoid/cases/case_source.h>

#include <filesystem>

namespace pybind11 {
class dict;
class object;
}  // namespace pybind11

namespace trochoid::python {

/// @brief A case as it was given, unchecked: tables of a file or of a program, and
/// data that are in memory.
struct Document {
  cases::Node root;
  std::filesystem::path file;  ///< its folder is what names of files count from
  cases::DataInMemory data;

  [[nodiscard]] cases::CaseSource source() const { return {root, file, data}; }
};

/// @brief What a Python mapping says; keys whose value is None are left out.
/// @throws TypeError for what no case file could hold, with the key
cases::Node node_of(const pybind11::dict& tables, const std::filesystem::path& file);

/// @brief The same again as dict, list, str, int, float and bool.
pybind11::object object_of(const cases::Node& node);

}  // namespace trochoid::python
