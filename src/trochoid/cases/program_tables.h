#pragma once

#include <trochoid/base/units.h>
#include <trochoid/cases/held.h>
#include <trochoid/files/program_file.h>

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Tables about a whole NC program, in SI.
namespace trochoid::cases {

struct Case;

/// Which rules of writing an NC program follows.
enum class ProgramDialect { automatic, iso, linuxcnc, sinumerik, heidenhain_iso };

/// As files spell it.
constexpr std::string_view name_of(ProgramDialect dialect) noexcept {
  switch (dialect) {
    case ProgramDialect::automatic:
      return "auto";
    case ProgramDialect::iso:
      return "iso";
    case ProgramDialect::linuxcnc:
      return "linuxcnc";
    case ProgramDialect::sinumerik:
      return "sinumerik";
    case ProgramDialect::heidenhain_iso:
      return "heidenhain_iso";
  }
  return {};
}

/// What G41 and G42 are.
enum class Compensation { refuse, wear_zero };

/// As files spell it.
constexpr std::string_view name_of(Compensation compensation) noexcept {
  switch (compensation) {
    case Compensation::refuse:
      return "refuse";
    case Compensation::wear_zero:
      return "wear_zero";
  }
  return {};
}

/// What is told of the bottom edges of flat cutters in plunges and ramps.
enum class BottomEdges { estimate, none };

/// As files spell it.
constexpr std::string_view name_of(BottomEdges bottom) noexcept {
  switch (bottom) {
    case BottomEdges::estimate:
      return "estimate";
    case BottomEdges::none:
      return "none";
  }
  return {};
}

/// T: a number, or a name. Empty: not given.
struct ToolName {
  std::string text;
};

using Pairs = std::vector<std::array<double, 2>>;

/// Arcs of theta between two heights above the tip.
struct ArcLayerTable {
  double from = 0.0;  ///< [m]
  double to = 0.0;    ///< [m]
  Pairs arcs;         ///< [rad]
};
using ArcLayers = std::vector<ArcLayerTable>;
using NamedPlaces = std::map<std::string, std::array<double, 3>>;
using NamedFiles = std::map<std::string, files::FileRef>;

/// [program]
struct NcProgram {
  files::FileRef file;
  Held<files::ProgramFile> text;  ///< what it holds
  ProgramDialect dialect = ProgramDialect::automatic;
  ToolName tool_number;
  files::FileRef
      covariance;    ///< summary.json of what the numbers of the tool come from
  NamedFiles tools;  ///< by T: cases with [tool], [runout] and [force]
  std::map<std::string, std::shared_ptr<const Case>> cases_of_tools;
  std::vector<ToolName> ignored_tools;
  std::vector<std::string> ignored_words;
  std::vector<double> origin = {0.0, 0.0, 0.0};  ///< [m]
  std::vector<double> start;                     ///< before the first block [m]
  NamedPlaces offsets;                           ///< [m]
  Compensation compensation = Compensation::refuse;
  bool block_delete = false;
  double step_turns = 1.0;
  BottomEdges bottom = BottomEdges::estimate;
  double floor = 1 * unit::um;        ///< [m]
  Pairs places;                       ///< line, fraction of its path
  std::vector<double> place_heights;  ///< above the tip [m]
};

/// A round bar along z.
struct StockCylinder {
  std::array<double, 2> axis{};  ///< x and y [m]
  double radius = 0.0;           ///< [m]
  std::array<double, 2> z{};     ///< lowest and highest [m]
};

/// [stock]: exactly one of box, cylinder and file.
struct Stock {
  std::vector<std::array<double, 3>> box;  ///< lowest and highest corner [m]
  std::optional<StockCylinder> cylinder;
  files::FileRef file;
  Held<std::vector<stock::Triangle>> faces;  ///< what it holds
  std::optional<double> cell;                ///< of the height field [m]
};

/// [limits]
struct ForceLimits {
  std::optional<double> peak_force;      ///< [N]
  std::optional<double> peak_tooth;      ///< [N]
  std::optional<double> torque;          ///< peak [N m]
  std::optional<double> power;           ///< mean of a turn [W]
  std::optional<double> bending_moment;  ///< at the gauge length [N m]
  std::optional<double> deflection;      ///< of the tip [m]
  std::vector<double> chip;  ///< lowest and highest of the largest chip of a turn [m]
};

/// [machine]
struct MachineDrives {
  std::vector<double> max_acceleration;          ///< x, y, z [m/s^2]
  std::vector<double> max_jerk;                  ///< x, y, z [m/s^3]
  std::vector<double> max_feed;                  ///< x, y, z [m/s]
  double rapid_feed = 10000 * unit::mm_per_min;  ///< [m/s]
  double corner_tolerance = 0.0;                 ///< [m]
  Pairs power_curve;                             ///< speed in rpm, power [W]
};

enum class FeedTarget { limits, even };

/// As files spell it.
constexpr std::string_view name_of(FeedTarget target) noexcept {
  switch (target) {
    case FeedTarget::limits:
      return "limits";
    case FeedTarget::even:
      return "even";
  }
  return {};
}

/// [feed]
struct FeedRules {
  FeedTarget target = FeedTarget::limits;
  double even_percentile = 50.0;
  std::vector<double> factor = {0.2, 1.5};  ///< lowest and highest, of the programmed
  std::string write;                        ///< a file in the folder of the answers
  bool split_lines = true;
};

struct ProgramTables {
  std::optional<NcProgram> program;
  std::optional<Stock> stock;
  std::optional<ForceLimits> limits;
  std::optional<MachineDrives> machine;
  std::optional<FeedRules> feed;
};

}  // namespace trochoid::cases
