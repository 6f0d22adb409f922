#pragma once

#include <trochoid/engagement/contact.h>
#include <trochoid/engagement/steps.h>
#include <trochoid/force/setup.h>

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace trochoid::engagement {

/// A turn of a tool in the stock, apart from where its feed goes.
struct Turn {
  std::int16_t tool = 0;
  double f_z = 0.0;   ///< sideways [m]
  double fall = 0.0;  ///< feed of a turn downwards, of a cutter that is not flat [m]
  double curvature = 0.0;  ///< of the path [1/m]
  std::vector<geometry::ArcLayer> layers;
};

/// Whether a turn has a feed that makes chips.
inline bool feeds(const Turn& turn) noexcept {
  return turn.f_z > 0 || turn.fall > 0;
}

/// @brief Forces of a turn, feed along +x.
struct TurnLoads {
  struct InPlane {
    double x = 0.0;
    double y = 0.0;
  };
  TurnForces forces;          ///< mean and peak of x and y are those of feed along +x
  std::vector<InPlane> hull;  ///< corners of the curve of F_x, F_y over the turn [N]
};

/// @brief Whether forces of a cutter have a closed form over the height: a flat end mill
/// of constant lead whose teeth are alike but for runout across the axis.
bool is_plain(const Tool& tool) noexcept;

/// @brief An angle that is surely past the last chip behind its own wall, at 0 or 180
/// degrees, where the turn before has left a cusp [rad].
///
/// Twice that of N-30, and as much as the path turns: the marks of the teeth end the chip
/// before (C-7).
/// @eq N-30  the cusp ends at sin(theta_c) = f/2R past the wall, f the feed of a turn
/// @src derived
/// @param curvature  of the path [1/m]
double past_own_wall(double f_z, double curvature,
                     const geometry::Cutter& cutter) noexcept;

/// An arc that goes past its own walls where it ends there.
geometry::Arc past_own_walls(geometry::Arc arc, double more) noexcept;

/// @brief The cut of a turn, feed along +x. Its arcs go past its own walls.
/// @pre it has layers
force::Setup setup_of(const Turn& turn, const Tool& tool);

/// @brief Forces of a turn at all angles of the spindle.
TurnLoads loads_of(const Turn& turn, const Tool& tool);

/// Forces in the axes of the program [N].
/// @param direction  of the feed [rad]; NaN: straight up or down
/// @eq N-10  F_program = rotation by chi of F
/// @src derived
TurnForces in_program(const TurnLoads& loads, double direction, double spindle);

/// A turn as a key: those whose arcs differ by less than the eye can see are one.
using TurnKey = std::vector<std::int64_t>;
TurnKey key_of(const Turn& turn);

struct TurnKeyHash {
  std::size_t operator()(const TurnKey& key) const noexcept;
};

}  // namespace trochoid::engagement
