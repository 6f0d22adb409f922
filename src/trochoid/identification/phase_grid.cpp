#include <trochoid/identification/phase_grid.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/correlation.h>
#include <trochoid/numerics/fourier.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::identification {
namespace {

using base::index;

/// PhaseGrid of the turn: 3 degrees, a fraction of what a force curve needs to show its
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

double middle_of(std::size_t cell, std::size_t cells) noexcept {
  return (static_cast<double>(cell) + 0.5) * unit::turn / static_cast<double>(cells);
}

/// Amplitudes of the force in its band, wave by wave, shape (terms, 3).
std::vector<double> amplitudes_of(const FoldedRun& run) {
  const std::size_t terms = 2 * index(run.harmonics) + 1;
  if (run.basis.by_root()) {
    return amplitudes(run.basis, std::span(run.b).first(3 * terms), 3);
  }
  std::vector<double> A;
  std::vector<double> B;
  std::vector<double> wave(terms);
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    fill_waves(run.angle[g], wave);
    for (const double v : wave) A.push_back(run.weight[g] * v);
    for (const double f : run.force[g]) B.push_back(run.weight[g] * f);
  }
  return numerics::project_out(A, static_cast<int>(terms), B, 3);
}

/// The part of the force within the band in the middle of each cell, all weighing alike.
void take_band(const FoldedRun& run, PhaseGrid& out) {
  const std::vector<double> X = amplitudes_of(run);
  const std::size_t terms = X.size() / 3;
  double weight = 0.0;
  for (const double w : run.weight) weight += w * w;
  std::ranges::fill(out.weight, weight / static_cast<double>(out.size()));
  std::vector<double> wave(terms);
  for (std::size_t i = 0; i < out.size(); ++i) {
    fill_waves(middle_of(i, out.size()), wave);
    for (std::size_t k = 0; k < terms; ++k) {
      for (std::size_t q = 0; q < 3; ++q) out.force[i][q] += wave[k] * X[3 * k + q];
    }
  }
  out.harmonics = run.harmonics;
}

/// Weighted means; a cell without samples keeps zeros.
void take_means(const FoldedRun& run, PhaseGrid& out) {
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

struct GridSums {
  double weight = 0.0;
  std::array<double, 3> force{};
};

GridSums sums_of(const PhaseGrid& grid) {
  GridSums out;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    out.weight += grid.weight[i];
    for (std::size_t q = 0; q < 3; ++q) {
      out.force[q] += grid.weight[i] * grid.force[i][q];
    }
  }
  return out;
}

}  // namespace

PhaseGrid phase_grid_of(const FoldedRun& run) {
  const bool banded =
      run.band > 0 && run.harmonics <= widest_band && fills_the_turn(run);
  const std::size_t n = !banded                        ? fine_cells
                        : run.harmonics <= narrow_band ? cells_of_narrow_band
                                                       : cells_of_wide_band;
  PhaseGrid out;
  out.weight.assign(n, 0.0);
  out.force.assign(n, {});
  out.centered = !run.drift.empty();
  out.measured = run.measured;
  banded ? take_band(run, out) : take_means(run, out);
  out.even = std::ranges::all_of(out.weight, [&](double w) {
    return std::abs(w - out.weight[0]) < 1e-9 * out.weight[0];
  });
  const GridSums sums = sums_of(out);
  for (std::size_t q = 0; q < 3; ++q) {
    for (std::size_t i = 0; i < n; ++i) {
      out.squares += out.weight[i] * out.force[i][q] * out.force[i][q];
    }
    if (out.centered) out.squares -= sums.force[q] * sums.force[q] / sums.weight;
  }
  return out;
}

std::vector<double> matrix_on_grid(const force::ForceMatrix& matrix,
                                   const PhaseGrid& grid, double phase) {
  const std::size_t n = grid.size();
  const std::size_t width = 3 * index(matrix.columns());
  std::vector<double> phi(n);
  for (std::size_t i = 0; i < n; ++i) {
    phi[i] = phase + middle_of(i, n);
  }
  std::vector<double> C(n * width);
  matrix.evaluate(phi, C);
  if (grid.harmonics == 0) return C;
  const std::vector<double> a =
      numerics::fourier_coefficients(C, width, grid.harmonics);
  for (std::size_t i = 0; i < n; ++i) {
    double* const row = &C[i * width];
    std::copy_n(a.begin(), width, row);
    for (std::size_t m = 1; m <= index(grid.harmonics); ++m) {
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

namespace {

/// The force matrix in the grid, one entry after the other.
class Planes {
 public:
  /// @param measured  axes that count; the others are as good as zero
  Planes(std::span<const double> C, std::size_t columns,
         const std::array<bool, 3>& measured)
      : columns_(columns),
        length_(2 * C.size() / (3 * columns)),
        values_(3 * columns * length_),
        zero_(3 * columns, true) {
    const std::size_t n = length_ / 2;
    for (std::size_t entry = 0; entry < zero_.size(); ++entry) {
      double* const plane = &values_[entry * length_];
      for (std::size_t i = 0; i < n; ++i) {
        plane[i] = plane[n + i] = C[i * zero_.size() + entry];
        if (plane[i] != 0.0 && measured[entry / columns]) zero_[entry] = false;
      }
    }
  }

  [[nodiscard]] std::size_t length() const noexcept { return length_; }
  [[nodiscard]] bool zero(std::size_t q, std::size_t column) const {
    return zero_[q * columns_ + column];
  }
  /// Axis q of a column in each cell, two times in a row.
  [[nodiscard]] std::span<const double> of(std::size_t q, std::size_t column) const {
    return std::span(values_).subspan((q * columns_ + column) * length_, length_);
  }

 private:
  std::size_t columns_;
  std::size_t length_;
  std::vector<double> values_;
  std::vector<bool> zero_;
};

/// sum over the axes of column a times column b in each cell; empty where it is zero.
void multiply(const Planes& planes, std::size_t a, std::size_t b,
              std::vector<double>& out) {
  out.clear();
  for (std::size_t q = 0; q < 3; ++q) {
    if (planes.zero(q, a) || planes.zero(q, b)) continue;
    out.resize(planes.length(), 0.0);
    const std::span<const double> x = planes.of(q, a);
    const std::span<const double> y = planes.of(q, b);
    for (std::size_t i = 0; i < out.size(); ++i) out[i] += x[i] * y[i];
  }
}

/// Weighted sums of each axis of each column at every shift, shape (3 columns, shifts).
std::vector<double> sums_of_columns(const PhaseGrid& grid, const Planes& planes,
                                    std::size_t columns, std::size_t shifts) {
  std::vector<double> out(3 * columns * shifts, 0.0);
  for (std::size_t q = 0; q < 3; ++q) {
    for (std::size_t a = 0; a < columns; ++a) {
      if (planes.zero(q, a)) continue;
      numerics::correlate(grid.weight, planes.of(q, a),
                          std::span(out).subspan((q * columns + a) * shifts, shifts));
    }
  }
  return out;
}

/// About the means of the axes.
void center(const PhaseGrid& grid, const Planes& planes, std::size_t shifts,
            Products& out) {
  const std::size_t n = out.columns;
  const double weight = std::accumulate(grid.weight.begin(), grid.weight.end(), 0.0);
  const std::vector<double> sums = sums_of_columns(grid, planes, n, shifts);
  for (std::size_t s = 0; s < shifts; ++s) {
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t a = 0; a < n; ++a) {
        const double mean = sums[(q * n + a) * shifts + s] / weight;
        for (std::size_t b = 0; b < n; ++b) {
          out.G[(s * n + a) * n + b] -= mean * sums[(q * n + b) * shifts + s];
        }
      }
    }
  }
}

void fill_gram(const PhaseGrid& grid, const Planes& planes, Products& out) {
  const std::size_t n = out.columns;
  // With equal weights a shift changes the order of the sums only.
  const std::size_t shifts = grid.even ? 1 : out.shifts;
  out.G.assign(shifts * n * n, 0.0);
  std::vector<double> product;
  std::vector<double> sums(shifts);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b <= a; ++b) {
      multiply(planes, a, b, product);
      if (product.empty()) continue;
      numerics::correlate(grid.weight, product, sums);
      for (std::size_t s = 0; s < shifts; ++s) {
        out.G[(s * n + a) * n + b] = out.G[(s * n + b) * n + a] = sums[s];
      }
    }
  }
  if (grid.centered) center(grid, planes, shifts, out);
}

/// w F of one channel, about its mean where that does not count; about the mean of the
/// channel it is about that of the axis too.
std::vector<double> weighted_channel(const PhaseGrid& grid, std::size_t c) {
  std::vector<double> out(grid.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = grid.weight[i] * grid.force[i][c];
  }
  if (!grid.centered) return out;
  const double mean = std::accumulate(out.begin(), out.end(), 0.0) /
                      std::accumulate(grid.weight.begin(), grid.weight.end(), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] -= grid.weight[i] * mean;
  return out;
}

void fill_right(const PhaseGrid& grid, const Planes& planes, Products& out) {
  const std::size_t n = out.columns;
  const std::size_t width = out.mixed ? 9 * n : n;
  out.X.assign(out.shifts * width, 0.0);
  std::vector<double> products(out.shifts);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::vector<double> wF = weighted_channel(grid, c);
    for (std::size_t q = 0; q < 3; ++q) {
      if (c != q && !out.mixed) continue;
      const std::size_t place = out.mixed ? (3 * q + c) * n : 0;
      for (std::size_t a = 0; a < n; ++a) {
        if (planes.zero(q, a)) continue;
        numerics::correlate(wF, planes.of(q, a), products);
        for (std::size_t s = 0; s < out.shifts; ++s) {
          out.X[s * width + place + a] += products[s];
        }
      }
    }
  }
}

}  // namespace

Products products(const PhaseGrid& grid, std::span<const double> C, std::size_t count,
                  bool mixed) {
  Products out;
  out.columns = C.size() / (3 * grid.size());
  out.shifts = count;
  out.mixed = mixed;
  const Planes planes(C, out.columns, grid.measured);
  fill_gram(grid, planes, out);  // I-12
  fill_right(grid, planes, out);
  return out;
}

}  // namespace trochoid::identification
