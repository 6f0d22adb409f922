#pragma once

#include <trochoid/surface/trace_fit.h>

#include <optional>
#include <vector>

namespace trochoid::surface {

/// @brief What is asked of a finish.
struct FinishPlan {
  std::vector<TraceLine> lines;  ///< on which Ra counts, the largest of them
  std::optional<double> cutoff;  ///< of a Gaussian filter [m]
  std::vector<double> feeds;     ///< per tooth [m], ascending
  double within = 0.0;           ///< another set of inserts lies within so much [m]
  std::optional<double> limit;   ///< of Ra [m]
};

/// @brief Ra at a feed, or the largest feeds that keep a limit [m].
struct OfSets {
  std::optional<double> as_is;   ///< of the teeth as they are
  std::optional<double> within;  ///< of 95 of 100 sets of inserts within a tolerance
  std::optional<double> alike;  ///< of teeth at one depth, and a spindle that runs true
};

struct FinishOfFeed {
  double f_z = 0.0;  ///< [m]
  OfSets Ra;         ///< absent: a tooth alone would leave material between its marks
};

struct PlannedFinish {
  std::vector<FinishOfFeed> feeds;
  OfSets largest;  ///< feed per tooth up to which Ra keeps the limit
};

/// @brief Which feed keeps Ra below a limit, with the runout of the setup and without.
///
/// On the floor axial offsets of other inserts are drawn, on the wall radial ones, each even
/// within the tolerance. The same sets are taken at each feed.
///
/// @eq W-9 Ra of 200 sets of offsets, sorted: the 190th
/// @src derived
/// @param setup  whose feed is not used
PlannedFinish plan_finish(const force::Setup& setup, const FinishPlan& plan);

}  // namespace trochoid::surface
