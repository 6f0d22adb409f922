#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/base/warning.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/chip/model.h>
#include <trochoid/force/law.h>
#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/runout.h>
#include <trochoid/program/move.h>
#include <trochoid/stock/drives.h>
#include <trochoid/stock/initial.h>
#include <trochoid/structure/cantilever.h>

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::engagement {

/// A tool of a program and what it cuts with.
struct Tool {
  geometry::Cutter cutter;
  geometry::Runout runout;
  force::Law law;
  force::EdgeLength edge_length = force::EdgeLength::true_length;
  chip::ChipModel chip;
  std::optional<structure::Cantilever> body;  ///< nothing: deflections are 0
  double gauge_length = 0.0;  ///< height of the section of the bending moment [m]
  double flute_length = 0.0;  ///< [m]; 0: not known
  bool cuts = true;           ///< false: its moves cut nothing, by consent
};

/// Whether the bottom edges of flat cutters are estimated in plunges and ramps.
enum class Bottom { estimate, none };

struct Options {
  double step_turns = 1.0;              ///< of the spindle, a step
  double rapid_feed = 10.0 / 60;        ///< [m/s]
  std::optional<stock::Drives> drives;  ///< nothing: every feed is reached at once
  double floor = 1e-6;                  ///< layers thinner than this decide nothing [m]
  double cell = 0.0;                    ///< of the map of heights [m]; 0: usual_cell
  Bottom bottom = Bottom::estimate;
  base::Stop stop;
};

/// @brief The usual distance between the points of heights: a 20th of the smallest radius, at
/// least 0.05 mm [m].
double usual_cell(std::span<const Tool> tools) noexcept;

/// A program, its tools and the stock.
struct Job {
  const program::Program& program;
  std::span<const Tool> tools;  ///< shape (program.tools), or one if it names none
  const stock::Initial& stock;
  Options options;
};

/// Why the force is what it is.
enum class Cause : std::uint8_t {
  air,
  plunge,  ///< bottom in stock, down more than 10 times as fast as sideways
  ramp,    ///< bottom in stock
  slot,    ///< engaged on nearly half the circle
  corner,
  entry,
  exit,
  side,
};

/// The names that files use.
constexpr std::string_view name_of(Cause cause) noexcept {
  constexpr std::array<std::string_view, 8> names = {
      "air", "plunge", "ramp", "slot", "corner", "entry", "exit", "side"};
  return names[static_cast<std::size_t>(cause)];
}

/// What a row says beside its numbers: bits.
enum Flag : std::uint32_t {
  rubs_above_flute = 1,       ///< cut higher than the flutes
  straight_after_corner = 2,  ///< less than a turn after a kink: the chip is too thin
  spindle_stands = 4,         ///< in the feed: no forces
  thin_layer = 8,             ///< stock in layers below the floor only
};

/// Stock between two heights above the tip.
struct Layer {
  double from = 0.0;            ///< [m]
  double to = 0.0;              ///< [m]
  std::vector<chip::Arc> arcs;  ///< theta [rad], ascending
};

/// @brief Forces of a turn, on the tool, in the axes of the program.
///
/// A peak is the value of largest modulus, with its sign.
struct TurnForces {
  std::array<double, 3> mean{};       ///< [N]
  std::array<double, 3> peak{};       ///< [N]
  double peak_xy = 0.0;               ///< [N]
  std::vector<double> peak_of_tooth;  ///< |Fxy| of each tooth alone [N]
  double torque_mean = 0.0;           ///< [N m]
  double torque_peak = 0.0;           ///< [N m]
  double power = 0.0;                 ///< mean [W]
  double moment_peak = 0.0;           ///< at the gauge length [N m]
  double deflection = 0.0;            ///< of the tip, largest [m]
  double peak_chip = 0.0;             ///< [m]
};

/// @brief A step, or a row of steps in air.
///
/// @eq N-11  F_z = N (K_rc f_a/N + K_re) mean L, T = N (K_tc f_a/N + K_te) mean M: bottom
/// @src derived, an estimate
struct Step {
  std::int64_t step = 0;    ///< of all feed moves, air too, from 0; the first of a row
  std::int64_t count = 1;   ///< steps of this row
  std::uint32_t line = 0;   ///< from 1
  std::int32_t block = -1;  ///< N number
  std::int16_t tool = -1;
  std::size_t move = 0;           ///< its place in Program::moves
  double along = 0.0;             ///< path of feed moves up to its middle [m]
  double turns = 0.0;             ///< of the spindle, all steps of the row
  double time = 0.0;              ///< at the middle [s]
  double duration = 0.0;          ///< of all steps of the row [s]
  std::array<double, 3> place{};  ///< of the tip at the middle [m]
  double direction = 0.0;        ///< of the feed from +x [rad], in [0, 2 pi); NaN: none
  double curvature = 0.0;        ///< of the path, positive to the left [1/m]
  double spindle = 0.0;          ///< [rad/s]
  double feed = 0.0;             ///< of the machine along the path [m/s]
  double programmed_feed = 0.0;  ///< [m/s]
  double f_z = 0.0;              ///< horizontal, a tooth [m]
  double a_e = 0.0;              ///< [m]
  double a_p = 0.0;              ///< height with stock [m]
  double entry = 0.0;            ///< theta of the widest layer [rad]
  double exit = 0.0;             ///< theta of the widest layer [rad]
  double engaged = 0.0;          ///< sum of the arcs of the widest layer [rad]
  double removed = 0.0;          ///< by the row [m^3]
  double removal_rate = 0.0;     ///< [m^3/s]
  std::vector<Layer> layers;     ///< from the tip up, those with stock
  TurnForces forces;             ///< of the flank
  double bottom_force = 0.0;     ///< estimate, upwards [N]
  double bottom_torque = 0.0;    ///< estimate [N m]
  Cause cause = Cause::air;
  std::uint32_t flags = 0;  ///< of Flag
};

/// What a line of the program comes to.
struct Line {
  std::uint32_t line = 0;
  std::int16_t tool = -1;
  double time = 0.0;         ///< of its feed moves [s]
  double time_in_cut = 0.0;  ///< [s]
  double steps = 0.0;        ///< turns of the spindle
  double peak_xy = 0.0;      ///< [N]
  double peak_tooth = 0.0;   ///< [N]
  double torque_peak = 0.0;  ///< [N m]
  double power = 0.0;        ///< [W]
  double moment_peak = 0.0;  ///< [N m]
  double deflection = 0.0;   ///< [m]
  double peak_chip = 0.0;    ///< [m]
  double removed = 0.0;      ///< [m^3]
  Cause cause = Cause::air;
  std::array<double, 3> place{};  ///< of its largest force [m]
};

/// The largest of a quantity over the program, and where.
struct Peak {
  double value = 0.0;
  std::uint32_t line = 0;
  std::array<double, 3> place{};
  Cause cause = Cause::air;
  std::int64_t step = -1;  ///< of Step::step
  std::int16_t tool = -1;
};

struct Totals {
  double time = 0.0;          ///< all moves [s]
  double time_in_cut = 0.0;   ///< [s]
  double removed = 0.0;       ///< sum over the steps [m^3]
  double stock_before = 0.0;  ///< [m^3]
  double stock_after = 0.0;   ///< [m^3], from the swept stock itself
  std::int64_t steps = 0;
  std::int64_t distinct_turns = 0;
  Peak peak_xy, peak_tooth, torque, power, moment, deflection, chip;
};

struct Summary {
  std::vector<Line> lines;  ///< with a feed move, ascending
  Totals totals;
  std::vector<base::Warning> warnings;
  bool complete = true;  ///< false: it was stopped
};

/// Takes rows in their order, some at a time.
using Sink = std::function<void(std::span<const Step>)>;

/// @brief How many steps there are: known at once, for progress and refusals.
double step_count(const Job& job);

/// @brief Forces along a program, a step a turn of the spindle.
/// @throws std::invalid_argument where a move cannot be computed: tool without a number
Summary compute_steps(const Job& job, const Sink& sink);

/// Where a turn is asked for.
struct PlaceRequest {
  std::uint32_t line = 0;
  double fraction = 0.0;  ///< of the path of its first feed move, 0 to 1
};

/// @brief The turn with its middle at each of the places, whatever steps there are.
/// @param heights  above the tip [m]: arcs at these instead of layers (from = to); may be
///                 empty
/// @return shape (places); a place on a line without a feed move has `count` 0
std::vector<Step> steps_at(const Job& job, std::span<const PlaceRequest> places,
                           std::span<const double> heights = {});

/// @brief Forces of steps as tools with other numbers would feel them, in the stock that
/// the tools of the job leave.
/// @param steps  numbers of Step::step
/// @param tools  in place of the tool of these steps
/// @return shape (steps, tools), row-major; without force where a step cuts nothing or is
///         none (negative)
std::vector<TurnForces> forces_with(const Job& job, std::span<const std::int64_t> steps,
                                    std::span<const Tool> tools);

}  // namespace trochoid::engagement
