#pragma once

#include <trochoid/base/command.h>
#include <trochoid/cases/case.h>

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

/// @brief What a command is going to take, judged by the keys of its case and the sizes of
/// its files.
std::vector<Work> work_of(base::Command command, const cases::Case& given);

/// @brief Why the parts together are too much, and which value would do.
/// @return one sentence or two; empty: they are not
std::string too_much(std::span<const Work> parts);

}  // namespace trochoid::run
