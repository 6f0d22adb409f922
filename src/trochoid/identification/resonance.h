#pragma once

#include <trochoid/identification/identify.h>
#include <trochoid/identification/response.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief The resonances that what a fit leaves speaks of, where they explain enough.
///
/// @eq I-17 min over omega_n, zeta of sum over runs and harmonics
///          |M_k - H(k Omega) F_k|^2, H = 1/(1 - x^2 + 2 i zeta x), x = k Omega/omega_n
/// @param fitted    force at the samples of each run, as Fit::fitted
/// @param response  that `fitted` holds already, one a run; empty: none
Resonances find_resonances(std::span<const Run> runs,
                           std::span<const std::vector<std::array<double, 3>>> fitted,
                           std::span<const Response> response);

/// @brief What a dynamometer with these resonances reads.
/// @param Omega    spindle speed [rad/s]
/// @param highest  harmonic
Response response_of(const Resonances& resonances, double Omega, int highest);

/// @brief The highest harmonic that a run resolves, and no more than is of use.
int resolved_harmonics(const Run& run);

/// @brief Whether what a fit leaves repeats turn by turn, well beyond what scatter makes of
/// it; false where the runs are too short to tell.
bool repeats(std::span<const Run> runs, const Fit& fit);

/// @brief Fit force and dynamometer in turn, from a fit of a rigid one.
/// @param rigid  of the same setup, law, runs and options
/// @return nothing where no resonance is seen, or the fit is not better for it; worth asking where
///         what the rigid fit leaves repeats
std::optional<Fit> fit_through_resonance(const force::Setup& setup,
                                         const force::Law& law,
                                         std::span<const Run> runs, const Fit& rigid);

}  // namespace trochoid::identification
