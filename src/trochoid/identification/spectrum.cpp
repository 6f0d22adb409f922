#include <trochoid/identification/spectrum.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {

namespace {

using base::index;

/// What no column of a force matrix has to speak of above.
constexpr int most_lines = 48;
/// Fewer turns tell too little of what differs from one to the next.
constexpr double fewest_turns = 4.0;
/// More blocks of turns tell no more.
constexpr double most_blocks = 64.0;

/// Whole turns of a run, in blocks of as many turns each.
struct Blocks {
  std::size_t count = 0;
  double turns_each = 1.0;
  double begin = 0.0;  ///< angle [rad]
  double per_turn = 0.0;

  [[nodiscard]] std::size_t of(double angle) const {
    const double turns = (angle - begin) / unit::turn;
    return static_cast<std::size_t>(std::max(0.0, turns / turns_each + 1e-9));
  }
};

Blocks blocks_of(const Run& run) {
  Blocks out;
  const std::size_t n = run.angle.size();
  const double span = run.angle.back() - run.angle.front();
  if (n < 2 || !(span > 0) || !std::ranges::is_sorted(run.angle)) return out;
  out.per_turn = static_cast<double>(n - 1) * unit::turn / span;
  // The last sample of a turn stands a step before its end.
  const double turns = std::floor(span / unit::turn + 1.5 / out.per_turn);
  if (turns < fewest_turns) return out;
  out.turns_each = std::ceil(turns / most_blocks);
  out.count = static_cast<std::size_t>(turns / out.turns_each + 1e-9);
  out.begin = run.angle.front();
  return out;
}

/// @brief Mean of the values times each wave, each sample at its own angle: one moved to
/// the middle of a bin has an error of angle that repeats with the bins, and makes lines
/// that are not there.
/// @param values  three columns
/// @return of each block, shape (blocks, 3 lines)
std::vector<double> means_of(std::span<const double> angle,
                             const numerics::Columns& values, const Blocks& blocks,
                             std::size_t lines) {
  const std::size_t rows = 3 * lines;
  std::vector<double> out(blocks.count * rows, 0.0);
  std::size_t end = 0;
  for (std::size_t block = 0; block < blocks.count; ++block) {
    const std::size_t begin = end;
    while (end < angle.size() && blocks.of(angle[end]) == block) ++end;
    const std::size_t n = end - begin;
    if (n == 0) continue;
    const std::vector<double> sums =
        wave_products(angle.subspan(begin, n),
                      {values.values.subspan(begin), n, values.stride}, lines);
    for (std::size_t k = 0; k < lines; ++k) {
      for (std::size_t q = 0; q < 3; ++q) {
        out[block * rows + q * lines + k] = sums[3 * k + q] / static_cast<double>(n);
      }
    }
  }
  return out;
}

/// @brief By how much turns that agree with the next tell less of their mean, for what
/// drifts slowly: 1 for turns of their own.
double slow_factor(std::span<const double> values, double mean) {
  double squares = 0.0;
  double products = 0.0;
  for (std::size_t b = 0; b < values.size(); ++b) {
    squares += (values[b] - mean) * (values[b] - mean);
    if (b > 0) products += (values[b] - mean) * (values[b - 1] - mean);
  }
  const double r = squares > 0 ? std::clamp(products / squares, 0.0, 0.9) : 0.0;
  return (1.0 + r) / (1.0 - r);
}

}  // namespace

Spectrum spectrum_of(const Run& run, std::span<const std::array<double, 3>> fitted,
                     int band) {
  Spectrum out;
  const Blocks blocks = blocks_of(run);
  const int resolved = static_cast<int>(0.5 * (blocks.per_turn - 1.0) + 1e-6);
  const int highest = std::min(resolved, band > 0 ? (band - 1) / 2 : most_lines);
  if (blocks.count == 0 || highest < 1) return out;
  out.highest = highest;
  out.turns = static_cast<double>(blocks.count);
  const std::size_t rows = out.rows();
  const std::size_t samples = run.angle.size();
  std::vector<double> left(3 * samples);
  for (std::size_t i = 0; i < samples; ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      left[q * samples + i] = run.force[i][q] - fitted[i][q];
    }
  }
  const std::vector<double> means =
      means_of(run.angle, {left, samples}, blocks, out.lines());
  const auto n = static_cast<double>(samples);
  std::vector<double> own(blocks.count);
  for (std::size_t row = 0; row < rows; ++row) {
    double sum = 0.0;
    for (std::size_t b = 0; b < blocks.count; ++b) {
      own[b] = means[b * rows + row];
      sum += own[b];
    }
    const double mean = sum / out.turns;
    double squares = 0.0;
    for (const double m : own) squares += (m - mean) * (m - mean);
    const bool constant = row % out.lines() == 0;
    const double scale = constant ? n : 2.0 * n;  // I-14
    out.left.push_back(std::sqrt(scale) * mean);
    out.scatter.push_back(scale / out.turns * squares / (out.turns - 1.0) *
                          (constant ? slow_factor(own, mean) : 1.0));
  }
  return out;
}

namespace {

/// What one orthonormal column of the band is by lines, shape (lines, band): the columns
/// span the harmonics, each of them is none.
std::vector<double> lines_of_band(const FoldedRun& folded, std::size_t lines) {
  const std::size_t band = index(folded.band);
  const bool mapped =
      !folded.turn_map.empty() && 2 * index(folded.highest) + 1 >= lines;
  const std::vector<double> own =
      mapped ? std::vector<double>{} : band_by_waves(folded, lines);
  const std::vector<double>& map = mapped ? folded.turn_map : own;
  const std::size_t terms = map.size() / band;
  double n = 0.0;
  for (const double w : folded.weight) n += w * w;
  std::vector<double> out(lines * band);
  for (std::size_t l = 0; l < lines; ++l) {
    const double scale = std::sqrt((l == 0 ? 1.0 : 2.0) / n);
    for (std::size_t k = 0; k < band; ++k) {
      out[l * band + k] = scale * map[k * terms + l];
    }
  }
  return out;
}

}  // namespace

std::vector<double> harmonic_rows(const FoldedRun& folded, const Spectrum& spectrum,
                                  const numerics::Columns& J) {
  const std::size_t lines = spectrum.lines();
  const std::size_t columns = J.count();
  std::vector<double> out(spectrum.rows() * columns, 0.0);
  if (folded.band > 0) {
    const std::vector<double> map = lines_of_band(folded, lines);
    const std::size_t band = index(folded.band);
    for (std::size_t c = 0; c < columns; ++c) {
      const std::span<const double> column = J[c];
      for (std::size_t l = 0; l < lines; ++l) {
        std::array<double, 3> sum{};
        for (std::size_t k = 0; k < band; ++k) {
          const double share = map[l * band + k];
          for (std::size_t q = 0; q < 3; ++q) sum[q] += share * column[3 * k + q];
        }
        for (std::size_t q = 0; q < 3; ++q) out[(q * lines + l) * columns + c] = sum[q];
      }
    }
    return out;
  }
  const std::size_t u = folded.angle.size();
  double n = 0.0;
  for (const double w : folded.weight) n += w * w;
  std::vector<double> weighted(3 * columns * u);
  for (std::size_t c = 0; c < columns; ++c) {
    for (std::size_t g = 0; g < u; ++g) {
      for (std::size_t q = 0; q < 3; ++q) {
        weighted[(q * columns + c) * u + g] = folded.weight[g] * J[c][3 * g + q];
      }
    }
  }
  const std::vector<double> sums = wave_products(folded.angle, {weighted, u}, lines);
  for (std::size_t k = 0; k < lines; ++k) {
    for (std::size_t q = 0; q < 3; ++q) {
      std::copy_n(&sums[(3 * k + q) * columns], columns,
                  &out[(q * lines + k) * columns]);
    }
  }
  for (std::size_t row = 0; row < spectrum.rows(); ++row) {
    const double scale = std::sqrt((row % lines == 0 ? 1.0 : 2.0) / std::max(1.0, n));
    for (std::size_t c = 0; c < columns; ++c) out[row * columns + c] *= scale;
  }
  return out;
}

}  // namespace trochoid::identification
