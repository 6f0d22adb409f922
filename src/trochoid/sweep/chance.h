#pragma once

#include <cstddef>
#include <random>
#include <vector>

namespace trochoid::sweep {

/// @brief Numbers by chance from 0 to 1, neither of them: the same on every machine.
/// @param stratified  each column hits each of `rows` stretches of equal length once
/// @return shape (columns, rows), row-major
std::vector<double> chances(std::mt19937_64& random, std::size_t columns,
                            std::size_t rows, bool stratified);

/// @brief Where a share p of the normal distribution of mean 0 and variance 1 lies below.
double normal_quantile(double p);

}  // namespace trochoid::sweep
