#pragma once

#include <trochoid/identification/problem.h>

#include <span>

namespace trochoid::identification {

/// How to take derivatives.
struct Step {
  double parameter = 1e-4;  ///< of the scaled runout and of the exponents
  double phase = 1e-4;      ///< [rad]
};

/// @brief d[D]/dp_i {K} as quotients of differences over one step: one more evaluation
/// each.
///
/// A phase concerns one run and needs no new matrix, and no difference where the rows are
/// from the turn.
class Derivatives {
 public:
  explicit Derivatives(const Problem& problem) : problem_(problem) {}

  /// @param K    shape (columns) or more
  /// @param[out] out  shape (rows)
  void find(const Evaluation& at, std::span<const double> K, int i, const Step& step,
            std::span<double> out);

 private:
  void find_by_phase(const Evaluation& at, std::span<const double> K, std::size_t r,
                     double step, std::span<double> out);

  const Problem& problem_;
  Evaluation moved_;       ///< whose memory serves again
  std::vector<double> C_;  ///< of one run
};

}  // namespace trochoid::identification
