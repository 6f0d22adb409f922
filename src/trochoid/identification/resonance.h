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

/// @brief Whether it is noise alone that a fit leaves; false where the runs are too short to
/// tell. What does not repeat turn by turn no cut and no reading of the channels explains.
bool leaves_noise_alone(std::span<const Run> runs, const Fit& fit);

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

/// @brief Options by which a given response of the dynamometer may be off: in each axis in
/// which it has a resonance, frequency and damping of that are found with the rest.
///
/// @eq I-25 H_qj(omega) h(omega; omega_n, zeta)/h(omega; omega_0, zeta_0), h the oscillator of
///          I-17, omega_0 and zeta_0 those of the given H_qq
/// @param options  with the response of each run
/// @return nothing where it has no resonance within the harmonics of the runs
std::optional<Options> with_scaled_response(std::span<const Run> runs, Options options);

}  // namespace trochoid::identification
