#pragma once

#include <trochoid/numerics/lagrange.h>
#include <trochoid/structure/cantilever.h>
#include <trochoid/structure/plate.h>
#include <trochoid/surface/choices.h>

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// The wall as the cutter meets it.
struct Wall {
  std::shared_ptr<const structure::PlateSolution> plate;
  double height = 0.0;     ///< of the top of the cut above the clamping [m]
  double length = 0.0;     ///< along the feed [m]
  double thickness = 0.0;  ///< where the cutter meets it, before the cut [m]
};

/// @brief What bends; what is absent is rigid.
struct Bodies {
  std::optional<structure::Cantilever> cutter;
  std::optional<Wall> wall;
};

/// The bodies with the cutter at x along the wall [m].
using BodiesAt = std::function<Bodies(double x)>;

/// @brief Cutter and wall by their dimensions; the wall is solved anew at each x.
/// @param a_p    axial depth: loads reach down to it from the top of the cut [m]
/// @param below  of the top of the cut below the free edge [m]
BodiesAt bodies_at(const std::optional<structure::Cantilever>& cutter,
                   const std::optional<structure::Plate>& wall, double a_p,
                   double below = 0.0);

/// Cutter and wall by their dimensions, and where the one meets the other.
struct BodyDimensions {
  std::optional<structure::Cantilever> cutter;  ///< nothing: it is rigid
  std::optional<structure::Plate> wall;         ///< nothing: it is rigid
  double position = 0.0;  ///< of the cutter along the wall [m]; 0 without a wall
};

/// @brief The same bodies, the wall solved once for each x: for maps and plans, which come
/// back to the same places. From any thread.
/// @param a_p  axial depth [m]
BodiesAt bodies_solved_once(const BodyDimensions& dimensions, double a_p);

/// @brief Deflection along the cut, from the force along the cut.
///
/// The force per height enters by its moments m_q = integral of L_q(z) dF_y, with the
/// polynomials L_q of `basis`: any smooth function of z, and so the influence, is its
/// values at the points times these.
///
/// @eq E-5 u(h) = sum_q G(h, z_q) m_q, G = G_cutter + G_wall       (distributed)
/// @eq E-6 u(h) = (G_cutter(h, a_p/2) + G_wall,line(h)) F_y          (concentrated)
/// @src [wang2015] eq. 4 to 9; the distributed load: derived
class Compliance {
 public:
  /// @param a_p  axial depth; the tip is at height - a_p on the wall [m]
  /// @param x    of the cutter along the wall [m]
  Compliance(const Bodies& bodies, double a_p, double x, Load load);

  [[nodiscard]] const numerics::LagrangeBasis& basis() const noexcept { return basis_; }
  [[nodiscard]] const Bodies& bodies() const noexcept { return bodies_; }
  [[nodiscard]] double axial_depth() const noexcept { return a_p_; }  ///< [m]
  [[nodiscard]] Load load() const noexcept { return load_; }

  /// @param heights  above the tip [m]
  /// @return [m/N], row-major, shape (heights, basis points)
  [[nodiscard]] std::vector<double> rows(std::span<const double> heights) const;

  /// @brief Deflection per force at single points, of the cutter alone.
  [[nodiscard]] std::vector<double> of_cutter(std::span<const double> heights,
                                              std::span<const double> loads) const;
  /// @brief The same of the wall alone; zero above the free edge's height.
  [[nodiscard]] std::vector<double> of_wall(std::span<const double> heights,
                                            std::span<const double> loads) const;

  /// @brief Deflection per couple at the basis points, of the cutter alone (B-12);
  /// row-major, shape (heights, basis points) [m/(N m)].
  [[nodiscard]] std::vector<double> of_cutter_couples(
      std::span<const double> heights) const;
  /// @brief The same of the wall alone (B-10); zero above the free edge's height.
  [[nodiscard]] std::vector<double> of_wall_couples(std::span<const double> heights,
                                                    structure::Along along) const;

  /// @brief Deflection per whole force where that is concentrated (E-6), whatever the
  /// load of this compliance; shape of heights [m/N].
  [[nodiscard]] std::vector<double> concentrated(std::span<const double> heights) const;
  /// @brief What the cutter alone adds to it.
  [[nodiscard]] std::vector<double> concentrated_on_cutter(
      std::span<const double> heights) const;
  /// @brief What the wall alone adds to it; zero above the free edge's height.
  [[nodiscard]] std::vector<double> concentrated_on_wall(
      std::span<const double> heights) const;

 private:
  [[nodiscard]] std::vector<double> on_the_wall(std::span<const double> heights) const;
  void clear_above(std::span<const double> heights, std::span<const double> loads,
                   std::vector<double>& G) const;

  Bodies bodies_;
  double a_p_;
  double x_;
  Load load_;
  numerics::LagrangeBasis basis_;
};

}  // namespace trochoid::surface
