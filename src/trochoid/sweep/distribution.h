#pragma once

#include <trochoid/results/joint.h>

#include <cstddef>
#include <optional>
#include <random>
#include <span>
#include <vector>

namespace trochoid::sweep {

/// @brief Numbers by chance from 0 to 1, neither of them: the same on every machine.
/// @param stratified  each column hits each of `rows` stretches of equal length once
/// @return shape (columns, rows), row-major
std::vector<double> chances(std::mt19937_64& random, std::size_t columns,
                            std::size_t rows, bool stratified);

/// @brief Where a share p of the normal distribution of mean 0 and variance 1 lies below.
double normal_quantile(double p);

/// @brief How numbers that were found together scatter about what they may be.
struct Distribution {
  std::vector<double> value;    ///< what was found
  std::vector<bool> in_log;     ///< numbers of modes, which are above zero by nature
  std::vector<double> freedom;  ///< of Student's t; 0: normal
  std::vector<double> root;     ///< L of U-2, of the logarithms where in_log

  [[nodiscard]] std::size_t size() const noexcept { return value.size(); }
  /// Chances that one draw takes: one for each number, and one for all.
  [[nodiscard]] std::size_t chances() const noexcept { return size() + 1; }
};

/// @brief The degrees of freedom of which half of a 95 % interval is w standard errors.
///
/// @eq U-3 nu with t_0.975(nu) = w; none where w is that of the normal distribution
/// @src definition
/// @param w  not below 1.96 but for rounding
/// @return 0: none
double freedom_of(double w);

/// @return none where the covariance is none, or a number that must be above zero is not
std::optional<Distribution> distribution_of(const results::Joint& joint);

/// @brief One draw.
///
/// @eq U-4 x_i = x^_i + s_i (L z)_i, z normal and independent, s_i = sqrt(nu_i/q_i), q_i
///          where a share u of chi^2 of nu_i degrees of freedom lies below, u the same for
///          all; s_i = 1 without nu
/// @eq U-5 of what is above zero by nature: ln x_i = ln x^_i + s_i (L z)_i, L of
///          C_ij/(x^_i x^_j), so that no draw is below zero and ones within a narrow
///          interval are those of U-4
/// @src derived: Student's t of several numbers, standard where all nu are the same
/// @param chance  from 0 to 1, neither of them, shape (d.chances())
/// @return shape (d.size())
std::vector<double> drawn(const Distribution& d, std::span<const double> chance);

}  // namespace trochoid::sweep
