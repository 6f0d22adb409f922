#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/cases/tables.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::cases {

/// @brief What a file of another program says of a tool.
struct FoundTool {
  std::string name;                          ///< as it stands there; may be empty
  std::optional<Shape> shape = {};           ///< none: not said
  double diameter = 0.0;                     ///< [m]
  std::optional<double> corner_radius = {};  ///< [m]
  std::optional<int> teeth = {};
};

/// @brief A tool of a FreeCAD tool bit (.fctb) or of a tool table of LinuxCNC.
/// @throws base::InputError where the file is neither, or the tool no end mill
FoundTool read_tool(const ToolChoice& choice);

/// @brief The table with what was found; the rest of it stays.
/// @return the keys that stay, and that every tool must have
std::vector<std::string> take_tool(const FoundTool& found, ToolTable& tool);

}  // namespace trochoid::cases
