#include <trochoid/sweep/chance.h>

#include <boost/math/special_functions/erf.hpp>

#include <algorithm>
#include <numbers>
#include <numeric>

namespace trochoid::sweep {

namespace {

/// From 0 to 1, neither of them; std::uniform_real_distribution is not the same
/// everywhere.
double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11) + 0.5) * 0x1p-53;
}

/// Below `most`; std::uniform_int_distribution is not the same everywhere.
std::size_t below(std::mt19937_64& random, std::size_t most) {
  return std::min(static_cast<std::size_t>(uniform(random) * static_cast<double>(most)),
                  most - 1);
}

/// One number for each row, each in a stretch of its own of 1/rows.
void add_stratified(std::mt19937_64& random, std::size_t rows,
                    std::vector<double>& chance) {
  std::vector<std::size_t> place(rows);
  std::iota(place.begin(), place.end(), std::size_t{0});
  for (std::size_t i = rows; i > 1; --i) {
    std::swap(place[i - 1], place[below(random, i)]);
  }
  for (const std::size_t p : place) {
    chance.push_back((static_cast<double>(p) + uniform(random)) /
                     static_cast<double>(rows));
  }
}

}  // namespace

std::vector<double> chances(std::mt19937_64& random, std::size_t columns,
                            std::size_t rows, bool stratified) {
  std::vector<double> chance;
  if (stratified) {
    for (std::size_t k = 0; k < columns; ++k) {
      add_stratified(random, rows, chance);
    }
  } else {
    chance.resize(rows * columns);
    std::ranges::generate(chance, [&] { return uniform(random); });
  }
  return chance;
}

double normal_quantile(double p) {
  return -std::numbers::sqrt2 * boost::math::erfc_inv(2 * p);
}

}  // namespace trochoid::sweep
