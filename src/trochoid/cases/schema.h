#pragma once

#include <trochoid/base/command.h>
#include <trochoid/base/estimate.h>
#include <trochoid/base/steps.h>
#include <trochoid/cases/previous_clamping.h>
#include <trochoid/cases/program_tables.h>
#include <trochoid/files/file_ref.h>
#include <trochoid/files/surface_frame.h>
#include <trochoid/geometry/cutter.h>

#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace trochoid::cases {

/// Allowed numbers, in the unit of the file.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open_low = false;   ///< low itself is not allowed
  bool open_high = false;  ///< high itself is not allowed
};

constexpr Range between(double low, double high) {
  return {low, high};
}
constexpr Range at_least(double low) {
  return {.low = low};
}
constexpr Range above(double low) {
  return {.low = low, .open_low = true};
}
constexpr Range above_up_to(double low, double high) {
  return {low, high, true};
}
constexpr Range from_below(double low, double high) {
  return {low, high, false, true};
}
constexpr Range inside(double low, double high) {
  return {low, high, true, true};
}

/// When a key must be there, given that its table is.
enum class Need {
  optional,
  always,
  coefficient,  ///< only where forces are computed from given coefficients
  cutting,      ///< the same, unless [orthogonal] tells them
};

/// A key that has a meaning only for some values of another key of its table.
struct Only {
  std::string_view selector;
  std::vector<std::string_view> values;
};

/// @brief What is known of a key. Its unit is the end of its name.
struct Key {
  std::string_view name;
  std::string_view meaning;
  Range range = {};
  Need need = Need::optional;
  std::size_t count = 0;  ///< entries of a list, or rows; 0: any number, 3 rows
  bool gaps = false;      ///< entries may be empty, and missing at the end of a list
  Only only = {};
  std::optional<double> neutral = {};  ///< accepted even where the key has no meaning
  std::string_view word = {};          ///< text that may stand instead of the value
  std::string_view rival = {};         ///< key that may stand instead of this one
  std::string_view standard = {};      ///< the default in words, where it is computed
  std::string_view example = {};       ///< TOML, where there is no default to show
  std::string_view file = {};          ///< of a file: what it must be
  std::string_view in_folder = {};     ///< the file meant where a folder is named
};

/// A closed choice; enumerators and names are in the same order.
struct Choice {
  std::span<const std::string_view> names;
  std::function<int()> get;
  std::function<void(int)> set;
};

struct Choices {
  std::span<const std::string_view> names;
  bool alone = false;  ///< one of them may be written as a text, and is
  std::function<std::vector<int>()> get;
  std::function<void(const std::vector<int>&)> set;
};

using Rows = std::vector<std::array<double, 3>>;

/// A number for all teeth, or a list with one for each.
struct PerTooth {
  std::vector<double> values;  ///< one entry: of all teeth
  bool listed = false;         ///< written as a list
};

struct CutTable;

/// The variable behind a key, in SI and radians. Empty lists and texts count as absent.
using Field =
    std::variant<bool*, int*, double*, std::optional<double>*, std::string*,
                 files::FileRef*, std::vector<double>*, std::optional<base::Steps>*,
                 std::vector<std::string>*, Rows*, Choice, Choices, CutTable*,
                 std::optional<PreviousClamping>*, std::optional<files::SurfaceFrame>*,
                 std::optional<files::Direction>*, Pairs*,
                 std::optional<StockCylinder>*, ToolName*, std::vector<ToolName>*,
                 NamedPlaces*, NamedFiles*, ArcLayers*, PerTooth*,
                 std::optional<geometry::Serration>*, std::optional<base::Normal>*>;

/// Called for each key of a table, in the order in which the keys are written.
using Visitor = std::function<void(const Key&, const Field&)>;

/// A table, or list of tables, of the case file.
struct TableEntry {
  std::string_view name;
  std::string_view meaning;
  std::vector<base::Command> needed_by = {};  ///< have no answer without it
  bool many = false;                          ///< [[name]] instead of [name]
  std::function<std::size_t()> count;         ///< how many there are
  std::function<void()> add;                  ///< one more (at most one unless `many`)
  std::function<void(std::size_t, const Visitor&)> describe;  ///< the keys of one
};

/// `[name]` or `[[name]]`
std::string heading(const TableEntry& table);

/// @brief What a key means, and for which choices alone; Markdown.
std::string meaning_of(const Key& key);

/// @brief What a key accepts, in words: `a number above 0 and at most 1000 mm`.
std::string expectation(const Key& key, const Field& field);

/// @brief The value of a field as TOML, in the unit of its key; nothing when absent.
std::optional<std::string> toml_text(const Key& key, const Field& field);

}  // namespace trochoid::cases
