#include <trochoid/dynamics/propagator.h>

#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

using numerics::Matrix;

/// Units of the states in which rows and columns are of one size: metres and metres per
/// second are not, and an exponential of a fast mode would lose all its digits.
std::vector<double> balanced_units(std::span<const double> A, std::size_t n) {
  std::vector<double> units(n, 1.0);
  for (int round = 0; round < 30; ++round) {
    for (std::size_t i = 0; i < n; ++i) {
      double row = 0.0;
      double column = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        if (k != i) {
          row += std::abs(A[i * n + k]) * units[k] / units[i];
          column += std::abs(A[k * n + i]) * units[i] / units[k];
        }
      }
      if (row > 0 && column > 0) {
        units[i] *= std::exp2(std::round(0.5 * std::log2(row / column)));
      }
    }
  }
  return units;
}

double largest(std::span<const double> values) {
  double most = 0.0;
  for (const double value : values) most = std::max(most, std::abs(value));
  return most;
}

/// Units of the inputs that make B as large as A, which has its balanced units.
std::vector<double> input_units(const Matrix& A, const Matrix& B) {
  const double wanted = largest(A.values);
  std::vector<double> units(B.columns, 1.0);
  for (std::size_t k = 0; k < B.columns; ++k) {
    const double own = largest(std::span(B.values).subspan(k * B.rows, B.rows));
    if (own > 0 && wanted > 0) units[k] = wanted / own;
  }
  return units;
}

/// A row-major matrix of a system in other units of its rows and columns.
Matrix in_units(std::span<const double> A, const std::vector<double>& rows,
                const std::vector<double>& columns) {
  Matrix out = numerics::zeros(rows.size(), columns.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < columns.size(); ++k) {
      out(i, k) = A[i * columns.size() + k] / rows[i] * columns[k];
    }
  }
  return out;
}

}  // namespace

Propagator propagator(std::span<const double> A, std::span<const double> B,
                      std::size_t states, double dt) {
  const std::size_t n = states;
  const std::size_t m = B.size() / states;
  const std::vector<double> units = balanced_units(A, n);
  const Matrix own = in_units(A, units, units);
  const Matrix driven = in_units(B, units, std::vector<double>(m, 1.0));
  const std::vector<double> inputs = input_units(own, driven);
  // z' = A z + B u, u' = v/dt, v' = 0 over one unit of t/dt
  Matrix whole = numerics::zeros(n + 2 * m, n + 2 * m);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) whole(i, k) = dt * own(i, k);
    for (std::size_t k = 0; k < m; ++k) whole(i, n + k) = dt * driven(i, k) * inputs[k];
  }
  for (std::size_t k = 0; k < m; ++k) whole(n + k, n + m + k) = 1.0;
  const Matrix step = numerics::exponential(whole);
  Propagator out{n, m, {}, {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      out.Phi.push_back(units[i] * step(i, k) / units[k]);
    }
    for (std::size_t k = 0; k < m; ++k) {
      const double constant = units[i] * step(i, n + k) / inputs[k];
      const double ramp = units[i] * step(i, n + m + k) / inputs[k];
      out.G_0.push_back(constant - ramp);
      out.G_1.push_back(ramp);
    }
  }
  return out;
}

}  // namespace trochoid::dynamics
