#pragma once

#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/motion_problem.h>
#include <trochoid/dynamics/stepper.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace trochoid::dynamics {

/// One step that was taken. The past is that at its end.
struct TakenStep {
  int turn = 0;
  std::size_t node = 0;  ///< where it began
  double dt = 0.0;       ///< [s]
  Snapshot from;
  Snapshot to;
  History past;
};

/// @brief Samples of the kept revolutions.
class MotionSamples {
 public:
  MotionSamples(const MotionProblem& problem, const EngagedGrid& grid);

  /// Whether any fall into the step that begins at a node.
  [[nodiscard]] bool wants(std::size_t node) noexcept {
    if (node == 0) {
      next_ = 0;
    }
    return next_ < samples_.node.size() && samples_.node[next_] == node + 1;
  }
  /// Those that fall into a step.
  void add(const TakenStep& step, Motion& motion);
  /// The command of a kept step, at its middle.
  void add_command(double t, double command) { commands_.emplace_back(t, command); }
  /// The command at the samples.
  void finish(Motion& motion) const;

 private:
  const MotionProblem& problem_;
  BetweenNodes samples_;
  CutForce cut_;
  std::size_t next_ = 0;
  std::vector<std::pair<double, double>> commands_;
};

/// @brief What each flute does in the last revolutions, as many as are watched.
class FluteWatch {
 public:
  FluteWatch(const MotionProblem& problem, const EngagedGrid& grid);

  /// A step of a turn that is watched, and the force at its start.
  void add(const TakenStep& step, const Force& F, Motion& motion);

 private:
  const EngagedGrid& grid_;
  bool helix_ = false;
  BetweenNodes tips_;  ///< the tips at every node, where the grid has more than them
  CutForce cut_;
  std::vector<double> before_;      ///< chip of each tooth a node before, or NaN
  std::vector<double> now_;         ///< and at the node
  std::vector<std::size_t> flute_;  ///< whose turn it is at each node
};

/// @brief After how many teeth the force is as it was, from the last turns.
///
/// @eq T-15 passes: the least k with |F(phi) - F(phi - k pitches)| <= peak/300 at every
///          node of the last turn, and of the last k pitches
/// @src derived
class TurnComparison {
 public:
  explicit TurnComparison(const EngagedGrid& grid);

  /// Turns at the end that it wants to see.
  [[nodiscard]] int turns() const noexcept { return static_cast<int>(turns_); }
  void add(int turn, std::size_t node, const Force& F);
  /// An edge force came or went in the step that began at this node.
  void forget(int turn, std::size_t node);
  void finish(Motion& motion) const;

 private:
  /// Nodes of the record, from one to another, excluded.
  struct Window {
    std::size_t from = 0;
    std::size_t to = 0;
  };
  [[nodiscard]] double change(std::size_t shift, Window window, double enough) const;
  [[nodiscard]] double persistence(std::size_t shift) const;
  [[nodiscard]] std::size_t place(std::size_t turn, std::size_t node) const noexcept {
    return (turn % turns_) * nodes_ + node;
  }

  std::size_t nodes_;
  std::size_t teeth_;
  std::size_t pitch_;  ///< nodes from tooth to tooth; 0: pitches differ
  std::size_t turns_;
  std::size_t done_ = 0;   ///< nodes seen since the start, were all seen
  std::size_t first_ = 0;  ///< the first of those
  std::vector<Force> force_;
  std::vector<char> forgotten_;
};

}  // namespace trochoid::dynamics
