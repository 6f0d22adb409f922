#pragma once

#include <trochoid/signal/passes.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::signal {

/// A drift along a curve.
struct CurvedDrift {
  /// Of each channel: Legendre polynomials over the record, from order 0 on [N]; empty: a
  /// straight line describes it as well.
  std::array<std::vector<double>, 3> terms;
  std::array<double, 3> bend{};  ///< farthest from a straight line in the cut [N]
  /// Standard error of the constant that is removed from the cut [N]; 0: no curve, no air.
  std::array<double, 3> offset_se{};
};

/// @brief Drift of each channel from the means of its turns, in air and in a steady cut:
/// there the mean force does not move, so what moves is drift.
///
/// @eq S-12 (a, F) = argmin sum_b ((m_b - d(x_b) - F [b in the cut])/s_b)^2,
///          d = sum a_n P_n(x)
/// @src derived
///
/// The order is the one beyond which the fit gains nothing. A force that grows with wear
/// moves, too: there, and where the means of a steady cut follow no such curve, none is
/// found. Without idle turns a_0 is left out, as nothing tells it from F.
/// @param angle  [rad], shape (n)
/// @param idle   where nothing cuts, ascending; a straight line may be out of it
/// @param cut    steady
CurvedDrift curved_drift(const std::array<std::vector<double>, 3>& channels,
                         std::span<const double> angle, std::span<const Part> idle,
                         const Part& cut);

/// What was taken out of the channels of a record.
struct RemovedDrift {
  bool offset = false;                ///< there was a place where nothing cuts
  std::array<double, 3> offset_se{};  ///< standard error of what is out of the cut [N]
  std::array<double, 3> bend{};       ///< as of CurvedDrift
};

/// @brief Take out of the channels what they read where nothing cuts (idle_drift), and what
/// then drifts along a curve.
RemovedDrift remove_drift(std::array<std::vector<double>, 3>& channels,
                          std::span<const double> angle, std::span<const Part> idle,
                          const Part& cut);

/// @brief The same of any number of channels, three at a time.
/// @return offset_se of RemovedDrift, shape (channels)
std::vector<double> remove_drift(std::vector<std::vector<double>>& channels,
                                 std::span<const double> angle,
                                 std::span<const Part> idle, const Part& cut);

}  // namespace trochoid::signal
