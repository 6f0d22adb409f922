#pragma once

#include <trochoid/force/setup.h>

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::identification {

/// One run of the tool, ready for the fit: force on the tool against the spindle angle.
struct Run {
  geometry::Cut cut;
  std::vector<double> angle;                 ///< recorded angle [rad], shape (n)
  std::vector<std::array<double, 3>> force;  ///< on the tool [N], shape (n)
};

enum class RunoutUnknowns { none, fixed, offsets, eccentricity };

/// What is to be found, and how.
struct Options {
  chip::Model chip_model = chip::Model::trochoidal;
  RunoutUnknowns runout = RunoutUnknowns::offsets;
  std::optional<double> phase;  ///< [rad]; absent: free, one for each run
  int band_harmonics = 0;       ///< 0: all; n: mean and spindle harmonics 1..n only
  bool fit_channel_offsets = false;  ///< one constant and one slope a channel and run
};

/// An estimate with its standard error and 95 % interval; absent: not identifiable.
struct Estimate {
  double value = 0.0;
  double se = 0.0;
  double low = 0.0;
  double high = 0.0;
};

/// @brief Result of one fit. Coefficients in SI, in the order of force::coefficients.
struct Fit {
  bool ok = false;
  std::string message;  ///< when not ok, why there is no answer
  chip::ChipModel chip;
  std::vector<std::optional<Estimate>> coefficients;
  geometry::Runout runout;
  std::vector<std::optional<double>> radial_offsets_se;  ///< [m], shape (teeth)
  std::optional<double> eccentricity_se;                 ///< [m]
  std::optional<double> angle_se;                        ///< [rad]
  std::vector<double> phase;                             ///< [rad], one a run
  std::vector<std::optional<double>> phase_se;           ///< [rad]
  double rms = 0.0;                                      ///< [N]
  std::array<double, 3> rms_axis{};                      ///< [N]
  double condition = 0.0;                                ///< of [D], unit-norm columns
  int rank = 0;
  /// Unidentifiable quantities, by name of the summary, and why.
  std::vector<std::pair<std::string, std::string>> unidentifiable;
  /// Correlation of neighbouring residuals; well above 0, the standard errors are too small.
  double residual_correlation = 0.0;
  /// Fitted force of each run, shape (n).
  std::vector<std::vector<std::array<double, 3>>> fitted;
};

/// @brief Fit coefficients, runout and phase to all runs of one tool and material.
/// @param setup  tool, given runout (start or fixed), chip lookback, edge length; its
///               `cut` and `chip.model` are replaced by those of run and options
/// @param law    the kind of law and, for Power, its exponents
Fit identify(const force::Setup& setup, const force::Law& law, std::span<const Run> runs,
             const Options& options);

}  // namespace trochoid::identification
