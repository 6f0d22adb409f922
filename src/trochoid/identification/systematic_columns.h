#pragma once

#include <trochoid/identification/problem.h>
#include <trochoid/identification/systematic.h>
#include <trochoid/numerics/columns.h>

#include <span>
#include <vector>

/// What systematic errors change of the rows of a problem.
namespace trochoid::identification {

/// @brief The rows of a problem as its answer computes them.
struct ComputedRows {
  const Problem& problem;
  std::span<const double> p;      ///< of the answer
  std::span<const double> x;      ///< its linear unknowns
  std::span<const double> force;  ///< force_rows
};

/// Computed force, without the constants of channels, shape (rows).
std::vector<double> force_rows(const Problem& problem, const Evaluation& at,
                               std::span<const double> x);

/// @brief Change of the rows with one unit; empty: there is none, as of the radial depth of
/// a slot.
std::vector<double> systematic_column(const ComputedRows& computed,
                                      const Systematic& one);

/// @brief Let a covariance contain the tolerances of the problem, and the errors of the
/// offsets that were taken out of its runs.
/// @eq I-24 cov + sum over systematics of sd^2 x x^T, x = (J^T J)^-1 J^T c
/// @param J           columns of the unknowns that are determined
/// @param covariance  of these, row-major
void add_tolerances(const ComputedRows& computed, const numerics::Columns& J,
                    std::span<double> covariance);

}  // namespace trochoid::identification
