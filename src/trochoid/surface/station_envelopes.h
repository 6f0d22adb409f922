#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/pass.h>
#include <trochoid/surface/stations.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// Moments of with_coefficients over the spindle angle: the same at all stations, or of
/// each its own.
using StationMoments = std::span<const numerics::PeriodicPieces>;

/// @brief The envelope (E-9) at one height, at all stations along the wall together.
///
/// Where the teeth pass is the same at each of them; only the deflection differs.
class StationEnvelopes {
 public:
  /// @param stations, moments  must live as long as this
  /// @param node, level        the height, as of the stations
  StationEnvelopes(const Stations& stations, StationMoments moments,
                   const force::Setup& setup, std::size_t node, Level level);

  /// @brief The profile over a turn of the feed.
  /// @param count  points of it, from 0 on
  /// @return shape (stations, count) [m]
  [[nodiscard]] std::vector<double> profiles(std::size_t count) const;

 private:
  const Stations& stations_;
  StationMoments moments_;
  Side side_;
  double R_ = 0.0;     ///< [m]
  double feed_ = 0.0;  ///< of a turn [m]
  std::vector<EdgePlace> teeth_;
  std::vector<double> rows_;    ///< sigma G_q [m/N], shape (stations, basis points)
  std::vector<double> lowest_;  ///< what delta never falls below [m], shape (stations)
};

}  // namespace trochoid::surface
