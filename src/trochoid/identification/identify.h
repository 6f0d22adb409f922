#pragma once

#include <trochoid/force/forces.h>
#include <trochoid/identification/fit.h>

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief Fit coefficients, runout and phase to all runs of one tool.
///
/// @eq  I-1 {F} = [D]{K} at given runout and phase
/// @eq  I-19 {F}_r = [D]_r(p) {K}_g(r): runs of one group share coefficients, all runs
///      runout and exponents
/// @eq  I-2 se(K_c) = sqrt(RSS/(n - 6) ([D]^T [D])^-1_cc) at fixed runout
/// @eq  I-3 min over p of min over K of |[D(p)]{K} - {F}|^2
/// @eq  I-4 J = [[D] | d[D]/dp {K}], cov = RSS/(n - dim K - dim p) (J^T J)^-1
/// @eq  I-5 RMS = sqrt(mean over samples of |dF|^2)
/// @eq  I-7 {F_c} = [D]_c {K} + a_c + b_c (t - mean t)/(t_last - t_first)
/// @eq  I-8 value +- t_0.975(n - dim K - dim p) se
/// @eq  I-14, I-15 standard errors by the spectrum of what is left, and by how far the runs
///      agree; I-13 those of records too short for a spectrum
/// @eq  I-9 nothing is explained where u > sqrt(0.9) and r > 0.3
/// @src [riviere2009] eq. 20 to 22, section 3.3; I-3 [golub1973]; I-4, I-8 standard
///
/// @param setup  tool, given runout (start or fixed), chip lookback, edge length; its
///               `cut` and `chip.model` are replaced by those of run and options
/// @param law    the kind of law and, for Power, its exponents (start or fixed)
/// @param runs   at least one
/// @throws std::invalid_argument when a run has not one force for each angle
Fit identify(const force::Setup& setup, const force::Law& law,
             std::span<const Run> runs, const Options& options);

/// @brief RMS over the offset of tooth 2, with the coefficients fitted anew for each.
/// @param fit of the same setup, law and runs: its options, phase and other offsets
/// @param offsets  of tooth 2 [m]
/// @return [N], shape of offsets; empty without a phase to use or a second tooth
std::vector<double> sweep(const force::Setup& setup, const force::Law& law,
                          std::span<const Run> runs, const Fit& fit,
                          std::span<const double> offsets);

/// @brief A record beside forces that are known but for the angle at which it begins.
struct PhaseMatch {
  double phase = 0.0;                    ///< true angle minus recorded angle [rad]
  std::vector<force::Vector3> computed;  ///< [N], shape of the record
  force::Vector3 rms_axis{};             ///< of the difference [N]
  double rms = 0.0;                      ///< [N], I-5
  double measured_rms = 0.0;             ///< [N]
};

/// @brief Compute the forces of a record, coefficients and runout as given.
/// @param phase      [rad]; absent: the one with the smallest difference
/// @param tolerance  of the force, relative to its peak
PhaseMatch match_phase(const force::Setup& setup, const force::Law& law, const Run& run,
                       const std::optional<double>& phase, double tolerance);

}  // namespace trochoid::identification
