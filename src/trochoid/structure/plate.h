#pragma once

#include <trochoid/structure/ritz.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::structure {

/// How the ends of a wall are held, at x = 0 and at x = length.
enum class Ends {
  clamped,     ///< both
  free_start,  ///< the wall begins in the air
  free_end,    ///< it ends there
  free,        ///< both: a cantilever plate
};

/// As files spell it.
constexpr std::string_view name_of(Ends ends) noexcept {
  switch (ends) {
    case Ends::clamped:
      return "clamped";
    case Ends::free_start:
      return "free_start";
    case Ends::free_end:
      return "free_end";
    case Ends::free:
      return "free";
  }
  return {};
}

constexpr Clamps clamps_of(Ends ends) noexcept {
  return {.start = ends == Ends::clamped || ends == Ends::free_end,
          .end = ends == Ends::clamped || ends == Ends::free_start};
}

/// Upper part of a wall that is not as thick as its foot.
struct Layer {
  double from = 0.0;       ///< height above the clamped bottom where it begins [m]
  double thickness = 0.0;  ///< from there to the next layer or the free edge [m]
};

/// @brief A thin wall: clamped at its bottom, free at its upper edge, clamped or free at
/// its ends.
///
/// Its frame: x along the wall from 0 to `length`, y up from the clamped bottom, so
/// that the free edge is y = `height`. Deflections are across the wall.
struct Plate {
  double length = 0.0;     ///< along the feed [m], positive
  double height = 0.0;     ///< from the clamped bottom to the free edge [m], positive
  double thickness = 0.0;  ///< [m], positive; thin against the other two
  double youngs_modulus = 0.0;  ///< [N/m^2], positive
  double poisson_ratio = 0.0;   ///< in (-1, 0.5]
  Ends ends = Ends::clamped;
  std::vector<Layer> layers = {};  ///< ascending, none: as thick everywhere
};

/// @param y  above the clamped bottom [m]
double thickness_at(const Plate& plate, double y);

/// D of B-3 [N m], of the foot where there are layers.
double flexural_rigidity(const Plate& plate);

/// Points of a wall above one another.
struct Line {
  double x = 0.0;             ///< [m]
  std::span<const double> y;  ///< [m]
};

/// Along which axis of the wall the two forces of a couple lie apart.
enum class Along { x, y };

/// @brief Deflections of a thin wall (Kirchhoff plate), found once and then evaluated.
///
/// Ritz with a complete basis of piecewise polynomials whose patches meet at the x of
/// the loads: across that line the deflection is not smooth. The degrees grow until the
/// tolerance is met. Constant once made; copies share the factor.
///
/// **Accuracy.** The scale is the deflection G of the point (x, height) under a point
/// load there. `error` estimates how far any entry of `influence` at x may be off, as a
/// part of that G, for heights within `depth` of the free edge; elsewhere less is
/// promised. What spreads over heights (`line_load`, sums of the influence over many
/// heights) is more accurate. A point under its own load deflects less than in the
/// exact plate, never more.
///
/// **Limits.** A thin plate: no shear, no membrane forces, so deflections below half of
/// a thickness that is small against the height and the length.
///
/// @eq  B-3  Pi = D/2 int (w_xx + w_yy)^2 - 2 (1-nu) (w_xx w_yy - w_xy^2) dx dy
///           - int q w,  D = E t^3/(12 (1-nu^2));  w = w_x = 0 at clamped ends,
///           w = w_y = 0 at y = 0; the edge y = height is free
/// @eq  B-4  w = sum C_mn X_m(x) Y_n(y),  dPi/dC_mn = 0
/// @eq  B-8  error = sum over x, y of max |w_now - w_before|/w_edge r/(1-r),
///           r = (n_before/n_now)^2 with the degrees n
/// @eq  B-9  where the thickness t(y) changes, D in B-3 is that of each layer
/// @src [wang2015] eq. (6), (7), reconstructed; B-9 derived, about one middle plane
class PlateSolution {
 public:
  /// @param x  where the wall is loaded, in [0, length] [m]
  /// @param tolerance  error wanted, as a part of the deflection of the loaded edge;
  ///        where `converged` says no after some 20000 terms (below about 3e-5), the
  ///        best that was found is kept and `error` tells how good it is
  /// @param depth  from the free edge down to the lowest load [m]; by itself twice the
  ///        distance to the nearest clamped side, which is enough save near the ends
  ///        and on tall walls
  /// @throws std::invalid_argument when the plate or x is out of its range
  PlateSolution(const Plate& plate, double x, double tolerance, double depth = 0.0);

  /// @brief For loads at several x; the error is that of the worst of them.
  ///
  /// Costs as much as one solution for each, or more.
  PlateSolution(const Plate& plate, std::span<const double> x, double tolerance,
                double depth = 0.0);

  /// @brief Deflection at points of one line for point loads of 1 N on another.
  ///
  /// @eq  B-7  G = f_observed^T K^-1 f_loaded / D
  /// @param x_observed, x_loaded  in [0, length] [m]; any, but accurate at the x given
  /// to the constructor
  /// @param y_observed, y_loaded  in [0, height] [m]
  /// @return row-major, shape (observed, loaded) [m/N]; symmetric
  /// @throws std::invalid_argument when a point lies beside the wall
  [[nodiscard]] std::vector<double> influence(double x_observed,
                                              std::span<const double> y_observed,
                                              double x_loaded,
                                              std::span<const double> y_loaded) const;

  /// @brief Deflection for 1 N spread evenly over the heights from y_from to y_to.
  /// @return shape (observed) [m/N]
  /// @throws std::invalid_argument when a point lies beside the wall or y_to < y_from
  [[nodiscard]] std::vector<double> line_load(double x_observed,
                                              std::span<const double> y_observed,
                                              double x_loaded, double y_from,
                                              double y_to) const;

  /// @brief Deflection at points of one line for couples of 1 N m on another.
  ///
  /// A couple is a force and its opposite a little further on: the derivative of
  /// `influence` by the place of the load.
  /// @eq  B-10  G_M(1, 2) = dG(1, 2)/ds_2, s the direction from the negative to the
  ///            positive force of the couple: x or y
  /// @return row-major, shape (observed, loaded) [m/(N m)]
  /// @throws std::invalid_argument when a point lies beside the wall
  [[nodiscard]] std::vector<double> couple(Line observed, Line loaded,
                                           Along along) const;

  /// @brief Deflection under an even pressure of 1 N/m^2 [m per N/m^2].
  /// @throws std::invalid_argument when the point lies beside the wall
  [[nodiscard]] double pressure(double x, double y) const;

  /// @brief Deflection under 1 N/m along the whole free edge [m per N/m].
  /// @throws std::invalid_argument when the point lies beside the wall
  [[nodiscard]] double edge_load(double x, double y) const;

  /// Estimated, as a part of the deflection of the loaded edge; worst of the x given.
  [[nodiscard]] double error() const { return found_.error; }
  [[nodiscard]] bool converged() const { return found_.converged; }  ///< tolerance met
  [[nodiscard]] std::size_t terms() const { return found_.ritz.size(); }
  /// From the free edge down to where `error` holds [m].
  [[nodiscard]] double depth() const { return found_.depth; }

 private:
  struct Refined {
    RitzSystem ritz;
    double depth = 0.0;
    double error = 0.0;
    bool converged = false;
  };
  static Refined refined(const Plate& plate, std::span<const double> x,
                         double tolerance, double depth);

  [[nodiscard]] const RitzSystem& ritz() const { return found_.ritz; }
  [[nodiscard]] std::vector<double> reduced(double x, std::span<const double> y) const;
  /// A load that is the same at all x, fy in y.
  [[nodiscard]] std::vector<double> reduced_along(std::span<const double> fy) const;
  [[nodiscard]] double under(double x, double y, std::span<const double> load) const;
  void check_line(double x, std::span<const double> y) const;

  Plate plate_;
  double D_ = 0.0;  ///< flexural rigidity [N m]
  Refined found_;
  std::vector<double> even_pressure_;  ///< reduced, shape (terms)
  std::vector<double> edge_load_;      ///< reduced, shape (terms)
};

}  // namespace trochoid::structure
