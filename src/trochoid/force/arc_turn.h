#pragma once

#include <trochoid/base/units.h>
#include <trochoid/chip/arc_chip.h>
#include <trochoid/chip/chip.h>
#include <trochoid/force/law.h>
#include <trochoid/force/setup.h>
#include <trochoid/geometry/tooth_edges.h>
#include <trochoid/numerics/piecewise_integral.h>

#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
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

/// @brief Forces of a turn whose stock is given as arcs per layer.
///
/// Within a layer the edge is straight: a cone, with its middle's radius, slope and runout.
/// On a constant-lead cylinder that is exact; where runout changes along its edge, thin
/// layers keep it. For other cutters the caller gives layers thin enough.
///
/// The force per height of each tooth over theta, and its moments in theta, are integrated
/// once; a turn of the spindle asks differences of the integrals.
/// @eq N-7  F = (1/q) sum over layers and teeth of G_j(phi - psi_j - lag(from)) -
///          G_j(phi - psi_j - lag(to)), q = d lag/dz, G_j = int g_j dtheta
/// @eq N-8  mean F = sum of (to - from)/(2 pi) int g_j dtheta over a turn
/// @eq N-18 a tool that falls by f_a a turn: L_k is lower by r(z) - r(z - f_a (theta_j -
///          theta_k)/2 pi), as the tooth before stood higher
/// @src derived
class ArcTurn {
 public:
  struct Options {
    geometry::Arc within;  ///< theta in which there are chips at all [rad]
    bool heights = false;  ///< whether moments over the height are asked for
    double fall = 0.0;     ///< feed of a turn downwards [m]; only with `cones`
    bool cones = false;    ///< any cutter; false: a constant-lead cylinder
  };
  /// @pre setup.cut.engagement holds geometry::Arcs, the cutter is a constant-lead cylinder
  ///      or Options::cones is set, something is fed
  ArcTurn(const Setup& setup, const Law& law, const Options& options);

  [[nodiscard]] std::size_t teeth() const noexcept { return psi_.size(); }
  /// Loads of one tooth at the angle phi of the tip of tooth 1 [rad].
  /// @param above  height above the tip below which the edge does not count [m]
  [[nodiscard]] ToothLoads at(std::size_t tooth, double phi,
                              double above = 0.0) const noexcept;
  /// The same of one tooth at ascending angles of one turn [rad], without axial_x, axial_y.
  [[nodiscard]] std::vector<ToothLoads> loads_at(std::size_t tooth,
                                                 std::span<const double> phi) const;
  /// Mean loads over a turn, of all teeth, without moments over the height.
  [[nodiscard]] ToothLoads mean() const noexcept { return mean_; }
  /// Largest chip, across the edge [m].
  [[nodiscard]] double peak_chip() const noexcept { return peak_chip_; }
  /// Angles phi at which the force may have a kink or jump, in [0, 2 pi), ascending [rad].
  [[nodiscard]] std::vector<double> events() const;
  /// Whether forces jump at events: edges without lag.
  [[nodiscard]] bool jumps() const noexcept { return jumps_; }

 private:
  /// F_x, F_y, F_z, F_t per height.
  using PerHeight = std::array<double, 4>;
  /// The same, theta to the power of 1, 2, 3 times F_x and F_y, and sin(theta),
  /// cos(theta) times F_z.
  static constexpr std::size_t all_values = 12;
  using Values = std::array<double, all_values>;
  /// Theta of the turn that integrals are of [rad].
  static constexpr double turn_start = -std::numbers::pi / 2;
  static constexpr double turn_end = turn_start + unit::turn;
  static double into_turn(double theta) noexcept;
  /// Where a chip is largest.
  struct Crest {
    double theta = 0.0;  ///< [rad]
    double h = 0.0;      ///< [m]
  };
  /// Chips over the marks of the teeth before, at equal steps of theta: cubics between
  /// them take the place of C-5. Empty: they are computed where they are asked for.
  struct MarkTable {
    double start = 0.0;             ///< theta of the second of the places [rad]
    double step = 0.0;              ///< [rad]
    int steps = 0;                  ///< from the second place to the last but one
    std::vector<double> over = {};  ///< shape (steps + 3, marks) [m]
  };
  /// The edge of a tooth within a layer.
  struct Edge {
    int place = -1;        ///< among the teeth that are there; negative: it is not
    double r = 0.0;        ///< nominal radius [m]
    double R = 0.0;        ///< from the axis of rotation [m]
    double epsilon = 0.0;  ///< [rad]
    double sin_kappa = 1.0;
    double cos_kappa = 0.0;
    double length = 1.0;  ///< of edge per height
    double behind = 0.0;  ///< phi less the effective theta at the lower end [rad]
    double q = 0.0;       ///< d lag/dz [rad/m]; negative: left-hand
    std::vector<double> advance = {};  ///< N-18, for each mark [m]; empty: no fall
    MarkTable table = {};
    numerics::PiecewiseIntegral<all_values> integral;
    std::vector<double> ends = {};   ///< of pieces, theta [rad]
    std::vector<Crest> crests = {};  ///< of each piece

    Edge();
  };
  struct Layer {
    double from = 0.0;      ///< [m]
    double to = 0.0;        ///< [m]
    chip::Passage passage;  ///< of the teeth that are there
    std::vector<chip::ReachedArc> arcs = {};
    std::vector<geometry::EdgePosition> positions = {};  ///< of those, at its middle
    std::vector<Edge> edges = {};                        ///< of all teeth
  };
  struct Ray {
    double h;
    int bound;  ///< what bounds the chip; -1: air
  };

  [[nodiscard]] Layer slab_of(const Setup& setup, geometry::Arc slab) const;
  /// What all layers have in common where the stock bounds no chip.
  void find_unbounded(const Setup& setup, const geometry::Arcs& arcs);
  [[nodiscard]] std::vector<chip::ReachedArc> reached(
      const Layer& layer, std::span<const geometry::ArcLayer> given) const;
  void add_slab(const Setup& setup, const geometry::ArcLayer& given,
                geometry::Arc slab);
  void add_cones(const geometry::ToothEdges& edges, const Setup& setup,
                 const geometry::ArcLayer& given, geometry::Arc layer);
  void add_cone(const geometry::ToothEdges& edges, const Setup& setup,
                const geometry::ArcLayer& given, geometry::Arc slab);
  void finish(Layer&& layer, const geometry::ArcLayer& given);
  [[nodiscard]] Ray ray(const Layer& layer, const Edge& edge,
                        double theta) const noexcept;
  /// What is stock of a chip of thickness h.
  [[nodiscard]] double in_stock(const Layer& layer, const Edge& edge, double theta,
                                double h) const noexcept;
  /// Where the table of an edge has four places about theta.
  struct InTable {
    std::size_t first;             ///< place of the first of them
    std::array<double, 4> weight;  ///< of each
  };
  [[nodiscard]] static std::optional<InTable> in_table(const Edge& edge,
                                                       double theta) noexcept;
  /// Chip over a mark by the table.
  [[nodiscard]] double over_mark(const Layer& layer, const Edge& edge, int mark,
                                 const InTable& at) const noexcept;
  void fill_table(const Layer& layer, Edge& edge) const;
  /// What marks leave of the ray, whatever the stock.
  struct OverMarks {
    double h;
    int mark;  ///< 0: none, up to the axis
  };
  [[nodiscard]] OverMarks over_marks(const Layer& layer, const Edge& edge,
                                     double theta) const noexcept;
  /// Chip over one mark, or the closest one if it is 0.
  [[nodiscard]] double chip_over(const Layer& layer, const Edge& edge, int mark,
                                 double theta) const noexcept;
  /// @param direction  sine and cosine of theta
  [[nodiscard]] PerHeight per_height(const Edge& edge, double h,
                                     std::array<double, 2> direction) const noexcept;
  /// @param unbounded  the same edge where the stock bounds nothing, if it is known
  void add_tooth(const Layer& layer, Edge& edge, const Edge* unbounded);
  void add_unbounded(const Edge& unbounded, Edge& edge, geometry::Arc stretch);
  void add_stretch(const Layer& layer, Edge& edge, double from, double to);
  void add_smooth(const Layer& layer, Edge& edge, geometry::Arc piece, int mark);
  void add_windows(const Layer& layer, const Edge& edge, std::span<const double> phi,
                   std::span<ToothLoads> out) const;
  /// Integrals over the windows of theta that a layer covers, from a height on.
  /// @param use  use(integrals of the first Q of Values, theta of its lower end [rad])
  template <std::size_t Q, class Use>
  void for_each_window(const Layer& layer, const Edge& edge,
                       std::array<double, 2> phi_and_from, const Use& use) const;
  /// @param from  height from which the edge counts [m]
  void add_layer(const Layer& layer, const Edge& edge, double phi, double from,
                 ToothLoads& out) const noexcept;
  /// An edge without lag in its layer: all of it is at one theta.
  [[nodiscard]] bool at_one_angle(const Layer& layer, const Edge& edge) const noexcept;
  [[nodiscard]] PerHeight force_at_one_angle(const Layer& layer, const Edge& edge,
                                             double theta) const noexcept;

  chip::Passage passage_;
  Options options_;
  double r_ = 0.0;
  std::vector<double> psi_;  ///< of the tips [rad]
  double lag_per_height_ = 0.0;
  double edge_factor_ = 1.0;
  double tolerance_;
  bool jumps_ = false;
  Terms law_;
  std::optional<Layer> unbounded_;  ///< of cylinders whose runout is the same all along
  std::vector<Layer> layers_;
  ToothLoads mean_;
  double peak_chip_ = 0.0;
};

}  // namespace trochoid::force
