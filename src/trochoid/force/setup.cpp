#include <trochoid/force/setup.h>

#include <trochoid/geometry/tooth_edges.h>

namespace trochoid::force {

bool teeth_alike(const Setup& setup) {
  return edges_alike(setup) && geometry::runs_true(runout_of(setup)) &&
         geometry::equally_pitched(setup.cutter.pitch);
}

bool edges_alike(const Setup& setup) noexcept {
  return geometry::edges_alike(setup.cutter, runout_of(setup));
}

bool keeps_radius(const Setup& setup) noexcept {
  const geometry::Profile& p = setup.cutter.profile;
  const bool cylinder = p.R == 0 && p.alpha == 0 && p.beta == 0;
  const bool constant_lead = setup.cutter.lag_law == geometry::LagLaw::constant_lead ||
                             setup.cutter.lag_diameter == p.D;
  return cylinder && constant_lead && edges_alike(setup) &&
         (runout_of(setup).eccentricity == 0 || setup.cutter.helix == 0);
}

}  // namespace trochoid::force
