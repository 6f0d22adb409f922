#pragma once

#include <trochoid/dynamics/motion.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::dynamics {

using Force = std::array<double, 3>;  ///< on the tool [N]

/// Place and speed of every mode, then of the actuator.
using Snapshot = std::vector<std::array<double, 2>>;

/// @brief The state of all that moves, and how it goes on over one step.
///
/// A mode is two states; the driven table and its actuator are four. All are exact for
/// forces and commands that are linear over the step (T-3).
class Stepper {
 public:
  /// @param steps  all step lengths that will come [s]
  Stepper(const MotionProblem& problem, std::span<const double> steps);

  /// @brief All of the end of a step that does not depend on the force there.
  /// @param step     its number in `steps`
  /// @param F        force at its start [N]
  /// @param command  x_com during the step [m]
  void begin(std::size_t step, const Force& F, double command) noexcept;

  /// @brief q at the end of the step if the force there is F [m].
  [[nodiscard]] std::array<double, 2> end(const Force& F) const noexcept {
    return {base_q_[0] + per_F_[0] * F[0] + per_F_[1] * F[1],
            base_q_[1] + per_F_[1] * F[0] + per_F_[2] * F[1]};
  }

  /// @brief Take the step with the force F at its end.
  void accept(const Force& F) noexcept;

  [[nodiscard]] Snapshot snapshot() const;

  /// Place of the driven mode [m]; 0 where none is driven.
  [[nodiscard]] double table() const noexcept { return table_.z[0]; }

 private:
  struct Oscillator {
    double x = 0.0;  ///< direction
    double y = 0.0;
    std::array<double, 2> z{};
    std::array<double, 2> base{};
  };
  struct OscillatorStep {
    std::array<double, 4> Phi{};
    std::array<double, 2> G_0{};
    std::array<double, 2> G_1{};
  };
  struct Table {
    std::array<double, 4> z{};
    std::array<double, 4> base{};
  };
  struct TableStep {
    std::array<double, 16> Phi{};
    std::array<double, 8> G_0{};  ///< columns: force, command
    std::array<double, 8> G_1{};
  };
  /// Matrices of one step length.
  struct Length {
    double dt = 0.0;
    std::vector<OscillatorStep> oscillators;
    TableStep table;
    std::array<double, 3> per_F{};  ///< dq/dF at the end: xx, xy, yy
  };

  [[nodiscard]] Length length_of(const MotionProblem& problem, double dt) const;

  std::vector<Oscillator> oscillators_;
  std::vector<std::size_t> mode_of_;  ///< of each oscillator
  bool driven_ = false;
  std::size_t driven_mode_ = 0;
  double table_x_ = 0.0;
  double table_y_ = 0.0;
  Table table_;
  std::vector<Length> lengths_;
  std::vector<std::size_t> length_of_step_;
  const Length* now_ = nullptr;
  std::array<double, 2> base_q_{};
  std::array<double, 3> per_F_{};
};

}  // namespace trochoid::dynamics
