#pragma once

#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// What a command is going to take, known from its case before it starts.
namespace trochoid::run {

/// @brief The key of a case by which work grows.
struct WorkKey {
  std::string name;     ///< for example `sampling.samples_per_rev`
  double value = 0.0;   ///< as it stands in the file
  std::string of = {};  ///< what is counted, ` values`; empty: the value itself
  /// Work grows with this power of the value; 0: no other value would help.
  double power = 1.0;
};

/// @brief One part of the work of a command.
struct Work {
  std::string what;          ///< for example `angles of the forces`
  double count = 0.0;        ///< how many of them
  double evaluations = 0.0;  ///< each as long as a chip and its force at an edge point
  double bytes = 0.0;        ///< of memory that it needs at once
  WorkKey key;
};

/// More is done only when it is asked for once again.
inline constexpr double most_evaluations = 1e9;
inline constexpr double most_bytes = 1e9;
/// Of one core of a machine of 2023; good to a factor of 3 (docs/performance.md).
inline constexpr double seconds_per_evaluation = 1e-7;

/// @brief Why the parts together are too much, and which value would do.
/// @return one sentence or two; empty: they are not
std::string too_much(std::span<const Work> parts);

/// @brief Evaluations of the force on all teeth at one angle of the spindle.
double evaluations_per_angle(const force::Setup& setup, const force::Law& law);

/// @brief Of these, what the edge near the axis takes, or all edges under a power law where
/// the tool has such a tip: of a turn no more than about `most_angles_at_tip` are computed.
double evaluations_at_tip(const force::Setup& setup, const force::Law& law);
inline constexpr double most_angles_at_tip = 7000;

/// @brief Size of a file [bytes]; 0 where there is none: reading it tells that better.
double size_of_file(const std::filesystem::path& file);

}  // namespace trochoid::run
