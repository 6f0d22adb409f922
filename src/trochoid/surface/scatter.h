#pragma once

#include <trochoid/surface/readings.h>

#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::surface {

/// Rows of a fit that share an error: which level each row belongs to.
struct Sharing {
  std::vector<std::size_t> level;  ///< shape (rows)
  std::size_t levels = 0;
};

/// @brief Who shares an error with whom: readings at one height, at one place along the
/// wall, and at both.
///
/// Of very many heights or places, neighbours count as one; a scan along the wall is
/// stretches of it. What has fewer than four levels, or a level for
/// each row, shows no scatter between them, and is left out.
/// @param feed  of a turn: what lies within is one place [m]
std::vector<Sharing> sharing_of(std::span<const Reading> readings, double feed);

/// @brief How readings scatter about the truth.
///
/// @eq E-20 cov(e) = s^2 (1/n_i delta_ik + sum_l g_l [i and k share level of l])
/// @src derived: random effects of the height, of the place, of both
struct Scatter {
  double s2 = 1.0;                ///< of one reading by itself, in units of the rows
  std::vector<Sharing> sharings;  ///< g_l of each in `ratio`
  std::vector<double> ratio;      ///< g_l, shape (sharings)
  std::vector<double> freedom;    ///< of s2, then of each g_l
};

/// Rows of a fit: columns, the last of which is what is fitted.
struct Rows {
  std::span<const double> values;  ///< row-major, shape (rows, columns)
  std::size_t columns = 0;
  std::span<const double> count;  ///< of readings in each row
};

/// @brief R^T W R, s^2 W the inverse of E-20.
/// @return row-major, shape (columns, columns)
std::vector<double> weighted_products(const Rows& rows, const Scatter& scatter);

/// @brief The scatter that leaves residuals like these behind.
///
/// @eq E-21 |Z_k^T r|^2 = sum_l v_l |Z_k^T M Z_l|_F^2, M = I - A (A^T A)^-1 A^T: linear
///          in the variances v_l = s^2 g_l, of which none is negative
/// @src [rao1971]: quadratic estimates that the fit leaves unbiased
/// @param rows    the columns A of a fit without shared errors, then its residuals
/// @param prior   of each column of A: 1/variance, or 0, in units of s2, shape (columns - 1)
/// @param within  sum of squares of the readings about the rows that are their means
/// @param readings  how many there are
Scatter estimate_scatter(const Rows& rows, std::span<const double> prior,
                         std::vector<Sharing> sharings, double within, double readings);

}  // namespace trochoid::surface
