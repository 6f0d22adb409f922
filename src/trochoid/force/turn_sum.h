#pragma once

#include "turn_waves.h"

#include <utility>
#include <vector>

namespace trochoid::force {

/// @brief The sum over all that begins and ends in a turn (F-11): steps in any order in,
/// segments out.
class TurnSum {
 public:
  explicit TurnSum(int highest);

  /// @brief Keep a copy of a row.
  /// @return the place by which steps name it
  int keep(ConstWaveRow row);
  [[nodiscard]] ConstWaveRow row(int place) const noexcept;

  /// Whether a step is the first or the last of what it belongs to. Where all is over,
  /// the sum is exactly 0.
  enum class Part { first = 1, middle = 0, last = -1 };

  /// @brief From `at` on, add sign times {a row, whose mean stands for a linear term
  /// that is 0 there, and a constant}.
  void step(double at, int place, double sign, const Triple& constant, Part part);
  /// From `at` on, add sign times {a row with its mean as it is}.
  void jump(double at, int place, double sign, Part part);
  /// From `at` on, add a constant.
  void constant(double at, const Triple& value, Part part);
  /// Between two angles, add a panel.
  void panel(double from, double to, const TurnPanel& panel);

  [[nodiscard]] TurnPolynomial finish();

 private:
  struct Step {
    double at;
    int place;      ///< of a row; -1: none
    double linear;  ///< sign of the linear term
    double sign;
    Part part;
    Triple constant;
  };
  struct Support {
    double from;
    double to;
    int panel;
  };
  void apply(const Step& step, std::span<Triple> sum) const noexcept;
  void place_panels(TurnPolynomial& turn) const;

  int highest_;
  std::vector<Triple> rows_;
  std::vector<Step> steps_;
  std::vector<Support> supports_;
  std::vector<TurnPanel> panels_;
};

}  // namespace trochoid::force
