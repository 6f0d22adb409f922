#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/identification/response.h>

#include <optional>
#include <span>

namespace trochoid::identification {

/// @brief The highest harmonic that a run resolves, and no more than is of use.
int resolved_harmonics(const Run& run);

/// @brief Whether what a fit leaves repeats turn by turn, well beyond what scatter makes of
/// it; false where the runs are too short to tell.
bool repeats(std::span<const Run> runs, const Fit& fit);

/// @brief Fit force and dynamometer together, from a fit of a rigid one.
///
/// One axis after the other is let ring, that first which explains most, as long as it explains
/// more than chance would; coefficients, runout and phases are free while it is tried, for
/// a rigid fit has taken the amplification over. Then all are fitted together to all
/// harmonics that the runs resolve.
/// @eq I-17 min over K, p, omega_n and zeta of each axis of sum over runs and harmonics
///          |M_k - H(k Omega) F_k|^2
/// @param rigid  of the same setup, law, runs and options
/// @return nothing where no resonance is seen; worth asking where what the rigid fit leaves
///         repeats
std::optional<Fit> fit_through_resonance(const force::Setup& setup,
                                         const force::Law& law,
                                         std::span<const Run> runs, const Fit& rigid);

}  // namespace trochoid::identification
