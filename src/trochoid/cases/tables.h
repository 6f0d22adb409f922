#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/cases/schema.h>

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// The tables of a case file as they are written, in
/// SI; case.h is what becomes of them.
namespace trochoid::cases {

enum class Shape { cylinder, ball, bull_nose, taper, apt };

/// As files spell it.
constexpr std::string_view name_of(Shape shape) noexcept {
  switch (shape) {
    case Shape::cylinder:
      return "cylinder";
    case Shape::ball:
      return "ball";
    case Shape::bull_nose:
      return "bull_nose";
    case Shape::taper:
      return "taper";
    case Shape::apt:
      return "apt";
  }
  return {};
}
enum class EngagementKind { slot, up, down, band, arcs };

/// As files spell it.
constexpr std::string_view name_of(EngagementKind kind) noexcept {
  switch (kind) {
    case EngagementKind::slot:
      return "slot";
    case EngagementKind::up:
      return "up";
    case EngagementKind::down:
      return "down";
    case EngagementKind::band:
      return "band";
    case EngagementKind::arcs:
      return "arcs";
  }
  return {};
}

struct ToolTable {
  Shape shape = Shape::cylinder;
  int teeth = 1;
  double diameter = 0.0;
  PerTooth helix = {{0.0}};
  std::vector<double> pitch;
  std::optional<double> corner_radius;
  std::optional<double> corner_center_radius;
  std::optional<double> corner_center_height;
  std::optional<double> bottom_angle;
  std::optional<double> taper;
  geometry::LagLaw lag = geometry::LagLaw::constant_lead;
  std::optional<double> lag_diameter;
  std::optional<double> gauge_length;
  std::optional<geometry::Serration> serration;
  double dish = 0.0;
  double wiper = 0.0;
};

struct CutTable {
  EngagementKind engagement = EngagementKind::slot;
  std::optional<double> radial_depth;
  std::optional<double> radial_depth_sd;
  std::vector<double> stock_y;
  Pairs arcs;                         ///< theta [rad]
  ArcLayers layers;                   ///< arcs by height
  std::optional<double> path_radius;  ///< [m], below 0: the path turns right
  double axial_depth = 0.0;
  std::optional<double> axial_depth_sd;
  std::optional<double> feed_per_tooth;
  std::optional<double> feed_per_tooth_sd;
  std::optional<double> feed_rate;
  double spindle_speed = 0.0;
  double spindle_lead = 0.0;
};

struct ForceTable {
  int law = 0;  ///< place in force::law_kinds
  /// By key: every number of every law; absent: not given.
  std::map<std::string_view, std::optional<double>> numbers = {};
  force::EdgeLength edge_length = force::EdgeLength::true_length;
  std::optional<double> wear_land;       ///< [m]
  std::optional<double> indentation;     ///< [N/m^3]
  std::optional<double> flank_friction;  ///< absent: as usual, where a flank rubs
};

/// What cutting across the edge told of the material: each list holds the value, by how much
/// it grows with a degree of the rake, and with a millimetre of the chip.
struct OrthogonalTable {
  std::vector<double> shear_stress;    ///< [N/m^2]
  std::vector<double> friction_angle;  ///< [rad]
  std::vector<double> shear_angle;     ///< [rad]; empty: by the ratio
  std::vector<double> chip_ratio;      ///< at a chip of 1 mm
  std::vector<double> chip_ratio_exponent;
  double rake = 0.0;                  ///< [rad]
  std::optional<double> inclination;  ///< [rad]
  std::optional<double> chip;         ///< [m]
};

/// What is done about a dynamometer that rings.
enum class Resonance { automatic, none };

/// As files spell it.
constexpr std::string_view name_of(Resonance resonance) noexcept {
  switch (resonance) {
    case Resonance::automatic:
      return "auto";
    case Resonance::none:
      return "none";
  }
  return {};
}

struct DynamometerTable {
  std::vector<std::string> axes;
  Rows matrix;
  std::optional<double> sensor = 0.0;  ///< [rad]; absent: found
  std::vector<double> channel_sd;
  std::optional<double> gain_sd;
  std::optional<double> turn_sd;
  files::FileRef frf;
  Resonance resonance = Resonance::automatic;
};

struct MeasurementTable {
  files::RecordSource source;
  std::optional<double> from;
  std::optional<double> to;
  std::vector<double> mean;
  std::vector<double> mean_sd;
  std::string group;
  CutTable cut;  ///< complete: [cut] with the overrides of this run
};

/// [identify] runout: what is searched, alone or several of them.
enum class RunoutGroup {
  automatic,
  none,
  fixed,
  offsets,
  eccentricity,
  both,
  axial,
  tilt,
};

/// As files spell it.
constexpr std::string_view name_of(RunoutGroup group) noexcept {
  switch (group) {
    case RunoutGroup::automatic:
      return "auto";
    case RunoutGroup::none:
      return "none";
    case RunoutGroup::fixed:
      return "fixed";
    case RunoutGroup::offsets:
      return "offsets";
    case RunoutGroup::eccentricity:
      return "eccentricity";
    case RunoutGroup::both:
      return "both";
    case RunoutGroup::axial:
      return "axial";
    case RunoutGroup::tilt:
      return "tilt";
  }
  return {};
}

/// [prior]: by key of a coefficient.
struct PriorTable {
  std::map<std::string_view, std::optional<base::Normal>> numbers = {};
};

struct IdentifyTable {
  std::vector<chip::Model> chip_models = Identify{}.chip_models;
  std::vector<RunoutGroup> runout = {RunoutGroup::automatic};
  std::optional<double> phase;
  std::optional<double> band_harmonics;
  ChannelOffset channel_offsets = ChannelOffset::automatic;
  identification::Errors errors = identification::Errors::automatic;
  Shared shared = Shared::runout;
  std::optional<PreviousClamping> previous_clamping;
  std::optional<base::Steps> sweep;
};

struct CaseTables {
  int version = case_version;
  std::string title;
  ToolTable tool;
  geometry::Runout runout;
  CutTable cut;
  chip::ChipModel chip;
  ForceTable force;
  std::optional<OrthogonalTable> orthogonal;
  Sampling sampling;
  std::optional<DynamometerTable> dynamometer;
  std::vector<MeasurementTable> measurements;
  std::optional<IdentifyTable> identify;
  std::optional<PriorTable> prior;
  std::optional<Plan> plan;
  MachineTables machine;
  ProgramTables nc;
};

void describe(const Visitor& v, ToolTable& t);
void describe(const Visitor& v, geometry::Serration& t);
void describe(const Visitor& v, geometry::Runout& t);
void describe(const Visitor& v, CutTable& t);
void describe(const Visitor& v, chip::ChipModel& t);
void describe(const Visitor& v, ForceTable& t);
void describe(const Visitor& v, OrthogonalTable& t);
void describe(const Visitor& v, Sampling& t);
void describe(const Visitor& v, DynamometerTable& t);
void describe(const Visitor& v, MeasurementTable& t);
void describe(const Visitor& v, IdentifyTable& t);
void describe(const Visitor& v, PriorTable& t);
void describe(const Visitor& v, Plan& t);
void describe(const Visitor& v, PreviousClamping& t);
void describe(const Visitor& v, files::SurfaceFrame& t);
/// The keys above all tables.
void describe(const Visitor& v, CaseTables& t);

/// @brief Every table of a case file, in the order in which they are written.
std::vector<TableEntry> tables_of(CaseTables& tables);

}  // namespace trochoid::cases
