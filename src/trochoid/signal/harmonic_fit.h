#pragma once

#include <trochoid/signal/record.h>

#include <complex>
#include <span>
#include <vector>

/// Harmonics of an unknown frequency in samples at known times.
namespace trochoid::signal {

/// Samples of three channels about a common middle of time.
struct TimedSamples {
  std::vector<double> t;                       ///< [s], from the middle, shape (n)
  std::array<std::vector<double>, 3> channel;  ///< less their mean [N], shape (n)
};

/// @brief Orders -K..K of a set of positive orders, with 0.
std::vector<int> two_sided(std::span<const int> orders);

/// Least-squares fit of the mean and the harmonics of one frequency.
struct HarmonicFit {
  double Omega = 0.0;
  /// Amplitudes of each channel at the two-sided orders, shape (2 K + 1) each.
  std::array<std::vector<std::complex<double>>, 3> c;
  /// Part of the derivative to Omega that the amplitudes could take over.
  std::array<std::vector<std::complex<double>>, 3> w;
  double step = 0.0;       ///< Gauss-Newton step of Omega
  double curvature = 0.0;  ///< sum of the squared derivative to Omega, amplitudes free
  double rss = 0.0;        ///< sum of the squared residuals [N^2]
  bool ok = false;         ///< the amplitudes are determined
};

HarmonicFit fit_harmonics(const TimedSamples& samples, std::span<const int> two_sided,
                          double Omega);

/// @brief Sums of residual times derivative to Omega over equal parts of the samples.
/// @return shape (parts)
std::vector<double> scores(const TimedSamples& samples, std::span<const int> two_sided,
                           const HarmonicFit& fit, int parts);

}  // namespace trochoid::signal
