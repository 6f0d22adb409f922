#include <trochoid/identification/gauge.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {

bool teeth_are_alike(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  if (u.phases == 0 || !geometry::equally_pitched(problem.setup.cutter.pitch))
    return false;
  const geometry::Runout& given = problem.setup.runout;
  if (u.runout == RunoutUnknowns::both) return true;
  if (u.runout == RunoutUnknowns::offsets) return given.eccentricity == 0.0;
  if (u.runout == RunoutUnknowns::eccentricity) return geometry::equal_offsets(given);
  return geometry::runs_true(given);
}

bool apply_gauge(const Problem& problem, std::vector<double>& p) {
  const Unknowns& u = problem.unknowns;
  if (u.phases == 0) return false;
  Point point = point_of(problem, p);
  const double pitch = unit::turn / u.teeth;
  int shift = 0;
  if (teeth_are_alike(problem)) {
    const auto passed = static_cast<int>(std::floor(point.phase[0] / pitch + 0.5));
    shift = ((passed % u.teeth) + u.teeth) % u.teeth;
    for (double& phase : point.phase) phase -= passed * pitch;
  }
  if (finds_offsets(u.runout) && shift != 0) {
    auto& s = point.runout.radial_offsets;
    std::ranges::rotate(s, s.begin() + shift);
  }
  point.runout.angle -= shift * pitch;
  for (std::size_t r = 0; r < point.phase.size(); ++r) {
    double& phase = point.phase[r];
    if (r > 0 || !teeth_are_alike(problem))
      phase -= unit::turn * std::floor(phase / unit::turn + 0.5);
  }
  p = parameters_of(problem, point);
  return shift != 0;
}

}  // namespace trochoid::identification
