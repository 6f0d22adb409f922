#pragma once

#include <trochoid/structure/modes_fit.h>

#include <optional>

namespace trochoid::structure {

/// A delay between force and response.
struct Delay {
  Known time;  ///< by which the response comes after the force [s]
  /// By how much the mass of the lightest mode would be wrong with it, as a part.
  double mass_error = 0.0;
};

/// A response whose channels were not recorded at the same time, and its modes.
struct DelayedFit {
  ModesFit fit;  ///< of the response with the delay taken out
  Delay delay;
  double evidence = 0.0;  ///< criterion of the fit without a delay less that with one
};

/// @brief Whether a delay between force and response explains what modes leave.
///
/// Looked for only where what is left turns with the frequency as a delay does, by at least
/// a half of its phase.
/// @eq M-36 H(omega) = exp(-i omega tau) H_modes(omega); tau from the phase that the modes
///          leave, -omega tau, weighted by |H|^2, the modes fitted anew until it stays
/// @src derived
/// @param response  as measured
/// @param fit       of it, with the same options
/// @return none: there is none, or it explains less than very strong evidence, or no more
///         than complex modes do
std::optional<DelayedFit> delayed_fit(const FrequencyResponse& response,
                                      const ModesOptions& options, const ModesFit& fit);

/// @brief A response as it would be with both channels recorded at the same moment.
FrequencyResponse without_delay(FrequencyResponse response, double delay);

}  // namespace trochoid::structure
