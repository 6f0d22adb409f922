#pragma once

#include <trochoid/identification/problem.h>
#include <trochoid/signal/axes.h>

#include <array>
#include <vector>

namespace trochoid::identification {

/// Readings that fit a record equally well, the first of them to be fitted.
using ReadingFamily = std::vector<signal::AxesReading>;

/// @brief The 48 signed permutations in families that no residual can tell apart.
///
/// Of edges at one lead angle, a cylinder's among them, 6 of 8 (signal::axes_classes); else 24
/// of 2, since the force is linear in the coefficients: all signs of Q and of K turned are the
/// same data.
std::vector<ReadingFamily> reading_families(const force::Setup& setup);

/// @brief The problem with its runs, which hold the channels, read by Q.
Problem read_by(Problem channels, const signal::Matrix3& Q);

}  // namespace trochoid::identification
