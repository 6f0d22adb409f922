#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/chip/harmonic_pieces.h>
#include <trochoid/force/setup.h>

#include <optional>
#include <vector>

namespace trochoid::force {

/// @brief How the teeth of a constant-lead cylinder cut in a turn: what a TurnPolynomial
/// is made of, whatever the coefficients.
struct TurnTeeth {
  chip::Passage passage;
  double r = 0.0;                             ///< nominal radius [m]
  std::vector<geometry::EdgePosition> teeth;  ///< shape (teeth)
  /// phi less the effective theta of the tip [rad], shape (teeth)
  std::vector<double> behind;
  /// Of each tooth, or one where all are equal.
  std::vector<chip::ToothHarmonics> harmonics;
  double a_p = 0.0;          ///< [m]
  double lag = 0.0;          ///< of the edge at a_p behind its tip [rad]
  double edge_factor = 1.0;  ///< e = dS/dz

  [[nodiscard]] chip::Slice slice() const noexcept { return {r, teeth}; }
  [[nodiscard]] const chip::ToothHarmonics& harmonics_of(
      std::size_t tooth) const noexcept {
    return harmonics[harmonics.size() == 1 ? 0 : tooth];
  }
};

/// @param tolerance  error allowed in the chip, of the largest that the feed makes
/// @return nothing unless the setup keeps_radius, something is fed and the chip over
///         every mark has few harmonics
std::optional<TurnTeeth> turn_teeth(const Setup& setup, double tolerance);

}  // namespace trochoid::force
