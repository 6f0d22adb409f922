#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/dynamics/gradient.h>
#include <trochoid/force/setup.h>
#include <trochoid/numerics/piecewise_integral.h>

#include <optional>
#include <vector>

/// Where the teeth of a cylinder cut, and which pass left what they meet.
namespace trochoid::dynamics {

/// @brief Which periods and delays a cutter has.
struct Passes {
  bool equal = false;          ///< all teeth do the same, a pitch apart
  double period = 0.0;         ///< [rad]
  std::vector<double> delays;  ///< [rad], ascending
  std::vector<double> psi;     ///< [rad]

  /// Channel of D-8 of the tooth `mark` teeth before; 0: no such tooth.
  [[nodiscard]] std::size_t channel(const chip::Passage& passage, std::size_t tooth,
                                    int mark) const noexcept;
};

Passes passes_of(const force::Setup& setup);

double largest_entry(const Matrix2& m) noexcept;

/// Largest entries, of what acts on q and of what acts on dq/dphi.
struct Largest {
  double cutting = 0.0;
  double damping = 0.0;  ///< 0: there is no process damping
};

/// An arc of theta in which one pass left the surface.
struct PassArc {
  double from = 0.0;        ///< [rad]
  double to = 0.0;          ///< [rad]
  std::size_t channel = 0;  ///< of the mark; 0: the stock stands still
  bool own = true;          ///< the edge itself moves the outer end
};

/// @brief Arcs and gradients of a constant-lead cylinder, for any depth.
struct CylinderArcs {
  Passes passes;
  chip::Passage passage;
  force::Terms law;
  force::Terms flank;           ///< process damping as a law, K [N/m]
  double h_floor = 0.0;         ///< [m]
  double r = 0.0;               ///< [m]
  double lag_per_height = 0.0;  ///< [rad/m]
  Largest largest;              ///< entries of g, over all teeth [N/m^2], and [N/m]
  std::vector<geometry::EdgePosition> teeth;
  /// Of each tooth, or of one if all are equal.
  std::vector<std::vector<PassArc>> arcs;
  /// Antiderivative of g over theta for each of those teeth and each channel, last of
  /// D-31 where flanks damp; empty without helix.
  std::vector<std::vector<std::optional<numerics::PiecewiseIntegral<4>>>> tables;

  [[nodiscard]] std::vector<double> breaks(double lag) const;
  [[nodiscard]] Matrix2 gradient(std::size_t tooth, double theta) const noexcept;
  /// g_d / R of D-31 [N/m]
  [[nodiscard]] Matrix2 damping(std::size_t tooth, double theta) const noexcept;
  /// Add the integral over an edge whose tip is at theta [N/m^2 rad].
  void add_edge(std::size_t tooth, double theta, double lag,
                std::vector<Matrix2>& out) const noexcept;
  /// Add g at theta, by the arc that holds `middle`.
  void add_point(std::size_t tooth, double theta, double middle,
                 std::vector<Matrix2>& out) const noexcept;
};

CylinderArcs cylinder_arcs(const force::Setup& setup, const force::Terms& law,
                           double h_floor, double tolerance);

}  // namespace trochoid::dynamics
