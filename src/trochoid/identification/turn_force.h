#pragma once

#include <trochoid/force/forces.h>

#include <array>
#include <functional>
#include <span>
#include <vector>

namespace trochoid::identification {

/// @brief The force over a turn, computed where it takes to interpolate the rest.
///
/// Quartics over intervals that are halved until they meet the force between their
/// nodes: near a kink down to the smallest interval, elsewhere a few to a harmonic.
class TurnForce {
 public:
  /// Force [N] at angles of the tip of tooth 1 [rad].
  using Function =
      std::function<std::vector<force::Vector3>(std::span<const double> phi)>;

  /// @param tolerance  error allowed, relative to the largest force
  TurnForce(const Function& force, double tolerance);

  [[nodiscard]] force::Vector3 at(double phi) const noexcept;

  /// Angles at which the force was computed.
  [[nodiscard]] std::size_t evaluations() const noexcept { return evaluations_; }

 private:
  /// Five equally spaced nodes, the ends among them.
  struct Interval {
    double from = 0.0;
    double width = 0.0;
    std::array<force::Vector3, 5> F{};

    [[nodiscard]] force::Vector3 at(double phi) const noexcept;
  };

  std::vector<Interval> halved(const Function& force,
                               const std::vector<Interval>& parents);
  [[nodiscard]] double largest_miss(const Interval& parent, const Interval& left,
                                    const Interval& right) const noexcept;

  std::vector<Interval> intervals_;  ///< ascending
  std::size_t evaluations_ = 0;
};

}  // namespace trochoid::identification
