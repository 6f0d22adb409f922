#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/pass.h>
#include <trochoid/surface/stations.h>

#include <span>
#include <vector>

namespace trochoid::surface {

/// Moments of with_coefficients over the spindle angle: the same at all stations, or of
/// each its own.
struct StationMoments {
  StationMoments(const Stations& stations,
                 std::span<const numerics::PeriodicPieces> moments);

  std::span<const numerics::PeriodicPieces> pieces;
  double most = 0.0;  ///< no deflection is larger [m]
};

/// @brief The envelope (E-9) at one height, at all stations along the wall together.
///
/// Where the teeth pass is the same at each of them; only the deflection differs.
class StationEnvelopes {
 public:
  /// @param node, level        the height, as of the stations
  StationEnvelopes(const Stations& stations, const StationMoments& moments,
                   const force::Setup& setup, std::size_t node, Level level);

  /// @brief The profile over a turn of the feed.
  /// @param count  points of it, from 0 on
  /// @return shape (stations, count) [m]
  [[nodiscard]] std::vector<double> profiles(std::size_t count) const;

 private:
  using Part = numerics::PeriodicPieces::Part;
  /// Spindle angles at which a pass may make the wall.
  /// @param most  of StationMoments
  [[nodiscard]] std::vector<Part> parts_that_count(double most) const;

  std::size_t count_ = 0;  ///< of stations
  Side side_;
  double R_ = 0.0;     ///< [m]
  double feed_ = 0.0;  ///< of a turn [m]
  std::vector<EdgePlace> teeth_;
  /// delta(phi) of all stations [m], or of each its own.
  std::vector<numerics::PeriodicPieces> deflections_;
};

}  // namespace trochoid::surface
