#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/structure/cantilever.h>
#include <trochoid/structure/plate.h>
#include <trochoid/surface/error_map.h>

#include <optional>

namespace trochoid::results {

/// @brief What `surface` answers: the wall that a cut leaves.
struct SurfaceResult {
  Heading heading;
  surface::ErrorMap map;  ///< no rows where no steady state was found
  double diameter = 0.0;  ///< of the cutter [m]
  double a_p = 0.0;       ///< axial depth of cut [m]
  std::optional<structure::Cantilever> cutter;  ///< none: rigid
  std::optional<structure::Plate> wall;         ///< none: rigid
};

Answer answer_of(const SurfaceResult& result);

}  // namespace trochoid::results
