#include <trochoid/identification/cells.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/fourier.h>

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

/// The force of a run, or the part of it that lies in its band.
std::vector<std::array<double, 3>> force_of(const FoldedRun& run, bool in_band) {
  if (!in_band) return run.force;
  const std::size_t band = index(run.band);
  std::vector<std::array<double, 3>> out(run.angle.size());
  for (std::size_t g = 0; g < out.size(); ++g) {
    for (std::size_t q = 0; q < 3; ++q) {
      double sum = 0.0;
      for (std::size_t k = 0; k < band; ++k) {
        sum += run.basis[g * band + k] * run.b[3 * k + q];
      }
      out[g][q] = sum / run.weight[g];
    }
  }
  return out;
}

/// Weighted means; a cell without samples keeps zeros.
void take_means(const FoldedRun& run, const std::vector<std::array<double, 3>>& force,
                Cells& out) {
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    const double a = run.angle[g] / unit::turn;
    const auto cell = std::min(
        out.size() - 1, static_cast<std::size_t>((a - std::floor(a)) *
                                                 static_cast<double>(out.size())));
    const double w = run.weight[g] * run.weight[g];
    out.weight[cell] += w;
    for (std::size_t q = 0; q < 3; ++q) out.force[cell][q] += w * force[g][q];
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (out.weight[i] == 0.0) continue;
    for (double& f : out.force[i]) f /= out.weight[i];
  }
}

/// The weights of a record that fills the turn count alike within a band.
void make_even(Cells& out) {
  double sum = 0.0;
  for (const double w : out.weight) sum += w;
  std::ranges::fill(out.weight, sum / static_cast<double>(out.size()));
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

/// C^T W C at one shift, about the means of the axes where they do not count.
std::vector<double> gram(const Cells& cells, const std::vector<double>& C,
                         std::size_t columns, std::size_t shift) {
  std::vector<double> G(columns * columns, 0.0);
  std::vector<double> sums(3 * columns, 0.0);
  double weight = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const double w = cells.weight[i];
    if (w == 0.0) continue;
    weight += w;
    for (std::size_t q = 0; q < 3; ++q) {
      const double* const c = &C[(((i + shift) % cells.size()) * 3 + q) * columns];
      for (std::size_t a = 0; a < columns; ++a) {
        sums[q * columns + a] += w * c[a];
        for (std::size_t b = 0; b <= a; ++b) G[a * columns + b] += w * c[a] * c[b];
      }
    }
  }
  for (std::size_t a = 0; a < columns; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      for (std::size_t q = 0; cells.centered && q < 3; ++q) {
        G[a * columns + b] -= sums[q * columns + a] * sums[q * columns + b] / weight;
      }
      G[b * columns + a] = G[a * columns + b];
    }
  }
  return G;
}

}  // namespace

Cells cells_of(const FoldedRun& run) {
  const bool banded = run.band > 0 && run.harmonics <= widest_band;
  const std::size_t n = !banded                        ? fine_cells
                        : run.harmonics <= narrow_band ? cells_of_narrow_band
                                                       : cells_of_wide_band;
  Cells out;
  out.weight.assign(n, 0.0);
  out.force.assign(n, {});
  out.centered = !run.drift.empty();
  take_means(run, force_of(run, banded), out);
  const double full = *std::ranges::max_element(out.weight);
  if (banded && *std::ranges::min_element(out.weight) > 0.1 * full) {
    make_even(out);
    out.harmonics = run.harmonics;
  }
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
    phi[i] =
        phase + (static_cast<double>(i) + 0.5) * unit::turn / static_cast<double>(n);
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

std::vector<Products> products(const Cells& cells, const std::vector<double>& C,
                               std::size_t count, bool mixed) {
  const std::size_t n = cells.size();
  const std::size_t columns = C.size() / (3 * n);
  const Sums sums = sums_of(cells);
  std::vector<Products> out(count);
  for (std::size_t shift = 0; shift < count; ++shift) {  // I-12
    Products& at = out[shift];
    // With equal weights a shift changes the order of the sums only.
    at.G = cells.even && shift > 0 ? out[0].G : gram(cells, C, columns, shift);
    at.X.assign(9 * columns, 0.0);
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t c = 0; c < 3; ++c) {
        if (c != q && !mixed) continue;
        double* const X = &at.X[(3 * q + c) * columns];
        for (std::size_t i = 0; i < n; ++i) {
          // About the mean of the channel it is about that of the axis too.
          const double mean = cells.centered ? sums.force[c] / sums.weight : 0.0;
          const double wF = cells.weight[i] * (cells.force[i][c] - mean);
          const double* const row = &C[(((i + shift) % n) * 3 + q) * columns];
          for (std::size_t a = 0; a < columns; ++a) X[a] += wF * row[a];
        }
      }
    }
  }
  return out;
}

}  // namespace trochoid::identification
