#pragma once

#include <trochoid/base/units.h>

#include <optional>
#include <string>
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

enum class SurfaceModel { quasi_static, imprint, envelope };
enum class SurfaceLoad { distributed, concentrated };
enum class Feedback { none, entry, regenerative, direct };

/// [surface]
struct Surface {
  SurfaceModel model = SurfaceModel::envelope;
  SurfaceLoad load = SurfaceLoad::distributed;
  Feedback feedback = Feedback::none;
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

/// `detect`: the file says it.
enum class FrfKind { detect, receptance, mobility, accelerance };
enum class ResidualTerms { choose, yes, no };

enum class ModeBody { tool, table };
enum class Axis { x, y, z };

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

enum class CommandShape { sine, square, trapezoid, table };

/// [command]: imposed on the actuator.
struct ImposedCommand {
  CommandShape shape = CommandShape::sine;
  std::optional<double> peak_to_peak;  ///< [m]; not of a table
  std::string file;      ///< of a table: absolute, or relative to where we run
  std::string location;  ///< file:line:col of its `file` key
  double lead = 0.0;     ///< [s]
};

enum class CorrectionTarget { peak_force, chip_area, least_squares };
enum class CorrectionStrategy { plain, lead, inverse, inverse_in_time, learning };
enum class CorrectionShape { sine, square, trapezoid, quintic, harmonics };

/// What the command is made for: the runout of the case, or of a [[measurement]], or
/// what a static fit of the forces takes it for.
enum class RunoutEstimate { known, static_fit };

/// [correct]
struct Correction {
  CorrectionTarget target = CorrectionTarget::peak_force;
  CorrectionStrategy strategy = CorrectionStrategy::inverse;
  CorrectionShape shape = CorrectionShape::sine;
  RunoutEstimate estimate = RunoutEstimate::known;
  double transition = 80 * unit::deg;  ///< of trapezoid and quintic [rad]
  int harmonics = 9;                   ///< highest of the command
  std::optional<double> peak_to_peak;  ///< of the motion wanted [m]; absent: by target
  double sample_rate = 0.0;            ///< of a held command [Hz]; 0: continuous
  double learning_gain = 0.7;
  double allowed_difference = 0.05;   ///< of the peaks, for the highest speed
  std::vector<double> spindle_speed;  ///< first, last, number; as [stability] has it
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
  /// First, last and number, the last in the unit of the others; as the file has them.
  std::vector<double> spindle_speed;  ///< [rad/s]
  std::vector<double> axial_depth;    ///< [m]
  double tolerance = 1e-6;            ///< of the multiplier
  double margin = 0.01;      ///< within this of 1 a multiplier is called marginal
  double chip_floor = 2e-6;  ///< least chip of the gradient of a power law [m]
};

/// [frf]: a measured frequency response.
struct FrfTables {
  std::string file;      ///< absolute, or relative to where we run
  std::string location;  ///< file:line:col of its `file` key
  FrfKind kind = FrfKind::detect;
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
