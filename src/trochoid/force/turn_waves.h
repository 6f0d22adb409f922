#pragma once

#include <trochoid/force/turn_terms.h>
#include <trochoid/numerics/trig_polynomial.h>

#include <array>
#include <span>
#include <utility>
#include <vector>

/// Three trigonometric polynomials at once, as a row: mean, then the factors of cos(x),
/// sin(x), cos(2 x), sin(2 x) ... up to a harmonic that all rows of a turn share.
namespace trochoid::force {

/// a + factor b. Read before anything is written, so that it becomes whole vectors.
constexpr Triple plus(const Triple& a, const Triple& b, double factor) noexcept {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2],
          a[3] + factor * b[3]};
}
/// factor a.
constexpr Triple scaled(const Triple& a, double factor) noexcept {
  return {factor * a[0], factor * a[1], factor * a[2], factor * a[3]};
}
/// factor_a a + factor_b b.
constexpr Triple mixed(const Triple& a, double factor_a, const Triple& b,
                       double factor_b) noexcept {
  return {factor_a * a[0] + factor_b * b[0], factor_a * a[1] + factor_b * b[1],
          factor_a * a[2] + factor_b * b[2], factor_a * a[3] + factor_b * b[3]};
}

using WaveRow = std::span<Triple>;
using ConstWaveRow = std::span<const Triple>;

constexpr std::size_t waves_of(int highest) noexcept {
  return 1 + 2 * static_cast<std::size_t>(highest);
}

/// Cosine and sine of the multiples of an angle.
struct Turned {
  Turned(double angle, int highest) noexcept;

  std::array<double, numerics::TrigPolynomial::most + 2> cosine;
  std::array<double, numerics::TrigPolynomial::most + 2> sine;
};

/// @brief g of theta (F-10): the weights applied to a chip.
/// @param h  chip, or null: where only the edge counts
void integrand(const numerics::TrigPolynomial* h, const TurnWeights& weights,
               double edge_factor, WaveRow g) noexcept;

/// @brief factor times the antiderivative; its linear term is the mean of the row.
void integrate(ConstWaveRow g, double factor, WaveRow G) noexcept;

/// @brief The same function of an angle that is ahead of x by a given one.
void shift_back(ConstWaveRow p, const Turned& by, double factor, WaveRow out) noexcept;

/// sum += factor p, row by row.
void add(ConstWaveRow p, double factor, WaveRow sum) noexcept;

/// Value at an angle, without the mean.
Triple waves_at(ConstWaveRow p, const Turned& x) noexcept;

/// Slope at an angle.
Triple wave_slope_at(ConstWaveRow p, const Turned& x) noexcept;

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
