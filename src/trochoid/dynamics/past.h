#pragma once

#include <trochoid/dynamics/cut_force.h>
#include <trochoid/dynamics/engaged_grid.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace trochoid::dynamics {

/// @brief q of all nodes that delays may ask for, and of the current turn: at rest to
/// begin with.
class Past {
 public:
  explicit Past(const EngagedGrid& grid)
      : turn_(grid.angle.size()), memory_(grid.memory() + spare), now_(memory_) {
    for (auto* values : {&x_, &y_, &dx_, &dy_}) {
      values->assign(memory_ + turns * turn_ + 1, 0.0);
    }
  }

  /// Index 0 is the node that comes next.
  [[nodiscard]] History next() const noexcept {
    const std::size_t i = now_ + 1;
    return {x_.data() + i, y_.data() + i, dx_.data() + i, dy_.data() + i};
  }

  /// Index 0 is the last node.
  [[nodiscard]] History last() const noexcept {
    return {x_.data() + now_, y_.data() + now_, dx_.data() + now_, dy_.data() + now_};
  }

  void set(const std::array<double, 2>& q, const std::array<double, 2>& slope) {
    x_[now_] = q[0];
    y_[now_] = q[1];
    dx_[now_] = slope[0];
    dy_[now_] = slope[1];
  }

  void add(const std::array<double, 2>& q, const std::array<double, 2>& slope) {
    ++now_;
    set(q, slope);
  }

  [[nodiscard]] std::array<double, 2> q() const { return {x_[now_], y_[now_]}; }

  /// After a turn: forget what no delay reaches any more, if room is needed.
  void finish_turn() {
    if (now_ < memory_ + turns * turn_) {
      return;
    }
    for (auto* values : {&x_, &y_, &dx_, &dy_}) {
      std::copy(values->end() - static_cast<std::ptrdiff_t>(memory_ + 1), values->end(),
                values->begin());
    }
    now_ = memory_;
  }

  /// After a turn: as if there had been many like it.
  void repeat_turn() {
    for (auto* values : {&x_, &y_, &dx_, &dy_}) {
      for (std::size_t i = memory_; i-- > 0;) {
        (*values)[i] = (*values)[i + turn_];
      }
    }
    now_ = memory_;
  }

 private:
  static constexpr std::size_t turns = 4;  ///< that there is room for
  /// Remembered beyond the oldest delay, for the places between nodes.
  static constexpr std::size_t spare = 4;

  std::size_t turn_;
  std::size_t memory_;
  std::size_t now_;
  std::vector<double> x_;
  std::vector<double> y_;
  std::vector<double> dx_;
  std::vector<double> dy_;
};

}  // namespace trochoid::dynamics
