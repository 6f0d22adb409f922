#pragma once

#include <trochoid/chip/teeth_at_height.h>
#include <trochoid/force/axial.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::force {

/// @brief A stretch of heights in which the same teeth are there and no profile bends.
///
/// Its points are from + (to - from) t^2, t from 0 to 1: radii of a corner grow with the
/// root of the height above its start, and are smooth over t.
struct Zone {
  double from = 0.0;         ///< [m]
  double to = 0.0;           ///< [m]
  std::vector<char> there;   ///< shape (teeth)
  std::vector<double> grid;  ///< of t, close enough for a first look

  [[nodiscard]] double beyond(double t) const noexcept { return (to - from) * t * t; }
  /// dz/dt [m]
  [[nodiscard]] double slope(double t) const noexcept { return 2 * (to - from) * t; }
};

/// @brief Edges of which each tooth has its own, within the axial depth.
struct AnyEdges {
  explicit AnyEdges(const Setup& given);

  Setup setup;  ///< with the runout that counts
  geometry::ToothEdges edges;
  chip::Passage passage;  ///< of all teeth, angles at the tip
  std::vector<Zone> zones;
};

/// One tooth at a height and a spindle angle.
struct AnyState {
  chip::Chip chip;
  double theta = 0.0;  ///< effective immersion angle [rad]
  [[nodiscard]] bool active() const noexcept { return chip.in_cut; }
  [[nodiscard]] int branch() const noexcept { return chip.bounds; }
  [[nodiscard]] double margin() const noexcept { return chip.margin; }
};

/// @brief Forces of edges that differ, under any law: along each edge cut where something
/// switches, by quadrature between.
///
/// @eq F-30 [C] = sum over the teeth that are there of the integral of [B][A] over the
///          height, in zones between the heights where an edge begins or bends
/// @src derived
class AnyForce {
 public:
  using Matrix = AxialForce::Matrix;

  /// @param tolerance  relative to the largest possible value of each entry
  AnyForce(const Setup& setup, const Law& law, double tolerance);
  /// @brief Of heights up to a top only.
  AnyForce(const Setup& setup, const Law& law, double tolerance, double top);

  /// @param[out] C  as of AxialForce, shape (angles)
  void matrices(std::span<const double> phi, std::span<Matrix> C) const;
  /// @param[out] all  as of AxialForce, shape (angles)
  void loads(std::span<const double> phi, double gauge_length,
             std::span<SixLoads> all) const;
  /// @brief Mean of a turn, as an integral over theta at each height (F-31).
  [[nodiscard]] TurnMeans mean(double gauge_length) const;

  [[nodiscard]] const AnyEdges& edges() const noexcept { return edges_; }

 private:
  template <std::size_t M, class Element>
  void integrate(double phi, const std::array<double, M>& allowed,
                 const Element& element, std::array<double, M>& sum) const;
  [[nodiscard]] SixLoads allowed_loads(double gauge_length) const;
  [[nodiscard]] std::array<double, 3> force_per_height(
      const chip::Chip& chip, const geometry::EdgeAt& at) const;
  using TenMeans = std::array<double, 10>;  ///< of TurnMeans, one after the other
  [[nodiscard]] TenMeans allowed_means(double gauge_length) const;
  void add_turn(const chip::TeethAtHeight& teeth, double z, double gauge_length,
                double weight, TenMeans& sum) const;

  AnyEdges edges_;
  Terms terms_;
  double allowed_cutting_ = 0.0;
  double allowed_edge_ = 0.0;
};

}  // namespace trochoid::force
