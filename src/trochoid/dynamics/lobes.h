#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/dynamics/system.h>

#include <complex>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// Told how much of a diagram is done, from 0 to 1;
/// by one thread at a time; may be empty.
using LobeProgress = std::function<void(double share)>;

/// Who looks at the work on a diagram.
struct LobeWatch {
  LobeProgress progress;
  base::Stop stop;  ///< speeds that have not begun by then are left out
};

/// How well the multipliers of a diagram are known: of |mu|, relative where it is
/// above 1.
struct LobeAccuracy {
  double near = 1e-5;  ///< within a tenth of the limit |mu| = 1
  double far = 1e-3;   ///< elsewhere
};

/// Multipliers over speed and depth.
struct LobeGrid {
  std::vector<double> Omega;                     ///< [rad/s], ascending
  std::vector<double> depth;                     ///< [m], ascending
  std::vector<std::complex<double>> multiplier;  ///< shape (speeds, depths)
  /// The cut at each depth; empty where it is proportional to the depth.
  std::vector<Directional> at_depth = {};
};

/// @brief Multipliers on a grid, at each speed with as many nodes as the shallowest cut
/// needs for `far` and the deepest for ten times that; near the limit with those that
/// the first cut near it needs. Speeds far apart come first: what is left out in haste
/// lies between others.
LobeGrid lobe_grid(const DirectionalModel& model, const System& system,
                   std::span<const double> Omega, std::span<const double> depth,
                   const LobeAccuracy& accuracy, const LobeWatch& watch);

/// Least axial depth at which a cut becomes unstable.
struct Limit {
  double Omega = 0.0;                 ///< [rad/s]
  double depth = 0.0;                 ///< [m]
  std::complex<double> multiplier{};  ///< there
  double factor = 1.0;                ///< of the nodes that were enough
  double error = 0.0;                 ///< of |mu|, estimated; 0: not estimated
};

/// @brief The least depth with |mu| = 1 among depths looked at.
///
/// @eq D-13 |mu(a_p)| = 1, stable at every depth looked at below
/// @src definition
/// @param depth      depths to look at [m], ascending, positive; a range of unstable
///                   depths that lies between two of them is not seen
/// @param tolerance  of the depth, relative
/// @return absent where all of them are stable
std::optional<Limit> limit_depth(const DirectionalModel& model, const System& system,
                                 double Omega, std::span<const double> depth,
                                 double tolerance);

/// @brief The limit over the speed, with further speeds where it bends: there searched from the
/// lower of the limits on both sides.
/// @return ascending in Omega; speeds without a limit are left out
std::vector<Limit> limit_curve(const DirectionalModel& model, const System& system,
                               const LobeGrid& grid, double tolerance,
                               const LobeWatch& watch);

}  // namespace trochoid::dynamics
