#pragma once

#include <trochoid/identification/identify.h>

#include <optional>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief One way to look at records of a dynamometer that is not rigid.
struct View {
  int band_harmonics = 0;       ///< 0: all
  bool resonant = false;        ///< the resonances of the dynamometer are in the model
  std::optional<Estimate> K_t;  ///< tangential cutting coefficient, SI
  double unexplained = 0.0;     ///< part of the whole force (rms), from 0 to 1
};

/// @brief A fit, and what other views of the same records say.
struct Viewed {
  Fit fit;
  /// The first is that of `fit`; empty: what the fit leaves does not repeat turn by turn,
  /// so that no other view was asked for.
  std::vector<View> views;
};

/// @brief Fit with the view that the records themselves ask for.
///
/// All harmonics, where what the fit leaves is noise. Where it repeats turn by turn: with
/// the resonances of the dynamometer in the model (I-17), where they explain it; else all
/// harmonics with the intervals that this deserves (I-14). A band narrower than the model
/// can use hides a bias that no interval shows, so bands are looked at for comparison only.
/// @param options  without band or response
Viewed fit_as_seen(const force::Setup& setup, const force::Law& law,
                   std::span<const Run> runs, const Options& options);

}  // namespace trochoid::identification
