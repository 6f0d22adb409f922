#pragma once

#include <trochoid/geometry/arcs.h>
#include <trochoid/stock/swept.h>

#include <vector>

namespace trochoid::engagement {

/// How the stock around a cutter is looked at.
struct ContactQuery {
  const stock::Wall* wall = nullptr;  ///< of the cutter
  double feed = 0.0;                  ///< of a step, along the path [m]
  double turns = 1.0;                 ///< of the spindle in it
  bool bottom = true;                 ///< whether what is below the tip is asked for
  bool layers = true;                 ///< false: one look at each of `heights`
  std::vector<double> heights = {};   ///< above the tip [m]
};

/// @brief Where a cutter meets the stock at a moment, and what it takes in a step.
struct Contact {
  /// With stock, from the tip up: of a flat cutter within [0, pi], of others on the whole
  /// circle.
  std::vector<geometry::ArcLayer> layers;
  double flank_volume = 0.0;   ///< of the step [m^3]
  double bottom_volume = 0.0;  ///< of the step [m^3]
  double bottom_length =
      0.0;  ///< mean over a turn of the stock on a ray below the tip [m]
  double bottom_moment = 0.0;  ///< mean of its first moment [m^2]
};

/// @brief Stock of a turn ago around the cutter at a place on its path.
/// @eq N-2  the stock of a step is what stands a turn of the spindle before its middle
/// @src derived
/// @param index  of the piece in swept.path()
/// @param u      place on it, 0 to 1
/// @param query  of a piece that does not go sideways only the bottom counts
Contact contact(const stock::Swept& swept, std::uint32_t index, double u,
                const ContactQuery& query);

/// @brief Sums over the arcs of a layer.
struct ArcSum {
  double width = 0.0;  ///< R (cos from - cos to) in front, of stock across the feed [m]
  double angle = 0.0;  ///< [rad]
};
ArcSum sum_of(const geometry::ArcLayer& layer, double R) noexcept;

}  // namespace trochoid::engagement
