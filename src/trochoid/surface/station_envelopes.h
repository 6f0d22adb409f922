#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/pass.h>
#include <trochoid/surface/stations.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// @brief The envelope (E-9) at one height, at all stations along the wall together.
///
/// Where the teeth pass is the same at each of them; only the deflection differs.
class StationEnvelopes {
 public:
  /// @param stations, moments  must live as long as this; moments of with_coefficients
  /// @param node, level        the height, as of the stations
  StationEnvelopes(const Stations& stations, const numerics::PeriodicPieces& moments,
                   const force::Setup& setup, std::size_t node, Level level);

  /// @brief The profile over a turn of the feed.
  /// @param count  points of it, from 0 on
  /// @return shape (stations, count) [m]
  [[nodiscard]] std::vector<double> profiles(std::size_t count) const;

 private:
  const Stations& stations_;
  const numerics::PeriodicPieces& moments_;
  Side side_;
  double R_ = 0.0;     ///< [m]
  double feed_ = 0.0;  ///< of a turn [m]
  std::vector<EdgePlace> teeth_;
  std::vector<double> rows_;    ///< sigma G_q [m/N], shape (stations, basis points)
  std::vector<double> lowest_;  ///< what delta never falls below [m], shape (stations)
};

}  // namespace trochoid::surface
