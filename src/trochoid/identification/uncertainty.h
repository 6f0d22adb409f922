#pragma once

#include <trochoid/identification/sandwich.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::identification {

/// Singular values of [D] below this part of the largest are zero: a hundred times what
/// the force matrix is accurate to in the last fit.
inline constexpr double rank_tolerance = 1e-8;
/// Error of the force matrix in the last fit, relative to its largest entries.
inline constexpr double final_tolerance = 1e-10;

/// @brief How well the unknowns are known: linear ones first, then p.
struct Uncertainty {
  /// Why an unknown is not determined; empty: it is. Shape (linear + count).
  std::vector<std::string> reason;
  std::vector<bool> unmeasured;  ///< not determined for want of a channel
  /// The fit sits where a tooth just starts or stops cutting: determined, but by two
  /// different slopes, so that it has no standard error. It counts as known.
  std::vector<bool> on_edge;
  std::vector<double> covariance;  ///< shape (linear + count, linear + count)
  double freedom = 0.0;            ///< equations less unknowns
  double quantile_freedom = 0.0;   ///< of the intervals: no more than that
  /// Intervals of the coefficients over those that white noise would give (rms of them).
  double widening = 1.0;
  double chance = 0.0;  ///< that one unknown explains by chance, on average [N^2]
};

/// @brief Why unknowns that only act on forces that are not measured have no value.
/// @param D  at any place
/// @return shape (linear), empty texts for all others
std::vector<std::string> unmeasured_reasons(const Problem& problem,
                                            const numerics::Columns& D);

/// Names of the summary, in the order of Uncertainty::reason.
std::vector<std::string> names_of(const Problem& problem);

/// @brief Covariance of all unknowns from the full Jacobian.
///
/// @eq I-4 J = [[D] | d[D]/dp {K}], cov = RSS/(n - dim K - dim p) (J^T J)^-1
///
/// That is for white noise; where the runs are given, by what they hold of the spectrum
/// (I-14, I-15), and where they are too short for one, by their neighbours (I-13).
///
/// Not determined is an unknown whose whole range changes the force by less than 1e-6
/// of it, and one that takes part in a combination whose singular value, with columns
/// of unit norm, is below 1e-6 of the largest.
/// @param at   at the minimum; given away, its memory serves
/// @param K    there, shape (linear)
/// @param left  what the fit leaves; without runs: white noise
Uncertainty uncertainty(const Problem& problem, Evaluation at,
                        std::span<const double> K, const Leftover& left);

/// @brief The same, evaluated at p.
Uncertainty uncertainty(const Problem& problem, std::span<const double> p,
                        std::span<const double> K, const Leftover& left);

/// @brief The Jacobian of I-4, by columns: [D] and the derivatives beside it.
/// @param at  at the minimum; given away, its memory serves
/// @param K   there, shape (linear), or the coefficients alone
std::vector<double> jacobian_of(const Problem& problem, Evaluation at,
                                std::span<const double> K);

/// @brief Sum of squares of the folded rows about the means of the channels (or, with
/// channel offsets, about constants and slopes) [N^2].
double rss_of_means(const Problem& problem);

/// @brief The only direction of the eccentricity that the record determines, if it
/// determines but one [rad].
///
/// Judged by the radii alone (first order), after the other unknowns have had their
/// share: one direction must change the force by at least 1 % of what the other does, and half as
/// much as the fit leaves unexplained of the force.
/// @param unexplained  part of the force that the fit leaves, rms, from 0 to 1
std::optional<double> single_direction(const Problem& problem,
                                       std::span<const double> p,
                                       std::span<const double> K, double unexplained);

}  // namespace trochoid::identification
