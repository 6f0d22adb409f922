#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/dynamics/engaged.h>
#include <trochoid/force/setup.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

/// The cut in thin layers: for all cutters but cylinders of constant lead.
namespace trochoid::dynamics {

/// @brief Delays at which the motion is looked up, so that any delay between them is known.
///
/// Where the helix differs from tooth to tooth, the time from one tooth to the next changes
/// along the edge. A delay within a range of delays follows from those at Chebyshev nodes:
/// @eq D-36 q(phi - d) = sum over n + 1 nodes k of L_k(d) q(phi - d_k), for c vibrations of
///          the fastest mode within the range as many as make J_(n+1)(pi c) small
/// @src derived: Lagrange's interpolation at Chebyshev nodes
class DelayNodes {
 public:
  DelayNodes() = default;
  /// @param ranges  of delays, one for each pair of a tooth and its mark [rad]
  /// @param cycle   of the fastest vibration, as an angle of the spindle [rad]
  DelayNodes(std::vector<std::array<double, 2>> ranges, double cycle);

  [[nodiscard]] const std::vector<double>& delays() const noexcept { return delays_; }
  /// Weights L_k of a delay that lies in one of the ranges.
  /// @param[out] weights  of the nodes of its range, from the first on; as long as all
  /// @return the first of them and their number
  std::pair<std::size_t, std::size_t> weights(double delay,
                                              std::span<double> weights) const noexcept;

 private:
  struct Range {
    double from = 0.0;
    double to = 0.0;
    std::size_t first = 0;  ///< node
    int degree = 0;         ///< 0: one delay
  };
  std::vector<Range> ranges_;
  std::vector<double> delays_;  ///< ascending
};

/// @brief One tooth in one layer, while one pass bounds its chip. Its ends in the spindle
/// angle are straight over the height of the layer, kappa and R over the root of it.
struct LayerArc {
  std::size_t layer = 0;
  std::size_t place = 0;         ///< of the tooth, among those that are there
  std::array<double, 2> from{};  ///< spindle angle [rad], at the lower and upper face
  std::array<double, 2> to{};
  std::array<double, 2> omega{};  ///< of the edge behind the tip of tooth 1 [rad]
  double epsilon = 0.0;           ///< [rad]
  std::array<double, 2> R{};      ///< [m]
  std::array<double, 2> kappa{};  ///< [rad]
  double sine = 1.0;              ///< of kappa where it is the same on both faces
  double cosine = 0.0;
  bool own = true;  ///< the edge itself moves the outer end
  std::array<double, 2>
      delay{};  ///< to the mark [rad]; 0: the stock, which stands still
};

/// @brief All layers of a cut up to a depth.
///
/// @eq D-37 A_d(phi) = sum over layers and arcs of L_d g(theta) ds, over that part of the
///          layer whose edge is in the arc at phi, by Gauss' rule of two points
/// @src derived: D-9 with arcs whose ends are straight within a layer
struct Layers {
  struct Layer {
    double from = 0.0;  ///< [m]
    double to = 0.0;    ///< [m]
    std::array<double, 2>
        root{};             ///< of the height over that of its zone, at both faces
    bool first = false;     ///< of a zone: an edge begins or bends here
    chip::Passage passage;  ///< of the teeth that are there
    std::vector<geometry::EdgePosition> teeth;
    std::vector<geometry::EngagedArc> stock;  ///< if arcs say where it is
    double r = 0.0;                           ///< nominal [m]
  };
  force::Terms law;
  force::Terms flank;    ///< process damping as a law, K [N/m]
  double h_floor = 0.0;  ///< [m]
  double least_R = 0.0;  ///< nearer to the axis no chip forms [m]
  bool damps = false;    ///< flanks press
  std::vector<Layer> all;
  std::vector<LayerArc> arcs;  ///< in the order of their layers
  /// Which arcs may be passed in each of equal parts of a turn, in the same order.
  std::vector<std::vector<std::uint32_t>> passed;
  double period = 0.0;  ///< [rad]
  DelayNodes delays;

  /// Of the matrices at a depth.
  [[nodiscard]] Largest largest(double a_p) const;
  /// Spindle angles where something switches, for a depth [rad].
  [[nodiscard]] std::vector<double> breaks(double a_p) const;
  /// Add the matrices at phi [N/m], last D where flanks damp [N].
  /// @param middle  tells on which side of a switch phi lies [rad]
  // four parameters and the object: depth, angle, its side, and where to
  void add(double a_p, double phi, double middle, std::vector<Matrix2>& out) const;

 private:
  /// Add a part of the height of a layer.
  void add_part(const LayerArc& arc, double from, double to, double phi,
                std::vector<Matrix2>& out) const;
};

/// @param deepest  depth that is looked at [m]
/// @param cycle    of the fastest vibration, as an angle of the spindle [rad]
Layers layers_of(const force::Setup& setup, const force::Terms& law, double h_floor,
                 double deepest, double cycle);

}  // namespace trochoid::dynamics
