#pragma once

#include <trochoid/base/command.h>
#include <trochoid/base/warning.h>
#include <trochoid/cases/held.h>
#include <trochoid/cases/machine_tables.h>
#include <trochoid/cases/previous_clamping.h>
#include <trochoid/cases/program_tables.h>
#include <trochoid/cases/wall_plan.h>
#include <trochoid/files/record_source.h>
#include <trochoid/files/transmission_file.h>
#include <trochoid/force/law.h>
#include <trochoid/force/sensor.h>
#include <trochoid/force/setup.h>
#include <trochoid/identification/identify.h>
#include <trochoid/signal/record.h>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace trochoid::cases {

/// [sampling]: where a simulation is evaluated.
struct Sampling {
  int samples_per_rev = 720;
  double revolutions = 1.0;
  double start = 0.0;                ///< [rad]
  std::vector<double> angles;        ///< [rad]; not empty: instead of the three above
  std::vector<double> edge_angles;   ///< nominal theta of chip.csv [rad]
  std::vector<double> edge_heights;  ///< heights of chip.csv [m]
  double tolerance = 1e-6;           ///< of the peak force
};

/// [dynamometer]: channel i = sum over j of matrix[i][j] times force j on the tool.
struct Dynamometer {
  bool automatic = false;  ///< axes = "auto": find the signed permutation
  bool rigid = false;      ///< resonance = "none": none is looked for
  files::FileRef frf;      ///< measured response, channel over force; or none
  Held<files::TransmissionFile> response;  ///< what it holds
  std::array<std::array<double, 3>, 3> matrix = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  force::Sensor sensor;      ///< the same as axes; no channels: a full matrix, or auto
  bool sensor_free = false;  ///< the angle of the sensor is found
  std::vector<double> channel_sd;  ///< of a sample of each channel; empty: unknown
};

/// One [[measurement]].
struct Measurement {
  files::RecordSource source;
  Held<signal::Record> record;
  std::optional<double> from;  ///< what is before it is not used [s]
  std::optional<double> to;    ///< what is after it is not used [s]
  std::vector<double> mean;    ///< not empty: of each channel, instead of a record
  std::vector<double> mean_sd;
  std::string group;  ///< those of one name share coefficients
  geometry::Cut cut;  ///< [cut] with this run's overrides
};

/// What is done about a constant or slowly drifting reading of each channel.
enum class ChannelOffset {
  automatic,  ///< as idle where the records have air, else as fit
  none,       ///< the record is taken as it stands
  idle,       ///< estimated where nothing cuts
  fit,        ///< one constant and one slope a channel, found with the coefficients
};

/// As files spell it.
constexpr std::string_view name_of(ChannelOffset offset) noexcept {
  switch (offset) {
    case ChannelOffset::automatic:
      return "auto";
    case ChannelOffset::none:
      return "none";
    case ChannelOffset::idle:
      return "idle";
    case ChannelOffset::fit:
      return "fit";
  }
  return {};
}

/// What measurements of different groups have in common.
enum class Shared { runout, coefficients };

/// As files spell it.
constexpr std::string_view name_of(Shared shared) noexcept {
  switch (shared) {
    case Shared::runout:
      return "runout";
    case Shared::coefficients:
      return "coefficients";
  }
  return {};
}

/// [identify]
struct Identify {
  std::vector<chip::Model> chip_models = {chip::Model::none, chip::Model::feed,
                                          chip::Model::trochoidal};
  /// Absent: decided by the record.
  std::optional<identification::RunoutUnknowns> runout;
  std::optional<double> phase;        ///< [rad]; absent: free
  std::optional<int> band_harmonics;  ///< 0: all; absent: chosen from the record
  ChannelOffset channel_offsets = ChannelOffset::automatic;
  identification::Errors errors = identification::Errors::automatic;
  identification::Tolerances tolerances = {};
  Shared shared = Shared::runout;  ///< by groups of measurements
  std::optional<PreviousClamping> previous_clamping;
  std::optional<base::Steps> sweep;  ///< of the offset of tooth 2 [m]
  bool axial_offsets = false;        ///< are found as well
  bool tilt = false;                 ///< is found as well
  /// Of each coefficient of the law [SI]; empty: none.
  std::vector<std::optional<base::Normal>> prior = {};
  /// The channels are fitted as they are, each with its own weight: they are not three
  /// forces, or their standard deviations, means or a prior are given.
  bool by_channels = false;
};

/// A kind of cut that a plan looks at.
enum class PlannedEngagement { slot, up, down };

/// As files spell it.
constexpr std::string_view name_of(PlannedEngagement engagement) noexcept {
  switch (engagement) {
    case PlannedEngagement::slot:
      return "slot";
    case PlannedEngagement::up:
      return "up";
    case PlannedEngagement::down:
      return "down";
  }
  return {};
}

/// [plan]: the cuts among which the one to be measured next is chosen, how a wall is to be
/// measured and cut, or which feed keeps a finish.
struct Plan {
  std::optional<PlanOf> of;  ///< absent: as the other tables say
  bool settled = false;      ///< `of` is: keys of the other kind are not written
  WallPlan wall = {};
  FinishPlanTable finish = {};
  std::vector<PlannedEngagement> engagements = {
      PlannedEngagement::slot, PlannedEngagement::up, PlannedEngagement::down};
  std::vector<double> feeds;          ///< per tooth [m]
  std::vector<double> axial_depths;   ///< [m]
  std::vector<double> radial_depths;  ///< [m]
  int turns = 10;
  int samples_per_rev = 360;
  std::optional<double> noise;          ///< of a sample [N]
  std::optional<double> max_force;      ///< in the plane of the table [N]
  std::vector<std::string> quantities;  ///< names without unit, coefficients, runout
};

/// Version of the case file: its key `schema`. Raised when a key goes, or changes its
/// meaning or unit; further keys do not raise it.
inline constexpr int case_version = 1;

/// @brief A case file, read and checked, in SI and radians.
struct Case {
  std::filesystem::path file;
  std::string title;
  force::Setup setup;  ///< [tool] [runout] [cut] [chip], edge length of [force]
  force::Law law;      ///< [force]
  std::optional<double> gauge_length;  ///< [tool] gauge_length_mm [m]
  double dish = 0.0;                   ///< of the bottom edge [rad]
  double wiper = 0.0;                  ///< of the bottom edge [m]
  double spindle_lead = 0.0;           ///< [cut] spindle_lead_deg [rad]
  bool forces_known = true;            ///< whether there is a [force]
  Sampling sampling;
  std::optional<Dynamometer> dynamometer;
  std::vector<Measurement> measurements;
  Identify identify;
  Plan plan;
  MachineTables machine;             ///< of other commands
  ProgramTables nc;                  ///< of a whole NC program
  std::vector<base::Warning> notes;  ///< values that are hardly meant
  std::string as_understood;         ///< TOML with every default filled in
};

using base::Command;

/// @brief Read a case file with all that it includes.
/// @param command        whose tables must be there; none: that which its tables show
/// @param result_folder  where `as_understood` will be written: the relative names of
///                       files in it count from there; empty: they become absolute
/// @throws base::InputError with every problem of the file
Case read_case(const std::filesystem::path& file, std::optional<Command> command,
               const std::filesystem::path& result_folder = {});

/// @brief The case of a bare data file: [frf] or [step] and nothing else.
/// @param machine  with `frf` for modes, or `step` for actuator; its `file` is relative
///                 to where we run
Case bare_case(const MachineTables& machine, Command command,
               const std::filesystem::path& result_folder = {});

/// Which tool of another program's file is meant.
struct ToolChoice {
  std::filesystem::path file;      ///< a FreeCAD tool bit, or a tool table of LinuxCNC
  std::optional<int> number = {};  ///< of a table of tools; none: it has one only
  bool inches = false;             ///< of a table of tools, which names no unit
};

/// @brief What a case to start from takes from other files.
struct NewCaseOptions {
  std::optional<ToolChoice> tool = {};  ///< in place of the example's
  std::filesystem::path material = {};  ///< a file with a [force]; empty: the example's
  std::filesystem::path folder = {};    ///< of the new case; empty: where we run
};

/// @brief A commented case file to start from.
/// @throws base::InputError where there is no such tool or material
std::string new_case(Command command, const NewCaseOptions& options = {});

/// @brief The page docs/formats/case.md, made from the schema.
std::string describe_case_file();

/// @brief The file docs/formats/case.schema.json: JSON Schema (draft 7) of a case file,
/// made from the same schema, for editors and checkers.
///
/// It tells types, ranges, choices, unknown keys, and what goes together within a table.
/// What no JSON Schema says is only for read_case: keys that depend on another table or on
/// the command, files that must be there, numbers that must fit one another.
std::string case_schema();

}  // namespace trochoid::cases
