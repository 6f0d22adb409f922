#include "difference_plate.h"

#include <map>

namespace trochoid::structure {

namespace {

using Row = std::map<Eigen::Index, double>;  // a linear form of the deflections

Row sum(const Row& a, double factor, const Row& b) {
  Row out = a;
  for (const auto& [i, value] : b) {
    out[i] += factor * value;
  }
  return out;
}

}  // namespace

DifferencePlate::DifferencePlate(double length, double height, double nu,
                                 std::size_t columns, std::size_t rows)
    : columns_(columns), rows_(rows) {
  const double dx = length / static_cast<double>(columns);
  const double dy = height / static_cast<double>(rows);
  std::vector<Eigen::Triplet<double>> triplets;
  const auto add = [&](double weight, const Row& row) {  // weight (row . w)^2
    for (const auto& [i, a] : row) {
      for (const auto& [j, b] : row) {
        triplets.emplace_back(i, j, weight * a * b);
      }
    }
  };
  // A node as a linear form; beyond a clamped side the plate is its own mirror image.
  const auto at = [&](std::ptrdiff_t i, std::ptrdiff_t j) {
    const auto m = static_cast<std::ptrdiff_t>(columns);
    i = i < 0 ? -i : (i > m ? 2 * m - i : i);
    j = j < 0 ? -j : j;
    return i == 0 || i == m || j == 0
               ? Row{}
               : Row{{node(static_cast<std::size_t>(i), static_cast<std::size_t>(j)),
                      1.0}};
  };
  const auto second = [&](const Row& before, const Row& here, const Row& after,
                          double d) {
    return sum(sum(sum({}, 1 / (d * d), before), -2 / (d * d), here), 1 / (d * d),
               after);
  };
  for (std::ptrdiff_t i = 0; i <= static_cast<std::ptrdiff_t>(columns); ++i) {
    for (std::ptrdiff_t j = 0; j <= static_cast<std::ptrdiff_t>(rows); ++j) {
      const bool side = i == 0 || i == static_cast<std::ptrdiff_t>(columns);
      const bool free = j == static_cast<std::ptrdiff_t>(rows);
      const double area = dx * dy * (side ? 0.5 : 1) * (j == 0 || free ? 0.5 : 1);
      const Row xx = second(at(i - 1, j), at(i, j), at(i + 1, j), dx);
      if (free) {  // there the moment is 0: w_yy = -nu w_xx
        add(area * (1 - nu * nu), xx);
      } else {
        const Row yy = second(at(i, j - 1), at(i, j), at(i, j + 1), dy);
        add(area * (1 - nu * nu), xx);
        add(area, sum(yy, nu, xx));
      }
    }
  }
  for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(columns); ++i) {
    for (std::ptrdiff_t j = 0; j < static_cast<std::ptrdiff_t>(rows); ++j) {
      const Row high = sum(at(i + 1, j + 1), -1, at(i, j + 1));
      const Row low = sum(at(i + 1, j), -1, at(i, j));
      const double d = dx * dy;
      add(2 * (1 - nu) * d, sum(sum({}, 1 / d, high), -1 / d, low));
    }
  }
  Eigen::SparseMatrix<double> K(size(), size());
  K.setFromTriplets(triplets.begin(), triplets.end());
  llt_.compute(K);
}

Eigen::Index DifferencePlate::node(std::size_t column, std::size_t row) const {
  return static_cast<Eigen::Index>((row - 1) * (columns_ - 1) + column - 1);
}

Eigen::Index DifferencePlate::size() const {
  return static_cast<Eigen::Index>((columns_ - 1) * rows_);
}

Eigen::VectorXd DifferencePlate::solve(const Eigen::VectorXd& force) const {
  return llt_.solve(force);
}

}  // namespace trochoid::structure
