#include <trochoid/identification/cells.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/fourier.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

using base::index;

/// Cells of the turn: 3 degrees, a fraction of what a force curve needs to show its
/// shape; and as many as a band needs, a power of two.
constexpr std::size_t fine_cells = 120;
constexpr std::size_t cells_of_narrow_band = 64;
constexpr std::size_t cells_of_wide_band = 128;
constexpr int narrow_band = 8;
constexpr int widest_band = 32;

/// Whether the samples of a run leave no gap in which its band could hide anything.
bool fills_the_turn(const FoldedRun& run) {
  std::vector<double> angle(run.angle);
  std::ranges::sort(angle);
  double gap = angle.front() + unit::turn - angle.back();
  for (std::size_t i = 1; i < angle.size(); ++i) {
    gap = std::max(gap, angle[i] - angle[i - 1]);
  }
  return gap * (2 * run.harmonics + 2) < unit::turn;
}

/// 1, cos, sin, cos 2, ... of an angle.
void harmonics_at(double phi, int harmonics, std::vector<double>& out) {
  out.push_back(1.0);
  for (int m = 1; m <= harmonics; ++m) {
    out.push_back(std::cos(m * phi));
    out.push_back(std::sin(m * phi));
  }
}

double middle_of(std::size_t cell, std::size_t cells) noexcept {
  return (static_cast<double>(cell) + 0.5) * unit::turn / static_cast<double>(cells);
}

/// The part of the force within the band in the middle of each cell, all weighing alike.
void take_band(const FoldedRun& run, Cells& out) {
  const std::size_t terms = 2 * index(run.harmonics) + 1;
  std::vector<double> A;
  std::vector<double> B;
  double weight = 0.0;
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    const std::size_t row = A.size();
    harmonics_at(run.angle[g], run.harmonics, A);
    for (std::size_t k = row; k < A.size(); ++k) A[k] *= run.weight[g];
    for (const double f : run.force[g]) B.push_back(run.weight[g] * f);
    weight += run.weight[g] * run.weight[g];
  }
  const std::vector<double> X = numerics::project_out(A, static_cast<int>(terms), B, 3);
  std::ranges::fill(out.weight, weight / static_cast<double>(out.size()));
  for (std::size_t i = 0; i < out.size(); ++i) {
    std::vector<double> wave;
    harmonics_at(middle_of(i, out.size()), run.harmonics, wave);
    for (std::size_t k = 0; k < terms; ++k) {
      for (std::size_t q = 0; q < 3; ++q) out.force[i][q] += wave[k] * X[3 * k + q];
    }
  }
  out.harmonics = run.harmonics;
}

/// Weighted means; a cell without samples keeps zeros.
void take_means(const FoldedRun& run, Cells& out) {
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    const double a = run.angle[g] / unit::turn;
    const auto cell = std::min(
        out.size() - 1, static_cast<std::size_t>((a - std::floor(a)) *
                                                 static_cast<double>(out.size())));
    const double w = run.weight[g] * run.weight[g];
    out.weight[cell] += w;
    for (std::size_t q = 0; q < 3; ++q) out.force[cell][q] += w * run.force[g][q];
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.weight[i] == 0.0) continue;
    for (double& f : out.force[i]) f /= out.weight[i];
  }
}

struct Sums {
  double weight = 0.0;
  std::array<double, 3> force{};
};

Sums sums_of(const Cells& cells) {
  Sums out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    out.weight += cells.weight[i];
    for (std::size_t q = 0; q < 3; ++q) {
      out.force[q] += cells.weight[i] * cells.force[i][q];
    }
  }
  return out;
}

}  // namespace

Cells cells_of(const FoldedRun& run) {
  const bool banded =
      run.band > 0 && run.harmonics <= widest_band && fills_the_turn(run);
  const std::size_t n = !banded                        ? fine_cells
                        : run.harmonics <= narrow_band ? cells_of_narrow_band
                                                       : cells_of_wide_band;
  Cells out;
  out.weight.assign(n, 0.0);
  out.force.assign(n, {});
  out.centered = !run.drift.empty();
  out.measured = run.measured;
  banded ? take_band(run, out) : take_means(run, out);
  out.even = std::ranges::all_of(out.weight, [&](double w) {
    return std::abs(w - out.weight[0]) < 1e-9 * out.weight[0];
  });
  const Sums sums = sums_of(out);
  for (std::size_t q = 0; q < 3; ++q) {
    for (std::size_t i = 0; i < n; ++i) {
      out.squares += out.weight[i] * out.force[i][q] * out.force[i][q];
    }
    if (out.centered) out.squares -= sums.force[q] * sums.force[q] / sums.weight;
  }
  return out;
}

std::vector<double> matrix_in_cells(const force::ForceMatrix& matrix,
                                    const Cells& cells, double phase) {
  const std::size_t n = cells.size();
  const std::size_t width = 3 * index(matrix.columns());
  std::vector<double> phi(n);
  for (std::size_t i = 0; i < n; ++i) {
    phi[i] = phase + middle_of(i, n);
  }
  std::vector<double> C(n * width);
  matrix.evaluate(phi, C);
  if (cells.harmonics == 0) return C;
  const std::vector<double> a =
      numerics::fourier_coefficients(C, width, cells.harmonics);
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = &C[i * width];
    std::copy_n(a.begin(), width, row);
    for (std::size_t m = 1; m <= index(cells.harmonics); ++m) {
      const double x =
          unit::turn * static_cast<double>(m * i % n) / static_cast<double>(n);
      const double* const cosines = &a[(2 * m - 1) * width];
      for (std::size_t c = 0; c < width; ++c) {
        row[c] += cosines[c] * std::cos(x) + cosines[width + c] * std::sin(x);
      }
    }
  }
  return C;
}

}  // namespace trochoid::identification
