#pragma once

#include <trochoid/identification/problem.h>

#include <span>
#include <vector>

namespace trochoid::identification {

/// How to take derivatives.
struct Step {
  double parameter = 1e-4;  ///< of the scaled runout and of the exponents
  double phase = 1e-4;      ///< [rad]
};

/// @brief d[D]/dp_i {K} at one place, as quotients of differences over one step: the force
/// of these coefficients once more for each. Where rows are from the turn, a phase needs
/// no difference.
class Derivatives {
 public:
  /// @param at  whose [D] is asked for here only
  /// @param K   shape (columns) or more
  Derivatives(const Problem& problem, const Evaluation& at, std::span<const double> K);

  /// @param[out] out  shape (rows)
  void find(int i, const Step& step, std::span<double> out) const;

 private:
  [[nodiscard]] std::span<const double> coefficients(std::size_t r) const;
  void add_force(const Point& point, std::size_t r, double factor,
                 std::span<double> out) const;
  void find_by_phase(std::size_t r, double step, std::span<double> out) const;
  [[nodiscard]] std::span<double> rows_of_run(std::size_t r,
                                              std::span<double> all) const;

  const Problem& problem_;
  const Evaluation& at_;
  std::vector<double> K_;
  std::vector<double> force_;  ///< [D] {K} at the place
};

}  // namespace trochoid::identification
