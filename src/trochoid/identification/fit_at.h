#pragma once

#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/sandwich.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>

#include <span>
#include <string>
#include <vector>

namespace trochoid::identification {

/// @brief Why coefficients cannot be had from [D]; empty: they can.
///
/// Coefficients that cannot be told apart from one another refuse the fit. One that
/// only an unknown channel offset hides is absent, and the others stand.
/// @param all  the least-squares fit of D
std::string rank_refusal(const Problem& problem, const numerics::Columns& D,
                         const numerics::LeastSquares& all);

/// @brief What a fit leaves, as its errors are to be counted.
/// @param fit   with its options, rms and fitted forces
/// @param rows  residual rows of the problem
Leftover leftover_of(const Problem& problem, std::span<const Run> runs, const Fit& fit,
                     std::span<const double> rows);

/// @brief The fit at a minimum, with all its numbers; `fit.ok` tells whether they stand.
/// @param minimum  what was evaluated there is used up
/// @param fit  with its options, chip and law
void fill_at(const Problem& problem, std::span<const Run> runs, Minimum& minimum,
             Fit& fit);

}  // namespace trochoid::identification
