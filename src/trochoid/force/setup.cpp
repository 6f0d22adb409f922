#include <trochoid/force/setup.h>

namespace trochoid::force {

bool teeth_alike(const Setup& setup) {
  return geometry::runs_true(runout_of(setup)) &&
         geometry::equally_pitched(setup.cutter.pitch);
}

bool keeps_radius(const Setup& setup) noexcept {
  const geometry::Profile& p = setup.cutter.profile;
  const bool cylinder = p.R == 0 && p.alpha == 0 && p.beta == 0;
  const bool constant_lead = setup.cutter.lag_law == geometry::LagLaw::constant_lead ||
                             setup.cutter.lag_diameter == p.D;
  return cylinder && constant_lead &&
         (runout_of(setup).eccentricity == 0 || setup.cutter.helix == 0);
}

}  // namespace trochoid::force
