// A stranger's use of the installed library: force on a tool in a slot.
#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>

#include <cmath>
#include <cstdio>
#include <vector>

int main() {
  namespace unit = trochoid::unit;
  trochoid::force::Setup setup;
  setup.cutter.profile = trochoid::geometry::cylinder(8.0 * unit::mm);
  setup.cutter.pitch = trochoid::geometry::equal_pitch(2);
  setup.cutter.helix = 30.0 * unit::deg;
  setup.cutter.lag_diameter = 8.0 * unit::mm;
  setup.cut = {.engagement = trochoid::geometry::Slot{},
               .a_p = 2.0 * unit::mm,
               .f_z = 0.04 * unit::mm,
               .Omega = 875.0 * unit::rpm};
  const trochoid::force::LinearEdge law{.K_tc = 2000.0 * unit::MPa};
  const std::vector<double> phi = {90.0 * unit::deg};
  const auto force = trochoid::force::forces(setup, law, phi, 1e-6);
  // The tooth at 90 degrees cuts against its velocity, which points to -y.
  std::printf("Fy = %.1f N\n", force[0][1]);
  return std::isfinite(force[0][1]) && force[0][1] > 0.0 ? 0 : 1;
}
