#pragma once

#include <trochoid/engagement/steps.h>

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::engagement {

/// Forces on the tool in the axes of the program, recorded while it ran.
struct Recorded {
  std::vector<double> time;                  ///< [s], ascending
  std::vector<std::array<double, 3>> force;  ///< [N], shape of time
  std::vector<int> line;                     ///< of the program, shape of time; or none
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
/// @eq N-23 t_record = start + stretch t_program, where the mean forces of the steps
///          correlate most
/// @src standard
struct Alignment {
  double start = 0.0;  ///< of the program, in the time of the record [s]
  double stretch = 1.0;
  double correlation = 0.0;  ///< of the mean forces of steps; 1: alike but for a factor
  double scatter = 0.0;      ///< of parts of the program about that line [s]
};

/// @brief Lay a record over a program.
/// @param steps  rows of compute_steps, in their order
/// @return nothing where nothing is cut, or the record is shorter than ten turns
std::optional<Alignment> align(std::span<const Step> steps, const Recorded& record);

/// What was recorded in a step.
struct StepRecord {
  bool there = false;            ///< false: the record does not have it
  std::array<double, 3> mean{};  ///< [N]
  double peak_xy = 0.0;          ///< [N]
};

/// What a channel reads where nothing cuts.
struct Idle {
  std::array<double, 3> offset{};  ///< [N]
  bool found = false;              ///< false: the program has too little air
};

/// @brief The record in each step, without what it reads where nothing cuts.
struct RecordedSteps {
  std::vector<StepRecord> steps;  ///< shape (steps)
  Idle idle;
};
RecordedSteps over_steps(std::span<const Step> steps, const Recorded& record,
                         const Alignment& alignment);

/// @brief Coefficients of one tool from the mean forces of the steps of a program.
///
/// Linear in the coefficients, so no start is needed. Runout hardly changes means and stays
/// as it is. Errors are those of blocks of steps: what is wrong with one step is wrong with
/// its neighbours.
/// @eq N-24 K = argmin sum |F_measured - D K - c|^2 over steps, D the means for a unit of
///          each coefficient, c the offsets where no air tells them;
///          Cov K = G (sum over blocks of s s') G, G = (D'D)^-1, s = sum over a block D'r
/// @src standard
struct MeanFit {
  std::vector<double> K;                  ///< in the order of force::coefficients
  std::vector<std::optional<double>> se;  ///< nothing: not told, K is that of the tool
  std::size_t steps = 0;                  ///< that were used
  double factor = 2.0;                    ///< of the 95 % interval
  double rms = 0.0;                       ///< that is left [N]
};

/// @param tool  of whose steps, in Job::tools
/// @return nothing where too few steps are steady
std::optional<MeanFit> fit_means(const Job& job, std::span<const Step> steps,
                                 const RecordedSteps& recorded, std::size_t tool);

}  // namespace trochoid::engagement
