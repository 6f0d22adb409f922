#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/dynamics/engaged_grid.h>

#include <span>
#include <vector>

namespace trochoid::dynamics {

/// An angle along an edge: runout that turns with the edge moves it.
struct LaggingAngle {
  double tip = 0.0;         ///< [rad]
  double per_lag = 0.0;     ///< slope over the lag
  double per_square = 0.0;  ///< [1/rad]
};

/// An arc of nominal immersion angles in which the chip without vibration is smooth.
struct ChipArc {
  LaggingAngle from;
  LaggingAngle to;
  bool begins = false;  ///< h = 0 at from
  bool ends = false;    ///< h = 0 at to
};

/// A point of an edge, and how much of it that point stands for.
struct EdgePlace {
  double theta = 0.0;   ///< nominal immersion angle [rad]
  double lag = 0.0;     ///< behind the tip [rad]
  double height = 0.0;  ///< [m]
};

/// @brief Which points of the edges may be in cut at a spindle angle.
///
/// Without helix a tooth is one point. With it, each smooth piece of the edge gets
/// Gauss nodes, drawn towards the ends where the chip begins: there the force of a
/// power law rises with an infinite slope.
class EdgePoints {
 public:
  /// @param setup   a cylinder, outliving this
  /// @param points  for every piece of an edge with helix
  EdgePoints(const force::Setup& setup, int points, std::size_t lookback);

  /// With helix no tooth enters all at once.
  [[nodiscard]] bool helix() const noexcept { return whole_lag_ > 0; }

  /// Spindle angles in one turn where an edge enters or
  /// leaves what it may cut [rad], ascending.
  [[nodiscard]] const std::vector<double>& events() const noexcept { return events_; }

  /// Whether one of the events is next to an angle in [0, 2 pi) [rad].
  [[nodiscard]] bool at_event(double phi) const noexcept;

  /// @brief Add the stretches of all teeth to a grid.
  /// @param side  which side of phi counts where a tip enters or leaves [rad]
  [[nodiscard]] Contacts add(double phi, double side, EngagedGrid& grid) const;

 private:
  /// Where a tooth may cut, and where that begins, ends or changes [rad].
  struct Reach {
    std::vector<ChipArc> arcs;  ///< ascending, each meeting the next
    std::vector<double> events;
  };

  [[nodiscard]] std::vector<double> breaks(std::size_t tooth, double lag,
                                           std::vector<double>& events) const;
  [[nodiscard]] Reach reach_of(std::size_t tooth) const;
  [[nodiscard]] std::vector<geometry::EdgePosition> positions(double lag) const;
  void chips(const chip::Slice& slice, std::size_t tooth, double theta,
             std::span<double> above) const;
  [[nodiscard]] double least_chip(std::size_t tooth, double theta, double lag) const;
  void find_places(std::size_t tooth, double tip, double side,
                   std::vector<EdgePlace>& places) const;
  void add_arc(const ChipArc& arc, double tip, std::vector<EdgePlace>& places) const;

  const force::Setup& setup_;
  std::size_t lookback_;
  chip::Passage passage_;
  std::vector<double> psi_;
  double r_ = 0.0;
  double whole_lag_ = 0.0;        ///< of the top behind the tip [rad]; 0: no helix
  double edge_per_height_ = 1.0;  ///< length of edge
  bool turning_ = false;          ///< does runout change along the edge?
  std::vector<geometry::EdgePosition> tips_;
  std::vector<double> events_;  ///< ascending
  std::vector<Reach> reach_;
  std::vector<double> gauss_t_;  ///< in (0, 1)
  std::vector<double> gauss_w_;
};

}  // namespace trochoid::dynamics
