#pragma once

#include <trochoid/base/stop.h>
#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/force_harmonics.h>
#include <trochoid/dynamics/point_response.h>

#include <functional>
#include <optional>
#include <span>
#include <vector>

/// The limit depth from a measured response, without modes.
namespace trochoid::dynamics {

/// Where a cut begins to chatter, as its frequency response says.
struct FrequencyLimit {
  double Omega = 0.0;              ///< [rad/s]
  double depth = 0.0;              ///< [m]
  double chatter_frequency = 0.0;  ///< [Hz]
};

/// What of the periodic force is kept.
struct FrequencyOptions {
  /// Harmonics of the tooth passing frequency kept on each side of the chatter
  /// frequency and of its mirror image; 0: the mean force only, the zeroth order
  /// solution.
  int harmonics = 0;
  double tolerance = 1e-4;  ///< of the depth, relative; positive
  base::Stop stop;          ///< speeds that have not begun by then are left out
};

/// A vibration on the edge of growth.
struct Onset {
  double factor = 0.0;  ///< of all forces, at which it neither grows nor fades
  double omega = 0.0;   ///< its frequency [rad/s]
};

/// @brief The least factor of the forces at which a vibration stays as it is.
///
/// The vibration is e^(i omega t) times harmonics of the period P of the force:
/// @eq  D-22 q_k = G(omega_k) sum over l of (A_0^(k-l) - sum over d of A_d^(k-l)
///           e^(-i omega_l d / Omega)) q_l,  omega_k = omega + 2 pi k Omega / P,
///           k and l from -h to h, and from m - h to m + h, where m is next to
///           -2 omega P / (2 pi Omega): around -omega, where the point is as soft
/// @eq  D-23 a real positive eigenvalue lambda(omega) of that matrix: the forces times
///           1 / lambda keep the vibration; the least of all omega counts
/// @src h = 0: [altintas1995]; h > 0: [budak1998], [merdol2004]; here for any number of
///      delays, at a given speed
/// @param forces  with harmonics up to 2 h at least; the mirror image counts where they
///                reach it
/// @param h       0: the mean force
/// @param most    greatest factor looked for
/// @return nothing where there is none up to that
std::optional<Onset> onset(const ForceHarmonics& forces, const PointResponse& point,
                           double Omega, int h, double most);

/// @brief The least axial depth of an onset.
///
/// @eq  D-24 the factor of D-23 is 1 at that depth; it is above 1 at all depths looked
///           at below
/// @src derived; where the force is proportional to the depth the factor is the depth
/// @param depth  to look at [m], ascending, positive
/// @return nothing where all of them are stable
std::optional<FrequencyLimit> frequency_limit(const DirectionalModel& model,
                                              const PointResponse& point, double Omega,
                                              std::span<const double> depth,
                                              const FrequencyOptions& options);

/// Told how much is done, from 0 to 1; by one thread at a time; may be empty.
using FrequencyProgress = std::function<void(double share)>;

/// @brief The limit over the speed; speeds without a limit are left out.
/// @param Omega  [rad/s], ascending
// six parameters: both axes of the diagram, and who is told how far it is
std::vector<FrequencyLimit> frequency_limits(const DirectionalModel& model,
                                             const PointResponse& point,
                                             std::span<const double> Omega,
                                             std::span<const double> depth,
                                             const FrequencyOptions& options,
                                             const FrequencyProgress& progress);

}  // namespace trochoid::dynamics
