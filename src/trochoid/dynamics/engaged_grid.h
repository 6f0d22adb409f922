#pragma once

#include <trochoid/force/setup.h>

#include <array>
#include <cstddef>
#include <vector>

namespace trochoid::dynamics {

/// The points of one tooth that may be in cut at one angle, from the tip upwards.
struct Stretch {
  std::size_t tooth = 0;
  std::size_t first = 0;  ///< point
  std::size_t count = 0;  ///< of points
  std::size_t marks = 0;  ///< where its a_jm begin in EngagedGrid::above
};

/// Stretches from first to last, excluded.
struct Contacts {
  std::size_t first = 0;
  std::size_t last = 0;
};

/// Where between two nodes of the past a moment lies, and how q there follows from
/// both (Hermite).
struct Delay {
  std::size_t back = 0;            ///< so many nodes before is the earlier one
  std::array<double, 4> weight{};  ///< of q, q of the later one, dq/dphi, the other's
};

/// @brief The cut over one revolution at fixed angles, apart from vibration.
///
/// With equal pitches the nodes repeat with every pitch, so that delays by whole teeth
/// are whole numbers of steps; otherwise `delays` says how to look between them. Where
/// a tip enters or leaves the stock there is a node, with the contacts just before and
/// just after it: the force may jump there.
///
/// @eq T-1 h_j = max(0, min_m [a_jm(phi) + (q(t) - q(t - t_m)) . n_j]), n = (sin, cos);
///         a_jm: chip over the mark of the m-th tooth before, without vibration; for
///         m = 0 the stock, which q(t - t_m) = 0 stands for
/// @src [diez2010] eq. 14 with the memory of the surface; derived from C-2 to C-7
struct EngagedGrid {
  std::size_t teeth = 0;
  bool one_point = true;      ///< each stretch: the k-th stretch is then the k-th point
  std::size_t lookback = 0;   ///< how many teeth before are looked at
  std::size_t pitch = 0;      ///< nodes from tooth to tooth; 0: pitches differ
  std::vector<double> angle;  ///< of the nodes of a revolution, from 0 [rad]
  std::vector<double> step;   ///< from each node to the next [rad]
  std::vector<double> sine;   ///< of the effective immersion angles of the points
  std::vector<double> cosine;
  std::vector<double> width;  ///< height that a point stands for [m]
  std::vector<double> edge;   ///< length of edge that it stands for [m]
  std::vector<double> above;  ///< a_jm [m]: m = 0 ... lookback, points of the stretch
  std::vector<Stretch> stretches;
  std::vector<Contacts> before;  ///< of each node
  std::vector<Contacts> after;
  std::vector<char> jump;     ///< do they differ?
  std::vector<Delay> delays;  ///< shape (nodes, teeth, lookback), or empty

  /// Nodes that have to be remembered.
  [[nodiscard]] std::size_t memory() const noexcept {
    return ((lookback + teeth - 1) / teeth) * angle.size();
  }
};

struct GridOptions {
  int steps_per_tooth = 0;  ///< at least; entries and exits add some; 0: as needed
  int points = 12;          ///< of a tooth with helix, for every smooth piece in cut
  int lookback = 0;         ///< 0: twice the number of teeth
};

/// Angles between nodes, for results there.
struct BetweenNodes {
  EngagedGrid grid;               ///< at those angles, delays counted from `node`
  std::vector<std::size_t> node;  ///< the node that follows each
  std::vector<double> part;       ///< of the step before it, in [0, 1)
};

}  // namespace trochoid::dynamics
