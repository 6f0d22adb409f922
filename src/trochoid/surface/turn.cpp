#include <trochoid/surface/turn.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

std::vector<double> largest_values(const EdgeMoments& edges, std::size_t groups,
                                   const numerics::PeriodicPieces::Function& f) {
  constexpr int samples = 60;
  const std::size_t n = edges.values();
  std::vector<double> values(groups * n);
  std::vector<double> largest(groups);
  for (int i = 0; i < samples; ++i) {
    f(unit::turn * (i + 0.3) / samples, values);
    for (std::size_t k = 0; k < values.size(); ++k) {
      largest[k / n] = std::max(largest[k / n], std::abs(values[k]));
    }
  }
  return largest;
}

numerics::PeriodicPieces::Options panels_for(const EdgeMoments& edges, bool repeats,
                                             std::span<const double> largest,
                                             double tolerance) {
  constexpr double longest = 0.35;
  numerics::PeriodicPieces::Options options{
      .period = repeats ? edges.setup().cutter.pitch.front() : unit::turn,
      .breaks = edges.kinks(false),
      .longest = longest,
      .shortest = 0.1 * tolerance};
  const double everywhere = *std::max_element(largest.begin(), largest.end());
  for (const double value : largest) {
    options.allowed.insert(options.allowed.end(), edges.values(),
                           tolerance * (value > 0 ? value : everywhere));
  }
  return options;
}

numerics::PeriodicPieces unit_moments(const EdgeMoments& edges, double tolerance) {
  const auto f = [&](double phi, std::span<double> out) {
    edges.at(phi, nullptr, out);
  };
  const std::vector<double> largest = largest_values(edges, columns, f);
  return {f, panels_for(edges, edges.equal_teeth(), largest, tolerance)};
}

numerics::PeriodicPieces with_coefficients(const numerics::PeriodicPieces& unit,
                                           std::span<const double, columns> K) {
  const std::size_t n = unit.functions() / columns;
  std::vector<double> weights(n * unit.functions());
  for (std::size_t q = 0; q < n; ++q) {
    for (std::size_t c = 0; c < columns; ++c) {
      weights[q * unit.functions() + c * n + q] = K[c];
    }
  }
  return unit.combined(weights);
}

numerics::PeriodicPieces deflection(const numerics::PeriodicPieces& moments,
                                    std::span<const double> row, double sigma) {
  const std::size_t n = row.size() + 2;
  const std::size_t sets = moments.functions() / n;
  std::vector<double> weights(sets * moments.functions());
  for (std::size_t c = 0; c < sets; ++c) {
    for (std::size_t q = 0; q < row.size(); ++q) {
      weights[c * moments.functions() + c * n + q] = sigma * row[q];  // E-4
    }
  }
  return moments.combined(weights);
}

}  // namespace trochoid::surface
