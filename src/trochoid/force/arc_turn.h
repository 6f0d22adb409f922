#pragma once

#include <trochoid/chip/arc_chip.h>
#include <trochoid/chip/chip.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>
#include <trochoid/numerics/piecewise_integral.h>

#include <array>
#include <cstddef>
#include <vector>

namespace trochoid::force {

/// @brief What the teeth feel at one angle of the spindle, feed along +x.
struct ToothLoads {
  double x = 0.0;       ///< on the tool [N]
  double y = 0.0;       ///< [N]
  double z = 0.0;       ///< [N]
  double torque = 0.0;  ///< [N m], positive: the spindle drives
  /// Integrals of f_x and f_y times the height above the tip to the power of 1, 2, 3
  /// [N m, N m^2, N m^3].
  std::array<double, 3> moment_x{};
  std::array<double, 3> moment_y{};
  double axial_x = 0.0;  ///< integral of R sin(theta) f_z [N m]
  double axial_y = 0.0;  ///< of R cos(theta) f_z [N m]
};

ToothLoads& operator+=(ToothLoads& a, const ToothLoads& b) noexcept;

/// @brief Forces of a turn of a constant-lead cylinder whose stock is given as arcs per
/// layer. Where runout changes along the edge, thin layers keep it.
///
/// The force per height of each tooth over theta, and its moments in theta, are integrated
/// once; a turn of the spindle asks differences of the integrals.
/// @eq N-7  F = (1/q) sum over layers and teeth of G_j(phi - psi_j - lag(from)) -
///          G_j(phi - psi_j - lag(to)), q = d lag/dz, G_j = int g_j dtheta
/// @eq N-8  mean F = sum of (to - from)/(2 pi) int g_j dtheta over a turn
/// @src derived
class ArcTurn {
 public:
  /// @pre setup.cut.engagement holds geometry::Arcs, the cutter is a constant-lead cylinder,
  ///      something is fed
  /// @param within  theta in which there are chips at all [rad]
  /// @param heights  whether moments over the height are asked for
  ArcTurn(const Setup& setup, const Law& law, geometry::Arc within, bool heights);

  [[nodiscard]] std::size_t teeth() const noexcept { return psi_.size(); }
  /// Loads of one tooth at the angle phi of the tip of tooth 1 [rad].
  [[nodiscard]] ToothLoads at(std::size_t tooth, double phi) const noexcept;
  /// Mean loads over a turn, of all teeth, without moments over the height.
  [[nodiscard]] ToothLoads mean() const noexcept { return mean_; }
  [[nodiscard]] double peak_chip() const noexcept { return peak_chip_; }  ///< [m]
  /// Angles phi at which the force may have a kink or jump, in [0, 2 pi), ascending [rad].
  [[nodiscard]] std::vector<double> events() const;
  /// Whether forces jump at events: edges without lag.
  [[nodiscard]] bool jumps() const noexcept { return !(lag_per_height_ > 0); }

 private:
  /// F_x, F_y, F_z, F_t per height.
  using PerHeight = std::array<double, 4>;
  /// The same, theta to the power of 1, 2, 3 times F_x and F_y, and sin(theta),
  /// cos(theta) times F_z.
  using Values = std::array<double, 12>;
  struct Layer {
    double from = 0.0;  ///< [m]
    double to = 0.0;    ///< [m]
    std::vector<chip::ReachedArc> arcs = {};
    std::vector<geometry::EdgePosition> positions = {};  ///< of the teeth at its middle
    /// Of each tooth.
    std::vector<numerics::PiecewiseIntegral<12>> integrals = {};
    std::vector<std::vector<double>> ends = {};  ///< of pieces, theta [rad]
  };
  struct Ray {
    double h;
    int bound;  ///< what bounds the chip; -1: air
  };

  void add_slab(const Setup& setup, const geometry::ArcLayer& given, geometry::Arc slab,
                geometry::Arc within);
  [[nodiscard]] double behind(const Layer& layer, std::size_t tooth) const noexcept {
    return psi_[tooth] - layer.positions[tooth].epsilon;
  }
  [[nodiscard]] Ray ray(const Layer& layer, std::size_t tooth,
                        double theta) const noexcept;
  [[nodiscard]] PerHeight per_height(double h, double theta) const noexcept;
  void add_tooth(Layer& layer, std::size_t tooth);
  void add_stretch(Layer& layer, std::size_t tooth, double from, double to,
                   numerics::PiecewiseIntegral<12>& integral);
  void add_smooth(Layer& layer, std::size_t tooth, geometry::Arc piece,
                  numerics::PiecewiseIntegral<12>& integral);
  void add_layer(const Layer& layer, std::size_t tooth, double phi,
                 ToothLoads& out) const noexcept;

  chip::Passage passage_;
  double r_ = 0.0;
  std::vector<double> psi_;  ///< of the tips [rad]
  double lag_per_height_ = 0.0;
  double edge_factor_ = 1.0;
  bool heights_ = false;
  Terms law_;
  std::vector<Layer> layers_;
  ToothLoads mean_;
  double peak_chip_ = 0.0;
};

}  // namespace trochoid::force
