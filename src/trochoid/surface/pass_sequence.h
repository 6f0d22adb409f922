#pragma once

#include <trochoid/surface/error_map.h>

#include <optional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// One of several passes over a wall.
struct PassCut {
  double a_e = 0.0;    ///< nominal radial depth [m]; 0: a spring pass
  double f_z = 0.0;    ///< feed per tooth [m]
  double below = 0.0;  ///< of its top below the free edge [m]
};

/// What a pass found and what it left.
struct PassOutcome {
  PassCut cut;
  double thickness_before = 0.0;  ///< of the wall where it is cut; 0: rigid [m]
  double thickness_after = 0.0;   ///< the error that was left included [m]
  MeanAndExtremes radial_depth;   ///< over the heights, with what was left [m]
  MeanAndExtremes error;          ///< over the heights [m]
  MeanAndExtremes F_normal;       ///< over the turn [N]
  bool without_feedback = false;  ///< too little bends for a steady state to be found
};

struct PassSequence {
  std::vector<PassOutcome> passes;
  ErrorMap map;  ///< of the last pass, or of the one that has no steady state
};

/// What passes are made with.
struct PassBodies {
  std::optional<structure::Cantilever> cutter;
  std::optional<structure::Plate> wall;  ///< before the first pass
};

/// @brief Passes one after the other, each over the wall that the last one left.
///
/// The stock of a pass is its radial depth and the mean error along the feed that the
/// pass before left at that height; the ripple of that error along the feed is left out.
/// During a pass the wall is as it was before it: as thick as given where no pass has
/// cut yet, else as thick as the last one there left it in the mean.
///
/// Passes over the same level follow one another there; levels must not overlap.
///
/// A pass that hardly touches may have no steady state that numbers can settle; where
/// less than 0.1 um bends without feedback, that is taken.
///
/// @eq E-41 e_k(x, h) = min(e(x, h), a_e + left_k(h)), left_k+1(h) = mean over x of e_k;
///          t_k+1 = t_k - a_e,k - mean of left_k + mean of left_k+1
/// @param setting  its bodies and engagement are replaced, pass by pass
/// @throws std::invalid_argument for quasi_static, which leaves no surface, and for levels
/// that overlap in part
PassSequence pass_sequence(const Setting& setting, const MapOptions& options,
                           std::span<const PassCut> cuts, const PassBodies& bodies);

}  // namespace trochoid::surface
