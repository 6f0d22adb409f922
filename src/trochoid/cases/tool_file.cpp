#include <trochoid/cases/tool_file.h>

#include <trochoid/base/error.h>
#include <trochoid/base/nesting.h>
#include <trochoid/base/read_text.h>
#include <trochoid/base/units.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string_view>

namespace trochoid::cases {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuse_tool(const std::string& file, std::string_view why) {
  throw base::InputError({fmt::format("{}: {}", file, why)});
}

std::string_view without_space(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) {
    text.remove_prefix(1);
  }
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())) != 0) {
    text.remove_suffix(1);
  }
  return text;
}

/// The number that a text begins with, and what is behind it.
std::optional<double> number_before(std::string_view& text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (read.ec != std::errc{}) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
  return value;
}

/// `5.0000 mm`, `0.25 in`, `0.25"`, and as FreeCAD writes what is short, `635.0 um` with a
/// Greek letter [m].
std::optional<double> length_in(std::string_view text) {
  text = without_space(text);
  const auto value = number_before(text);
  const std::string_view symbol = without_space(text);
  if (!value) return std::nullopt;
  if (symbol == "mm") return *value * unit::mm;
  for (const std::string_view um : {"um", "\xC2\xB5m", "\xCE\xBCm"}) {
    if (symbol == um) return *value * unit::um;
  }
  if (symbol == "in" || symbol == "\"") return *value * unit::inch;
  return std::nullopt;
}

/// A text of the bit itself; empty: it has none of that name.
std::string text_of(const Json& bit, const char* key) {
  const auto found = bit.find(key);
  return found != bit.end() && found->is_string() ? found->get<std::string>() : "";
}

/// Without what is no UTF-8, which no case file may hold.
std::string readable(const std::string& text) {
  return Json::parse(
             Json(text).dump(-1, ' ', false, nlohmann::detail::error_handler_t::ignore))
      .get<std::string>();
}

/// What a tool may measure [m]: no tool is wider, none that cuts thinner.
bool is_possible(double diameter) {
  return diameter > 1e-6 && diameter <= 10.0;
}

/// A text of the bit, of its parameters or, in older files, its attributes.
std::string text_in(const Json& bit, const char* key) {
  for (const char* group : {"parameter", "attribute"}) {
    const auto part = bit.find(group);
    if (part == bit.end() || !part->is_object()) continue;
    const auto found = part->find(key);
    if (found == part->end()) continue;
    return found->is_string() ? found->get<std::string>() : found->dump();
  }
  return {};
}

/// `endmill.fcstd` and `Endmill` are one shape.
Shape shape_of(const Json& bit, const std::string& file) {
  std::string shape = text_of(bit, "shape-type");
  if (shape.empty()) shape = text_of(bit, "shape");
  shape = std::filesystem::path(shape).stem().string();
  std::ranges::transform(shape, shape.begin(), [](unsigned char c) {
    return static_cast<char>(std::tolower(c));
  });
  if (shape == "endmill") return Shape::cylinder;
  if (shape == "ballend") return Shape::ball;
  if (shape == "bullnose" || shape == "torus") return Shape::bull_nose;
  refuse_tool(file, fmt::format("the tool is of the shape \"{}\"; must be an end mill: "
                                "endmill, ballend, bullnose or torus",
                                shape));
}

/// Of a bull nose: as it stands, or what is left beside the flat in its middle.
std::optional<double> corner_radius_of(const Json& bit, double diameter) {
  for (const char* key : {"CornerRadius", "TorusRadius"}) {
    if (const auto radius = length_in(text_in(bit, key))) return radius;
  }
  const auto flat = length_in(text_in(bit, "FlatRadius"));
  if (!flat || !(*flat >= 0.0 && *flat < 0.5 * diameter)) return std::nullopt;
  return 0.5 * diameter - *flat;
}

FoundTool tool_of_bit(const std::string& text, const std::string& file) {
  const Json bit = Json::parse(text, nullptr, false);
  if (!bit.is_object() || !bit.contains("shape")) {
    refuse_tool(file, "this is no tool bit of FreeCAD, which is JSON with a \"shape\"");
  }
  FoundTool tool{.name = readable(text_of(bit, "name")), .shape = shape_of(bit, file)};
  const std::string diameter = text_in(bit, "Diameter");
  const auto length = length_in(diameter);
  if (!length || !is_possible(*length)) {
    refuse_tool(
        file, fmt::format("\"Diameter\" = \"{}\": must be a length such as \"6.0 mm\" "
                          "or \"0.25 in\"",
                          diameter));
  }
  tool.diameter = *length;
  if (tool.shape == Shape::bull_nose) {
    tool.corner_radius = corner_radius_of(bit, tool.diameter);
  }
  const std::string flutes = text_in(bit, "Flutes");
  std::string_view rest = without_space(flutes);
  const auto teeth = number_before(rest);
  if (teeth && *teeth >= 1 && *teeth <= 64) tool.teeth = static_cast<int>(*teeth);
  return tool;
}

/// A line `T3 P3 D6.0 Z+1.5 ;6 mm end mill`.
struct TableLine {
  std::optional<int> number = {};
  std::optional<double> diameter = {};  ///< in units of the machine
  std::string comment = {};
};

TableLine line_of_table(std::string_view line) {
  constexpr double most_number = 1e6;
  TableLine found;
  const std::size_t semicolon = line.find(';');
  if (semicolon != std::string_view::npos) {
    found.comment = readable(std::string(without_space(line.substr(semicolon + 1))));
  }
  line = without_space(line.substr(0, semicolon));
  while (!line.empty()) {
    const char letter =
        static_cast<char>(std::toupper(static_cast<unsigned char>(line[0])));
    line.remove_prefix(1);
    // As it is written of a tool that has no pocket: `T1 P X0`.
    const bool without_number =
        line.empty() || line.front() == ' ' || line.front() == '\t';
    if (without_number && letter != 'T' && letter != 'D') {
      line = without_space(line);
      continue;
    }
    const auto value = number_before(line);
    if (!value) return {};
    if (letter == 'T' && *value >= 0 && *value < most_number) {
      found.number = static_cast<int>(*value);
    }
    if (letter == 'D') found.diameter = *value;
    line = without_space(line);
  }
  return found;
}

FoundTool tool_of_table(std::string_view text, const ToolChoice& choice) {
  const std::string file = choice.file.string();
  const double one = choice.inches ? unit::inch : unit::mm;
  std::vector<TableLine> tools;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    TableLine line = line_of_table(text.substr(0, end));
    const bool usable =
        line.number && line.diameter && is_possible(*line.diameter * one);
    if (usable) tools.push_back(std::move(line));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  if (tools.empty()) {
    refuse_tool(
        file,
        "no tool with a diameter is in it; must be a tool bit of FreeCAD (.fctb) "
        "or a tool table of LinuxCNC, with lines such as `T1 P1 D6.0 ;6 mm end "
        "mill`");
  }
  std::vector<int> numbers;
  for (const TableLine& line : tools) numbers.push_back(*line.number);
  const auto wanted = std::ranges::find(numbers, choice.number.value_or(numbers[0]));
  if ((!choice.number && tools.size() > 1) || wanted == numbers.end()) {
    refuse_tool(file, fmt::format("which tool? --tool-number, one of {}",
                                  fmt::join(numbers, ", ")));
  }
  const TableLine& line = tools[static_cast<std::size_t>(wanted - numbers.begin())];
  return {.name = line.comment, .diameter = *line.diameter * one};
}

}  // namespace

FoundTool read_tool(const ToolChoice& choice) {
  const std::string file = choice.file.string();
  const auto text = base::read_text(choice.file);
  if (!text) refuse_tool(file, "there is no such file, or it cannot be read");
  if (!without_space(*text).starts_with('{')) return tool_of_table(*text, choice);
  if (base::too_deep(*text)) refuse_tool(file, "it nests deeper than any tool bit");
  return tool_of_bit(*text, file);
}

std::vector<std::string> take_tool(const FoundTool& found, ToolTable& tool) {
  std::vector<std::string> stay;
  if (found.shape) {
    tool.shape = *found.shape;
  } else {
    stay.emplace_back("shape");
  }
  tool.diameter = found.diameter;
  tool.corner_radius = found.corner_radius;
  if (tool.shape == Shape::bull_nose && !tool.corner_radius) {
    stay.emplace_back("corner_radius_mm");
  }
  if (found.teeth) {
    tool.teeth = *found.teeth;
  } else {
    stay.emplace_back("teeth");
  }
  stay.emplace_back("helix_deg");
  return stay;
}

}  // namespace trochoid::cases
