#pragma once

#include <trochoid/base/steps.h>
#include <trochoid/base/units.h>
#include <trochoid/correction/amplitude.h>
#include <trochoid/correction/command.h>
#include <trochoid/correction/shapes.h>
#include <trochoid/dynamics/imposed_command.h>
#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>
#include <trochoid/surface/feedback.h>
#include <trochoid/surface/readings.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Tables about the machine, the workpiece and its surface, in SI. Commands that do not
/// use them check them nevertheless: one case file serves several commands.
namespace trochoid::inputs {

/// [cutter_body]: the cutter as a beam.
struct CutterBody {
  double overhang = 0.0;                      ///< [m]
  std::optional<double> flute_length;         ///< [m]
  std::optional<double> shank_diameter;       ///< [m]
  std::optional<double> equivalent_diameter;  ///< of the fluted part [m]
  double youngs_modulus = 0.0;                ///< [N/m^2]
};

/// [wall]: the workpiece as a plate, clamped below and at both ends, free on top.
struct Wall {
  double length = 0.0;          ///< [m]
  double height = 0.0;          ///< [m]
  double thickness = 0.0;       ///< [m]
  double youngs_modulus = 0.0;  ///< [N/m^2]
  double poisson_ratio = 0.0;
  double position = 0.0;  ///< of the cutter along the wall [m]; default: its middle
};

/// [surface]
struct Surface {
  surface::Model model = surface::Model::envelope;
  surface::Load load = surface::Load::distributed;
  surface::Feedback feedback = surface::Feedback::none;
  double phase = 0.0;                     ///< phi0 [rad]
  std::vector<double> heights;            ///< of the answer, above the tip [m]
  std::vector<double> influence_heights;  ///< of influence.csv, above the tip [m]
  double probe_diameter = 0.0;            ///< of the measuring tip [m]; 0: a point
};

/// One [[surface_measurement]].
struct SurfaceMeasurement {
  std::string file;           ///< absolute, or relative to where we run
  bool datum_offset = false;  ///< a constant shift of the readings is estimated
  bool datum_tilt = false;    ///< as are tilts along and across the feed
  std::string location;       ///< file:line:col of its `file` key
};

enum class ResidualTerms { choose, yes, no };

/// Names of files.
constexpr std::string_view name_of(ResidualTerms terms) noexcept {
  switch (terms) {
    case ResidualTerms::choose:
      return "choose";
    case ResidualTerms::yes:
      return "yes";
    case ResidualTerms::no:
      return "no";
  }
  return {};
}

using structure::Axis;
using structure::ModeBody;

/// One [[mode]]: two of mass, stiffness and frequency, one of the dampings.
struct Mode {
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;
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
  std::string file;      ///< of a table: absolute, or relative to where we run
  std::string location;  ///< file:line:col of its `file` key
  double lead = 0.0;     ///< [s]
};

/// What the command is made for: the runout of the case, or of a [[measurement]], or
/// what a static fit of the forces takes it for.
enum class RunoutEstimate { known, static_fit };

/// Names of files.
constexpr std::string_view name_of(RunoutEstimate estimate) noexcept {
  switch (estimate) {
    case RunoutEstimate::known:
      return "known";
    case RunoutEstimate::static_fit:
      return "static_fit";
  }
  return {};
}

/// [correct]
struct Correction {
  correction::Target target = correction::Target::peak_force;
  correction::Method strategy = correction::Method::inverse;
  correction::Shape shape = correction::Shape::sine;
  RunoutEstimate estimate = RunoutEstimate::known;
  double transition = 80 * unit::deg;  ///< of trapezoid and quintic [rad]
  int harmonics = 9;                   ///< highest of the command
  std::optional<double> peak_to_peak;  ///< of the motion wanted [m]; absent: by target
  double sample_rate = 0.0;            ///< of a held command [Hz]; 0: continuous
  double learning_gain = 0.7;
  double allowed_difference = 0.05;          ///< of the peaks, for the highest speed
  std::optional<base::Steps> spindle_speed;  ///< of the map [rad/s]
};

/// [controller]: the real-time controller when it is simulated.
struct Controller {
  double rate = 4000.0;       ///< of the loop [Hz]
  int counts = 4096;          ///< of the encoder, a turn
  double jitter = 0.0;        ///< standard deviation of the loop's time [s]
  double speed_ripple = 0.0;  ///< amplitude, part of the speed, once a turn
  double fade = 0.2;          ///< [s]
  double ramp = 0.05;         ///< to mid-stroke after a fault [s]
  int turns = 40;             ///< that are simulated
  int index_lost_at = 0;      ///< turn from which no index pulse comes; 0: never
  bool adapt = false;         ///< the amplitude learns from the forces while it runs
};

/// [stability]
struct Stability {
  std::optional<base::Steps> spindle_speed;  ///< of the lobes [rad/s]
  std::optional<base::Steps> axial_depth;    ///< [m]
  double tolerance = 1e-6;                   ///< of the multiplier
  double margin = 0.01;      ///< within this of 1 a multiplier is called marginal
  double chip_floor = 2e-6;  ///< least chip of the gradient of a power law [m]
};

/// [frf]: a measured frequency response.
struct FrfTables {
  std::string file;      ///< absolute, or relative to where we run
  std::string location;  ///< file:line:col of its `file` key
  std::optional<structure::ResponseKind> kind;  ///< absent: the file says it
  int dataset = 0;           ///< of a universal file, from 1; 0: the only one
  int modes = 0;             ///< 0: their number is chosen
  std::vector<double> band;  ///< lowest and highest line [Hz]; empty: all
  ResidualTerms residual_terms = ResidualTerms::choose;
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;
};

/// [step]: a measured step of the actuator.
struct StepTables {
  std::string file;             ///< absolute, or relative to where we run
  std::string location;         ///< file:line:col of its `file` key
  std::optional<double> step;   ///< height of the commanded step [m]
  std::optional<double> start;  ///< when it was commanded [s]
};

struct MachineTables {
  std::optional<CutterBody> cutter_body;
  std::optional<Wall> wall;
  std::optional<Surface> surface;
  std::vector<SurfaceMeasurement> surface_measurements;
  std::vector<Mode> modes;
  std::optional<Actuator> actuator;
  std::optional<FrfTables> frf;
  std::optional<StepTables> step;
  std::optional<ImposedCommand> command;
  std::optional<Correction> correct;
  std::optional<Controller> controller;
  std::optional<Stability> stability;
};

}  // namespace trochoid::inputs
