#pragma once

#include <trochoid/chip/model.h>
#include <trochoid/force/law.h>
#include <trochoid/force/process_damping.h>
#include <trochoid/geometry/cut.h>
#include <trochoid/geometry/cutter.h>
#include <trochoid/geometry/runout.h>

namespace trochoid::force {

/// @brief Everything that makes a cut except its force coefficients.
struct Setup {
  geometry::Cutter cutter;
  geometry::Runout runout;
  geometry::Cut cut;
  chip::ChipModel chip;
  EdgeLength edge_length = EdgeLength::true_length;
  ProcessDamping process_damping;  ///< felt by what vibrates
};

/// @brief The runout that counts: with a chip model that feels none, there is none.
inline geometry::Runout runout_of(const Setup& setup) {
  return chip::feels_runout(setup.chip.model) ? setup.runout : geometry::Runout{};
}

/// @brief Whether the teeth have one profile and one lag, as the closed forms want it; else
/// each tooth has an edge of its own.
bool edges_alike(const Setup& setup) noexcept;

/// @brief Whether what one tooth does all do: equal pitch, and no runout that counts.
bool teeth_alike(const Setup& setup);

/// @brief Whether the teeth keep radius and angle along the edge: a cylinder of constant
/// lead whose runout is the same at every height.
bool keeps_radius(const Setup& setup) noexcept;

}  // namespace trochoid::force
