#pragma once

#include <trochoid/engagement/steps.h>
#include <trochoid/stock/path.h>

#include <span>
#include <vector>

namespace trochoid::engagement {

/// What a step is told apart by, beside its row.
struct StepTraits {
  std::uint32_t piece = 0;  ///< of the path
  double at = 0.0;          ///< along the path of feed moves [m]
  double R = 0.0;           ///< of the cutter [m]
  double f_h = 0.0;         ///< feed of a turn sideways [m]
  double f_a = 0.0;         ///< feed of a turn downwards [m]
  bool bottom = false;      ///< what is below the tip is in stock
  bool stock = false;       ///< there is any that decides
};

/// A kink between two feed moves that both go sideways.
struct Kink {
  double at = 0.0;     ///< along the path of feed moves [m]
  double turns = 0.0;  ///< of the spindle, when it is passed
};

/// Kinks above 15 degrees, in their order.
std::vector<Kink> kinks(const stock::Path& path);

/// Where each piece begins along the path of feed moves [m].
std::vector<double> feed_lengths(const stock::Path& path);

/// Causes and flags of the steps of a line.
void find_causes(const stock::Path& path, std::span<const Kink> kinks,
                 std::span<const StepTraits> traits, std::span<Step> steps);

/// The cause of a line: the most frequent one among its steps within 1 % of its peak.
Cause cause_of_line(std::span<const Step> steps);

}  // namespace trochoid::engagement
