#pragma once

#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/motion_problem.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::dynamics {

/// Place and speed of every mode, then of the actuator.
using Snapshot = std::vector<std::array<double, 2>>;

/// @brief The state of all that moves, and how it goes on over one step.
///
/// A mode is two states; the driven table and its actuator are four. All are exact for
/// forces that are linear and commands that are constant over the step (T-3). What is
/// carried along is z without the share of the force at the last node, G_1 F: all the
/// rest of the next step can then be computed while that force is not known yet.
class Stepper {
 public:
  /// @param steps  all steps of a revolution [s]
  Stepper(const MotionProblem& problem, std::span<const double> steps);

  /// @brief All of the end of a step that does not depend on the force there.
  /// @param step     its number in `steps`
  /// @param F        force at its start [N]
  /// @param command  x_com during the step [m]
  void begin(std::size_t step, const Force& F, double command) noexcept;

  /// @brief Add a force that is constant over the step begun [N].
  ///
  /// @eq T-5 u(t) + (1/2 - s) dF: what a jump dF at the part s of a step does more than
  ///         a straight line between both ends
  /// @src derived: the same impulse
  void add(const Force& F) noexcept;

  /// @brief q at the end of the step if the force there is F [m].
  [[nodiscard]] std::array<double, 2> end(const Force& F) const noexcept {
    return {base_q_[0] + per_F_[0] * F[0] + per_F_[1] * F[1],
            base_q_[1] + per_F_[1] * F[0] + per_F_[2] * F[1]};
  }

  /// @brief dq/dt at the end of the step if the force there is F [m/s].
  [[nodiscard]] std::array<double, 2> end_speed(const Force& F) const noexcept {
    return sum(1, F);
  }

  /// dq/dF at the end of the step begun: xx, xy, yy [m/N].
  [[nodiscard]] const std::array<double, 3>& per_force() const noexcept {
    return per_F_;
  }
  /// The same of dq/dt [m/(N s)].
  [[nodiscard]] const std::array<double, 3>& speed_per_force() const noexcept {
    return now_->speed_per_F;
  }

  /// @brief Take the step with the force F at its end.
  void accept(const Force& F) noexcept { end_ = F; }

  /// q now [m], and dq/dt [m/s].
  [[nodiscard]] std::array<double, 2> place() const noexcept { return sum(0, end_); }
  [[nodiscard]] std::array<double, 2> speed() const noexcept { return sum(1, end_); }

  /// @brief After a turn that began at rest: the state from which the same forces and
  /// commands would lead back to it.
  ///
  /// @eq T-7 z_0 = (I - Phi_T)^-1 z_T
  /// @src elementary
  /// @param time  of the turn [s]
  void repeat(double time);

  [[nodiscard]] Snapshot snapshot() const;

  /// Place of the driven mode [m]; 0 where none is driven.
  [[nodiscard]] double table() const noexcept {
    return drive_ ? table_z(end_)[0] : 0.0;
  }

 private:
  struct Oscillator {
    double x = 0.0;  ///< direction
    double y = 0.0;
    std::array<double, 2> base{};
  };
  struct OscillatorStep {
    std::array<double, 2> Phi_0{};  ///< columns
    std::array<double, 2> Phi_1{};
    std::array<double, 2> G_0{};
    std::array<double, 2> G_1{};
    std::array<double, 2> carried{};  ///< Phi times the G_1 of the step before
    std::array<double, 2> both{};     ///< carried + G_0
  };
  struct TableStep {
    std::array<std::array<double, 4>, 4> Phi{};  ///< columns
    std::array<double, 4> G_0{};                 ///< of the force
    std::array<double, 4> G_1{};                 ///< of the force
    std::array<double, 4> carried{};  ///< Phi times the G_1 of the step before
    std::array<double, 4> both{};     ///< carried + G_0
    std::array<double, 4> command{};  ///< G_0 + G_1 of the command
  };
  /// Matrices of one step length after another one.
  struct Length {
    double dt = 0.0;
    double before = 0.0;
    std::vector<OscillatorStep> oscillators;
    TableStep table;
    std::array<double, 3> per_F{};        ///< dq/dF at the end: xx, xy, yy
    std::array<double, 3> speed_per_F{};  ///< of dq/dt
  };

  [[nodiscard]] Length length_of(double dt) const;
  [[nodiscard]] std::array<double, 2> sum(std::size_t state,
                                          const Force& F) const noexcept;
  void add_jump(const Force& F) noexcept;
  void carry(const Length& before, Length& length) const;
  [[nodiscard]] std::array<double, 2> z(std::size_t oscillator,
                                        const Force& F) const noexcept;
  [[nodiscard]] std::array<double, 4> table_z(const Force& F) const noexcept;

  System system_;
  std::vector<Oscillator> oscillators_;
  std::vector<std::size_t> mode_of_;  ///< of each oscillator
  std::optional<Drive> drive_;
  double table_x_ = 0.0;
  double table_y_ = 0.0;
  std::array<double, 4> table_{};  ///< base
  std::vector<Length> lengths_;
  std::vector<std::size_t> length_of_step_;
  const Length* now_ = nullptr;
  std::array<double, 2> base_q_{};
  std::array<double, 3> per_F_{};
  Force end_{};  ///< at the last node
};

inline void Stepper::begin(std::size_t step, const Force& F, double command) noexcept {
  now_ = &lengths_[length_of_step_[step]];
  per_F_ = now_->per_F;
  double q_x = 0.0;
  double q_y = 0.0;
  const OscillatorStep* s = now_->oscillators.data();
  for (Oscillator& o : oscillators_) {
    const double f = o.x * F[0] + o.y * F[1];
    const double place = o.base[0];
    const double speed = o.base[1];
    // Local until complete, or the compiler must expect that one changes the other.
    std::array<double, 2> next;
    for (std::size_t a = 0; a < 2; ++a) {
      next[a] = (s->Phi_0[a] * place + s->Phi_1[a] * speed) + s->both[a] * f;
    }
    o.base = next;
    q_x += o.x * o.base[0];
    q_y += o.y * o.base[0];
    ++s;
  }
  if (drive_) {
    const TableStep& t = now_->table;
    const double f = table_x_ * F[0] + table_y_ * F[1];
    const std::array<double, 4> z = table_;
    std::array<double, 4> next;
    for (std::size_t i = 0; i < 4; ++i) {
      next[i] = (((t.Phi[0][i] * z[0] + t.Phi[1][i] * z[1]) +
                  (t.Phi[2][i] * z[2] + t.Phi[3][i] * z[3])) +
                 t.command[i] * command) +
                t.both[i] * f;
    }
    table_ = next;
    q_x += table_x_ * table_[0];
    q_y += table_y_ * table_[0];
  }
  base_q_ = {q_x, q_y};
  if (end_[0] != F[0] || end_[1] != F[1]) {
    add_jump({end_[0] - F[0], end_[1] - F[1], 0.0});
  }
}

}  // namespace trochoid::dynamics
