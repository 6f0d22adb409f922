#pragma once

#include <trochoid/force/law.h>
#include <trochoid/identification/identify.h>

namespace trochoid::identification::test {

/// A fit that nothing speaks against.
inline Fit sound_fit() {
  Fit fit;
  fit.ok = true;
  fit.law = force::LinearEdge{2600e6, 1500e6, 330e6, 7e3, 3e3, 1e3};
  for (const double K : force::coefficients(fit.law)) {
    fit.coefficients.emplace_back(Estimate{K, 0.01 * K, 0.98 * K, 1.02 * K});
  }
  fit.runout.radial_offsets = {0.0, -8e-6};
  fit.radial_offsets_se = {std::nullopt, 1e-7};
  fit.phase = {0.1};
  fit.phase_se = {0.001};
  fit.interval_factor = 2.0;
  fit.rms = 12.0;
  fit.unexplained = {.in_band = 0.1, .all = 0.1};
  return fit;
}

}  // namespace trochoid::identification::test
