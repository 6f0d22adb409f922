#pragma once

#include <trochoid/chip/intervals.h>
#include <trochoid/force/setup.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/numerics/pieces.h>

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

namespace trochoid::force {

/// One point of all edges at a height: what does not depend on the spindle angle.
struct EdgePoint {
  double s = 0.0;  ///< arc length along the meridian [m]
  geometry::MeridianPoint meridian;
  double lag = 0.0;  ///< [rad]
  double dS = 1.0;   ///< edge length per ds, as the setup asks
};

/// One tooth at an edge point and a spindle angle.
struct EdgeState {
  chip::Chip chip;
  double theta = 0.0;  ///< effective immersion angle [rad]
  double R = 0.0;      ///< distance from the axis of rotation [m]
  [[nodiscard]] bool active() const noexcept { return chip.in_cut; }
  [[nodiscard]] int branch() const noexcept { return chip.bounds; }
  [[nodiscard]] double margin() const noexcept { return chip.margin; }
};

/// @brief The edges of a cutter within the axial depth.
struct Edges {
  /// @param tolerance  of forces, relative; decides how closely the tip is looked at
  explicit Edges(const Setup& given, double tolerance = 1e-6);

  [[nodiscard]] EdgePoint point(double s) const noexcept;
  /// Where there is stock at a point, if arcs say it.
  [[nodiscard]] std::span<const geometry::EngagedArc> arcs_at(
      const EdgePoint& point) const noexcept;

  Setup setup;
  geometry::Meridian meridian;
  chip::Passage passage;
  std::vector<double> psi;   ///< [rad], shape (teeth)
  std::vector<double> ends;  ///< where the profile or the panels end [m], ascending
  std::vector<double> lag_at_ends;     ///< [rad]
  std::vector<double> grid;            ///< ends and points between them [m], ascending
  std::vector<EdgePoint> grid_points;  ///< shape (grid)
  std::vector<geometry::EdgePosition> grid_teeth;  ///< there, shape (grid, teeth)
  std::vector<std::vector<double>> meetings;       ///< of each tooth with others [m]
};

/// @brief How the axis of a bent cutter stands in y, at one spindle angle.
struct Bend {
  std::function<double(double z)> shift;  ///< of the axis in y at a height [m]
  bool deflected = true;  ///< false: the stock stands elsewhere, and nothing gives
  /// How much farther out on its ray a tooth stands than the teeth before it did when
  /// they left their marks there [m], shape (teeth); empty: as far as they did.
  std::function<void(double z, std::size_t tooth, double theta, std::span<double> out)>
      advance;
};

/// @brief One edge at one spindle angle, as a curve over s for numerics::PieceFinder.
class EdgeCurve {
 public:
  /// @param bend  of the cutter, or none; must outlive this
  explicit EdgeCurve(const Edges& edges, const Bend* bend = nullptr)
      : edges_(edges),
        bend_(bend),
        teeth_(edges.psi.size()),
        advance_(edges.psi.size()) {}

  /// @param phi  angle of the tip of tooth 1 [rad]
  void stand_at(double phi, std::size_t tooth) noexcept {
    tooth_ = tooth;
    theta_tip_ = phi - edges_.psi[tooth];
  }

  /// @brief Add the points near which a short cut along the edge can hide, and sort:
  /// where the edge passes the front of the tool and the edges of the stock, and where
  /// it meets another tooth.
  void add_seeds(std::vector<double>& grid) const;

  [[nodiscard]] EdgeState state(double s) const;
  [[nodiscard]] EdgeState state(const EdgePoint& point) const;
  [[nodiscard]] double boundary(double s, const EdgeState& a, const EdgeState& b) const;

 private:
  [[nodiscard]] EdgeState state(const EdgePoint& point, const chip::Slice& teeth) const;
  [[nodiscard]] chip::Slice slice(const EdgePoint& point) const;
  /// Where the edge passes an angle.
  void add_passages(double target, std::vector<double>& grid) const;
  void add_stock_edge(double y, std::vector<double>& grid) const;

  const Edges& edges_;
  const Bend* bend_;
  std::size_t tooth_ = 0;
  double theta_tip_ = 0.0;
  mutable std::vector<geometry::EdgePosition> teeth_;
  mutable std::vector<double> advance_;
};

/// @brief The stretches of all edges along which nothing switches, at one spindle angle:
/// ends of the profile and switches of the chip part them, as a quadrature needs it.
/// @param curve       of these edges
/// @param resolution  to which switches are found [m]
/// @param visit       visit(from, to) with the curve at the tooth in question [m]
template <class Visit>
void for_each_stretch(const Edges& edges, EdgeCurve& curve, double phi,
                      double resolution, const Visit& visit) {
  numerics::PieceFinder<EdgeCurve> finder(curve, resolution);
  std::vector<numerics::Piece<EdgeState>> pieces;
  std::vector<double> grid;
  for (std::size_t j = 0; j < edges.psi.size(); ++j) {
    curve.stand_at(phi, j);
    grid = edges.grid;
    curve.add_seeds(grid);
    finder.find(grid, pieces);
    for (const auto& piece : pieces) {
      double from = piece.from;
      for (const double end : edges.ends) {
        const double to = std::min(end, piece.to);
        if (to > from) {
          visit(from, to);
          from = to;
        }
      }
    }
  }
}

/// @brief Where along the edges two teeth stand on one ray from the axis of rotation.
///
/// Near the axis an eccentricity turns the teeth so far that one passes the other. There
/// the mark of the one before, as the exact chip model takes it, turns from new to a
/// turn old, whatever the spindle angle: chips jump.
///
/// @return arc lengths [m] for each tooth, shape (teeth); empty lists where chips do not
///         know of it
std::vector<std::vector<double>> meetings(const Edges& edges);

}  // namespace trochoid::force
