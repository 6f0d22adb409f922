#include <trochoid/identification/turn_rows.h>

#include <trochoid/base/index.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

using base::index;

/// Beyond this band nearly every harmonic counts, and the angles serve as well.
constexpr int widest_band = 32;

/// Harmonics beyond the band that the samples still mistake for ones within it: they
/// fall like 1/m^2, and are mistaken by one part in the number of turns.
int highest_of(int harmonics) noexcept {
  return std::max(63, 4 * harmonics - 1);
}

}  // namespace

void map_turn(FoldedRun& run, std::size_t few_angles) {
  const bool angles_serve =
      run.harmonics > widest_band || run.angle.size() <= few_angles;
  if (run.band == 0 || (run.response.rigid() && angles_serve)) return;
  run.highest = highest_of(run.harmonics);
  const std::size_t terms = 2 * index(run.highest) + 1;
  const std::size_t band = index(run.band);
  run.turn_map.assign(band * terms, 0.0);
  std::vector<double> wave(terms);
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    const double c = std::cos(run.angle[g]);
    const double s = std::sin(run.angle[g]);
    wave[0] = 1.0;
    wave[1] = c;
    wave[2] = s;
    for (std::size_t i = 3; i + 1 < terms; i += 2) {
      wave[i] = wave[i - 2] * c - wave[i - 1] * s;
      wave[i + 1] = wave[i - 1] * c + wave[i - 2] * s;
    }
    for (std::size_t k = 0; k < band; ++k) {  // I-11
      const double factor = run.weight[g] * run.basis[g * band + k];
      double* const row = &run.turn_map[k * terms];
      for (std::size_t i = 0; i < terms; ++i) row[i] += factor * wave[i];
    }
  }
}

std::vector<double> rows_of_turn(const FoldedRun& run,
                                 std::span<const double> coefficients, int columns) {
  const std::size_t width = 3 * index(columns);
  const std::size_t band = index(run.band);
  const std::size_t terms = 2 * index(run.highest) + 1;
  const std::size_t used = std::min(terms, coefficients.size() / width);
  std::vector<double> out(std::max(band * width, index(run.rows) * index(columns)),
                          0.0);
  for (std::size_t k = 0; k < band; ++k) {  // I-11
    double* const to = &out[k * width];
    for (std::size_t i = 0; i < used; ++i) {
      const double t = run.turn_map[k * terms + i];
      const double* const from = &coefficients[i * width];
      for (std::size_t c = 0; c < width; ++c) to[c] += t * from[c];
    }
  }
  return out;
}

}  // namespace trochoid::identification
