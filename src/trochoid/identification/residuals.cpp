#include <trochoid/base/index.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trochoid::identification {
namespace {

using base::index;

/// RunSums of squares over runs [N^2].
struct RunSums {
  std::array<double, 3> left{};  ///< in the band, one a channel
  double in_band = 0.0;          ///< measured force in the band
  double all = 0.0;              ///< measured force
  double samples = 0.0;
};

/// Products of neighbouring residuals and squares of residuals [N^2].
struct NeighbourPairs {
  double products = 0.0;
  double squares = 0.0;

  [[nodiscard]] double correlation() const {
    return squares > 0.0 ? products / squares : 0.0;
  }
};

std::array<double, 3> squares_left(const Run& run,
                                   std::span<const std::array<double, 3>> fitted,
                                   NeighbourPairs& pairs) {
  std::array<double, 3> out{};
  std::array<double, 3> before{};
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      const double d = run.force[i][q] - fitted[i][q];
      out[q] += d * d;
      pairs.squares += d * d;
      pairs.products += d * before[q];
      before[q] = d;
    }
  }
  return out;
}

/// Squares of the samples; of those about a constant and a slope a channel, where these
/// are not force (I-7).
double squares_of(const Run& run, bool drift) {
  double out = 0.0;
  const std::size_t n = run.force.size();
  for (std::size_t q = 0; q < 3; ++q) {
    if (!run.measured[q]) continue;
    double sum = 0.0;
    double along = 0.0;
    double slopes = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double f = run.force[i][q];
      const double s = slope_at(i, n);
      out += f * f;
      sum += f;
      along += s * f;
      slopes += s * s;
    }
    if (!drift) continue;
    out -= sum * sum / static_cast<double>(n);
    if (slopes > 0.0) out -= along * along / slopes;
  }
  return std::max(0.0, out);
}

/// The same of the rows of a run.
double squares_of(const FoldedRun& run) {
  std::vector<double> b = run.b;
  if (!run.drift.empty()) numerics::project_out(run.drift, 6, b, 1);
  return std::inner_product(b.begin(), b.end(), b.begin(), 0.0);
}

/// Part of a sum of squares as a part of an RMS, from 0 to 1.
double part(double some, double whole) {
  return whole > 0.0 ? std::sqrt(std::clamp(some / whole, 0.0, 1.0)) : 0.0;
}

}  // namespace

double scatter_of(const Run& run, const FoldedRun& folded) {
  if (folded.band > 0) return 0.0;
  double measured = 0.0;
  for (const auto& F : run.force) {
    for (std::size_t q = 0; q < 3; ++q) {
      if (run.measured[q]) measured += F[q] * F[q];
    }
  }
  double kept = 0.0;
  for (const double b : folded.b) kept += b * b;
  return std::max(0.0, measured - kept);
}

void fill_residuals(const Problem& problem, std::span<const Run> runs,
                    std::span<const double> left, Fit& fit) {
  RunSums sums;
  NeighbourPairs unbanded;
  NeighbourPairs everywhere;
  std::size_t row = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const FoldedRun& folded = problem.runs[r];
    const std::span<const double> own = left.subspan(row, index(folded.rows));
    row += index(folded.rows);
    NeighbourPairs pairs;
    std::array<double, 3> squares = squares_left(runs[r], fit.fitted[r], pairs);
    const double force = squares_of(runs[r], !folded.drift.empty());
    if (folded.band > 0) {
      squares = {};
      for (std::size_t i = 0; i < own.size(); ++i) squares[i % 3] += own[i] * own[i];
      sums.in_band += squares_of(folded);
    } else {
      unbanded.products += pairs.products;
      unbanded.squares += pairs.squares;
      sums.in_band += force;
    }
    everywhere.products += pairs.products;
    everywhere.squares += pairs.squares;
    sums.all += force;
    sums.samples += static_cast<double>(runs[r].angle.size());
    for (std::size_t q = 0; q < 3; ++q) sums.left[q] += squares[q];
  }
  const double total = sums.left[0] + sums.left[1] + sums.left[2];
  for (std::size_t q = 0; q < 3; ++q) {  // I-5
    fit.rms_axis[q] = std::sqrt(sums.left[q] / sums.samples);
  }
  fit.rms = std::sqrt(total / sums.samples);
  fit.residual_correlation = unbanded.correlation();  // I-8
  fit.unexplained = {part(total, sums.in_band),       // I-9
                     part(everywhere.squares, sums.all),
                     part(sums.all - sums.in_band, sums.all), everywhere.correlation()};
}

}  // namespace trochoid::identification
