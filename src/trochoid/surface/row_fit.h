#pragma once

#include <trochoid/surface/datum.h>
#include <trochoid/surface/scatter.h>

#include <functional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What a model says of some rows, and how that changes with its unknowns.
struct Linearised {
  std::vector<double> f;  ///< shape (rows)
  /// How, row-major, shape (rows, unknowns): asked only where the fit goes on from.
  std::function<std::vector<double>()> slopes;
  bool good = true;  ///< false: the model has no answer there
};

/// @param steps  of differences, for a model that takes them; empty: its own
using RowModel =
    std::function<Linearised(std::span<const double> p, std::span<const double> steps)>;

/// Rows to fit, with the form of the wall beside the model.
struct RowProblem {
  std::span<const double> error;  ///< measured, shape (rows)
  std::span<const double> count;  ///< of readings in each row
  double independent = 0.0;       ///< how many values scatter: readings, or means
  DatumColumns form;
  std::vector<double> prior;  ///< 1/variance of each coefficient of the form; 0: open
  Scatter scatter;
};

/// @brief A fit of rows, what is left, and how well everything is known.
struct RowFit {
  bool ok = false;
  std::vector<double> p;           ///< of the model
  std::vector<double> form;        ///< coefficients of the form
  std::vector<double> covariance;  ///< of p, then form: row-major
  std::vector<double> own;         ///< variances if no error were shared: p, then form
  double cost = 0.0;               ///< chi^2 with that of the priors
  double evidence = 0.0;           ///< E-24, but for what all fits of these rows share
  std::vector<double> residual;    ///< shape (rows)
  std::vector<double> columns;     ///< the Jacobian, then the residual, row-major
};

/// @brief Most probable unknowns and form.
///
/// @eq E-23 min over p, d of (e - f(p) - B d)^T W (e - f(p) - B d)/s^2 + sum d_k^2/tau_k^2
/// @src derived: E-17 with the scatter of E-20 and what is known of the form beforehand
RowFit fit_rows(const RowProblem& problem, const RowModel& model,
                std::vector<double> start);

/// The rows by the unknowns, shape (rows); empty: the model has no answer there.
using RowValues = std::function<std::vector<double>(std::span<const double> p)>;

/// @brief The same with slopes from the model itself, along directions that are known
/// independently of one another.
///
/// Coefficients, runout and form nearly make up for one another. Slopes by one unknown
/// after the other nearly cancel there, and what their errors leave would count as
/// knowledge.
/// @eq  E-27 J l_k = (f(p + l_k) - f(p - l_k))/2, l_k the columns of L, C = L L^T
/// @src derived
/// @param fit  where it begins, with its covariance; itself where the model has no answer
RowFit fit_along_errors(const RowProblem& problem, const RowValues& values, RowFit fit);

}  // namespace trochoid::surface
