#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/engagement/steps.h>

#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::engagement {

/// What a record of a program has: forces on the tool in the axes of the program, the power
/// of the spindle, or its torque.
enum class Reads { forces, power, torque };

/// As files spell it.
constexpr std::string_view name_of(Reads reads) noexcept {
  constexpr std::array<std::string_view, 3> names{"forces", "power", "torque"};
  return names[static_cast<std::size_t>(reads)];
}

/// What was recorded while a program ran.
struct Recorded {
  std::vector<double> time;                  ///< [s], ascending
  std::vector<std::array<double, 3>> value;  ///< [N]; or power [W], torque [N m], 0, 0
  std::vector<int> line;                     ///< of the program, shape of time; or none
  Reads reads = Reads::forces;
  std::vector<double> clock = {};  ///< where `time` is that of the program, its own [s]
  std::vector<double> slower = {};  ///< then, how many times as long the line took
};

/// What controls tell of where they are: the line of the text, or its N number.
enum class LineNumbers { line, block };

/// As files spell it.
constexpr std::string_view name_of(LineNumbers numbers) noexcept {
  return numbers == LineNumbers::line ? "line" : "block";
}

/// @brief The same with the times of the program, by the lines that were recorded. Feeds that
/// the machine changed do not matter then.
///
/// Samples of lines that the program does not have, and those of a second run, are left out.
/// @eq N-25 t_program = t_0 + (t - t_first)/(t_last - t_first) (t_1 - t_0) within the samples of
///          a line, t_0 to t_1 its time in the program
/// @src derived
Recorded by_lines(std::span<const Step> steps, const Recorded& record,
                  LineNumbers numbers);

/// @brief How the time of a record lies over the time of the program.
/// @eq N-23 t_record = start + stretch t_program, where the record correlates most with the
///          means of the steps, and with air before and after them
/// @src standard
struct Alignment {
  double start = 0.0;  ///< of the program, in the time of the record [s]
  double stretch = 1.0;
  double correlation = 0.0;  ///< of the mean forces of steps; 1: alike but for a factor
  double scatter = 0.0;      ///< of parts of the program about that line [s]
  double covered = 0.0;      ///< part of the feed moves that the record has
  /// The same of the whole record, with air before and after the program.
  double whole_correlation = 0.0;
  /// Another start that agrees nearly as well [s]; NaN: there is none.
  double other_start = std::numeric_limits<double>::quiet_NaN();
};

/// @brief Lay a record over a program.
/// @param steps  rows of compute_steps, in their order
/// @return nothing where nothing is cut, or the record is shorter than ten turns
std::optional<Alignment> align(std::span<const Step> steps, const Recorded& record);

/// A record with the times of its program, which the machine ran with other feeds.
struct OtherFeed {
  Recorded record;
  double start = 0.0;         ///< of the program, in the time of the record [s]
  double slower = 1.0;        ///< how many times as long the feed moves took
  bool line_by_line = false;  ///< each line has its own factor
};

/// @brief Lay a record over a program all of whose feeds were slower by one factor, from 0.4
/// to 2.5, or each line by its own where that explains clearly more.
/// @eq N-28 t_record = start + t_rapid + slower t_feed, where the means of the steps correlate
///          most
/// @src derived
/// @return nothing as of align, or where it is stopped; rapids take as long as in the program
std::optional<OtherFeed> at_other_feed(std::span<const Step> steps,
                                       const Recorded& record,
                                       const base::Stop& stop = {});

/// A record, and where it lies over its program.
struct LaidOver {
  Recorded record;
  Alignment alignment;

  /// @brief How many seconds of the record a second of the program took.
  /// @param from, to  samples, `to` behind the last
  [[nodiscard]] double stretch(std::size_t from, std::size_t to) const noexcept;
  /// When the record had a time of the program [s].
  [[nodiscard]] double clock_at(double time) const noexcept;
};

/// @brief How long a record takes to show what is cut: slow channels lag behind and show means.
/// @return so many samples as settle them [s]
double settling_time(const Recorded& record) noexcept;

/// @brief What a record should read in a step on the average, as Recorded::value.
std::array<double, 3> mean_of(const Step& step, Reads reads) noexcept;

/// What was recorded in a step.
struct StepRecord {
  bool there = false;            ///< false: the record does not have it
  double time = 0.0;             ///< of its middle in the record [s]
  double stretch = 1.0;          ///< seconds of the record for a second of the program
  std::array<double, 3> mean{};  ///< as Recorded::value
  double peak_xy = 0.0;          ///< of forces [N]
};

/// What a record reads where nothing cuts: power at each speed of the spindle, else at any.
struct Idle {
  struct AtSpeed {
    double spindle = 0.0;            ///< [rad/s]
    double air = 0.0;                ///< how long [s]
    std::array<double, 3> offset{};  ///< as Recorded::value
  };
  std::vector<AtSpeed> speeds;
  bool found = false;  ///< false: the program has too little air

  /// At the nearest of the speeds; 0 where none was found.
  [[nodiscard]] std::array<double, 3> at(double spindle) const noexcept;
  /// Whether there was air at a speed of the spindle.
  [[nodiscard]] bool has(double spindle) const noexcept;
};

/// @brief The record in each step, without what it reads where nothing cuts.
struct RecordedSteps {
  std::vector<StepRecord> steps;  ///< shape (steps)
  Idle idle;
  /// Of power and torque a speed of cuts without air, whose steps are left out [rad/s]; 0: none.
  double speed_without_air = 0.0;
};
RecordedSteps over_steps(std::span<const Step> steps, const LaidOver& over);

}  // namespace trochoid::engagement
