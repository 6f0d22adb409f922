#pragma once

#include <trochoid/base/steps.h>
#include <trochoid/cases/response_tables.h>
#include <trochoid/correction/controller_in_loop.h>
#include <trochoid/correction/plan.h>
#include <trochoid/dynamics/imposed_command.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/files/step_file.h>
#include <trochoid/files/surface_file.h>
#include <trochoid/identification/identify.h>
#include <trochoid/structure/plate.h>
#include <trochoid/surface/choices.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/feedback.h>
#include <trochoid/surface/readings.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Tables about the machine, the workpiece and its surface, in SI. Commands that do not
/// use them check them nevertheless: one case file serves several commands.
namespace trochoid::cases {

/// [cutter_body]: the cutter as a beam.
struct CutterBody {
  double overhang = 0.0;                      ///< [m]
  std::optional<double> flute_length;         ///< [m]
  std::optional<double> shank_diameter;       ///< [m]
  std::optional<double> equivalent_diameter;  ///< of the fluted part [m]
  double youngs_modulus = 0.0;                ///< [N/m^2]
};

using structure::Ends;

/// [wall]: the workpiece as a plate, clamped below, free on top.
struct Wall {
  double length = 0.0;          ///< [m]
  double height = 0.0;          ///< [m]
  double thickness = 0.0;       ///< [m]
  double youngs_modulus = 0.0;  ///< [N/m^2]
  double poisson_ratio = 0.0;
  double position = 0.0;  ///< of the cutter along the wall [m]; default: its middle
  Ends ends = Ends::clamped;
  std::optional<double> pressure;     ///< to compare with handbooks [N/m^2]
  std::optional<double> edge_load;    ///< to compare with handbooks [N/m]
  std::optional<double> line_load;    ///< to compare with handbooks [N/m]
  std::vector<double> loads_x;        ///< of their deflections, along the wall [m]
  std::vector<double> loads_heights;  ///< of their deflections, above the foot [m]
};

/// One [[pass]]: what is different from [cut].
struct WallPass {
  std::optional<double> radial_depth;    ///< [m]; 0: nothing but what was left
  std::optional<double> feed_per_tooth;  ///< [m]
  std::optional<double> below_edge;      ///< of its top below the free edge [m]
};

/// What becomes of readings far from what all others say.
enum class Outliers { leave_out, keep };

/// As files spell it.
constexpr std::string_view name_of(Outliers outliers) noexcept {
  switch (outliers) {
    case Outliers::leave_out:
      return "leave_out";
    case Outliers::keep:
      return "keep";
  }
  return {};
}

/// [surface]
struct Surface {
  surface::Model model = surface::Model::envelope;
  surface::Load load = surface::Load::distributed;
  std::optional<surface::Feedback> feedback;  ///< none: as the readings decide
  double phase = 0.0;                         ///< phi0 [rad]
  std::vector<double> heights;                ///< of the answer, above the tip [m]
  std::vector<double> influence_heights;      ///< of influence.csv, above the tip [m]
  double probe_diameter = 0.0;                ///< of the measuring tip [m]; 0: a point
  std::vector<double> floor_y;                ///< lines of the floor [m]
  std::optional<double> cutoff;               ///< of the roughness filter [m]
  Outliers outliers = Outliers::leave_out;
  identification::Errors errors = identification::Errors::automatic;
  std::vector<surface::AlsoBends> also_bends;  ///< what more than y
};

/// What a measured surface is of.
enum class MeasuredOf { wall, finish };

/// As files spell it.
constexpr std::string_view name_of(MeasuredOf of) noexcept {
  return of == MeasuredOf::wall ? "wall" : of == MeasuredOf::finish ? "finish" : "";
}

/// One [[surface_measurement]].
struct SurfaceMeasurement {
  MeasuredOf of = MeasuredOf::wall;
  std::optional<double> floor_y;  ///< of a trace on the floor, across the feed [m]
  files::SurfaceSource source;
  Held<files::SurfaceFile> surface;
  bool datum_offset = false;          ///< a constant shift of the readings is estimated
  bool datum_tilt = false;            ///< as are tilts along and across the feed
  std::optional<surface::Form> form;  ///< none: as the readings decide
};

/// [step]: a measured step of the actuator.
struct StepTables {
  files::StepSource source;
  Held<files::StepFile> step;
};

/// Natural frequencies that a mode or an actuator may have [Hz].
inline constexpr double slowest_Hz = 0.01;
inline constexpr double fastest_Hz = 1e5;

/// One [[mode]]: two of mass, stiffness and frequency, one of the dampings.
struct Mode {
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;
  double angle = 0.0;               ///< of its direction from the axis, x to y [rad]
  std::optional<double> mass;       ///< [kg]
  std::optional<double> stiffness;  ///< [N/m]
  std::optional<double> damping;    ///< [N s/m]
  std::optional<double> frequency;  ///< [Hz]
  std::optional<double> damping_ratio;
};

/// [actuator]: by its time constants, or by frequency and damping ratio.
struct Actuator {
  double gain = 1.0;
  std::vector<double> time_constants;  ///< [s]
  std::optional<double> frequency;     ///< [Hz]
  std::optional<double> damping_ratio;
  std::vector<double> stroke;                ///< lowest and highest [m]
  std::optional<double> coupling_stiffness;  ///< [N/m]
  std::optional<double> coupling_damping;    ///< [N s/m]
  std::optional<double> slew;                ///< [m/s]
  double push = 2000.0;                      ///< [N]
  double pull = 300.0;                       ///< [N]
  std::optional<double> highest_frequency;   ///< of a command [Hz]
};

using dynamics::CommandShape;

/// [command]: imposed on the actuator.
struct ImposedCommand {
  CommandShape shape = CommandShape::sine;
  std::optional<double> peak_to_peak;  ///< [m]; not of a table
  files::FileRef file;                 ///< of a table
  Held<dynamics::CommandTable> table;  ///< what it holds
  double lead = 0.0;                   ///< [s]
};

/// [correct]
struct Correction {
  correction::CorrectionOptions options;     ///< but for the speeds of its map
  std::optional<base::Steps> spindle_speed;  ///< of the map [rad/s]
};

/// [spindle]: what turns the tool.
using Spindle = correction::SpindleDrive;

/// [controller]: the real-time controller when it is simulated.
using Controller = correction::LoopOptions;

/// [stability]
struct Stability {
  std::optional<base::Steps> spindle_speed;  ///< of the lobes [rad/s]
  std::optional<base::Steps> axial_depth;    ///< [m]
  int harmonics = 4;                         ///< of the multi-frequency solution
  dynamics::StabilityOptions options;
};

struct MachineTables {
  std::optional<CutterBody> cutter_body;
  std::optional<Wall> wall;
  std::optional<Surface> surface;
  std::vector<WallPass> passes;
  std::vector<SurfaceMeasurement> surface_measurements;
  std::vector<Mode> modes;
  std::optional<Actuator> actuator;
  std::optional<FrfTables> frf;
  std::vector<MeasuredFrf> measured_frfs;
  std::optional<StepTables> step;
  std::optional<ImposedCommand> command;
  std::optional<Correction> correct;
  std::optional<Spindle> spindle;
  std::optional<Controller> controller;
  std::optional<Stability> stability;
};

}  // namespace trochoid::cases
