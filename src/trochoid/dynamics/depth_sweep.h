#pragma once

#include <trochoid/dynamics/directional.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/dynamics/period_map.h>
#include <trochoid/dynamics/system.h>

#include <map>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// A cut at the depths of a diagram, for every speed of it.
struct Cuts {
  const DirectionalModel& model;
  std::vector<double> depth;          ///< [m], ascending
  std::vector<Directional> at_depth;  ///< empty where the cut is proportional to it
};

Cuts cuts_at(const DirectionalModel& model, std::span<const double> depth);

/// @brief Multipliers at one speed for one depth after another: what does not depend on
/// the depth is made once.
class DepthSweep {
 public:
  DepthSweep(const Cuts& cuts, const System& system, double Omega)
      : cuts_(cuts), system_(system), Omega_(Omega) {}

  /// @param depth      [m], positive
  /// @param tolerance  of the eigenvalue only
  [[nodiscard]] Multiplier at(double depth, double factor, double tolerance);
  /// @param tolerance  of |mu|, relative where it is above 1
  [[nodiscard]] Multiplier checked(double depth, double tolerance);
  [[nodiscard]] double spindle_speed() const noexcept { return Omega_; }

 private:
  const Cuts& cuts_;
  const System& system_;
  double Omega_;
  std::map<double, int> steps_;       ///< that the last search took, by factor
  std::map<double, PeriodMap> maps_;  ///< by factor, of a cut one metre deep
};

}  // namespace trochoid::dynamics
