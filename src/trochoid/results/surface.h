#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/structure/cantilever.h>
#include <trochoid/structure/plate.h>
#include <trochoid/structure/wall_loads.h>
#include <trochoid/surface/error_map.h>
#include <trochoid/surface/finish.h>
#include <trochoid/surface/pass_sequence.h>

#include <optional>
#include <vector>

namespace trochoid::results {

/// @brief What `surface` answers: the wall that a cut leaves.
struct SurfaceResult {
  Heading heading;
  surface::ErrorMap map;  ///< of the last pass; no rows where no steady state was found
  double diameter = 0.0;  ///< of the cutter [m]
  double a_p = 0.0;       ///< axial depth of cut [m]
  std::optional<structure::Cantilever> cutter;  ///< none: rigid
  std::optional<structure::Plate> wall;         ///< before the first pass; none: rigid
  std::vector<surface::PassOutcome> passes;     ///< where there are several
  std::vector<surface::AlsoBends> also_bends;
  std::optional<surface::MeanAndExtremes> straight;  ///< error without also_bends [m]
  std::optional<structure::LoadedWalls> loads;       ///< beside the cut
  double period = 0.0;                               ///< feed of a turn [m]
  std::vector<surface::FloorLine> floor;             ///< lines of the floor
  bool of_wall = true;       ///< whether a wall was asked for; else only the floor
  bool forces_known = true;  ///< whether the case has a [force]
};

Answer answer_of(const SurfaceResult& result);

}  // namespace trochoid::results
