#include <trochoid/surface/also_bent.h>

#include <trochoid/base/units.h>
#include <trochoid/surface/scale.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

constexpr std::size_t kinds = 4;  ///< of E-42
enum Kind : std::size_t { along_x, wall_x, cutter_z, wall_z };

bool has(const Setting& setting, AlsoBends axis) {
  return std::ranges::find(setting.also_bends, axis) != setting.also_bends.end();
}

LeverArms lever_arms(const Setting& setting, const Compliance& compliance) {
  const double thickness =
      compliance.bodies().wall ? compliance.bodies().wall->thickness : 0.0;
  return {.sigma = side_of(setting).sigma,
          .mid_plane = setting.setup.cutter.profile.D / 2 -
                       radial_depth(setting.setup.cut.engagement) + thickness / 2};
}

/// What may be wrong with each function: a part of the largest of its kind.
std::vector<double> allowed_errors(const numerics::PeriodicPieces::Function& f,
                                   std::size_t points, double tolerance) {
  constexpr int samples = 90;
  const std::size_t functions = kinds * points + points + 2;
  std::vector<double> values(functions);
  std::vector<double> largest(kinds + 1);
  for (int i = 0; i < samples; ++i) {
    f(unit::turn * (i + 0.3) / samples, values);
    for (std::size_t k = 0; k < functions; ++k) {
      double& most = largest[std::min(k / points, kinds)];
      most = std::max(most, std::abs(values[k]));
    }
  }
  std::vector<double> allowed(functions);
  for (std::size_t k = 0; k < functions; ++k) {
    const double most = largest[std::min(k / points, kinds)];
    allowed[k] = most > 0 ? tolerance * most : std::numeric_limits<double>::infinity();
  }
  return allowed;
}

numerics::PeriodicPieces all_moments(const Setting& setting, const EdgeMoments& edges,
                                     const LeverArms& arms, double tolerance) {
  const auto K = wall_coefficients(setting.law);
  const std::size_t points = edges.basis().size();
  const std::size_t n = edges.values();
  const numerics::PeriodicPieces::Function f = [&](double phi, std::span<double> out) {
    edges.couples_at(phi, arms, out.first(kinds * points));
    std::vector<double> unit(columns * n);
    edges.at(phi, nullptr, unit);
    const std::span<double> sums = out.subspan(kinds * points);
    std::fill(sums.begin(), sums.end(), 0.0);
    for (std::size_t i = 0; i < unit.size(); ++i) {
      sums[i % n] += K[i / n] * unit[i];
    }
  };
  const std::vector<double> one = {1.0};
  numerics::PeriodicPieces::Options options =
      panels_for(edges, edges.equal_teeth(), one, tolerance);
  options.allowed = allowed_errors(f, points, tolerance);
  return {f, options};
}

}  // namespace

AlsoBent::AlsoBent(const Setting& setting, const EdgeMoments& edges,
                   const Compliance& compliance, double tolerance)
    : compliance_(compliance),
      sigma_(side_of(setting).sigma),
      x_(has(setting, AlsoBends::x)),
      z_(has(setting, AlsoBends::z)),
      all_(all_moments(setting, edges, lever_arms(setting, compliance), tolerance)) {}

numerics::PeriodicPieces AlsoBent::deflection(double height,
                                              std::span<const double> row) const {
  const std::size_t points = row.size();
  std::vector<double> weights(all_.functions());
  const auto add = [&](std::size_t first, std::span<const double> G, double factor) {
    for (std::size_t q = 0; q < points; ++q) {
      weights[first + q] += factor * G[q];
    }
  };
  const std::span<const double> at(&height, 1);
  add(kinds * points, row, sigma_);  // E-4
  if (z_) {                          // E-43
    add(cutter_z * points, compliance_.of_cutter_couples(at), -sigma_);
    add(wall_z * points, compliance_.of_wall_couples(at, structure::Along::y), -sigma_);
  }
  if (x_) {
    add(wall_x * points, compliance_.of_wall_couples(at, structure::Along::x), -sigma_);
  }
  return all_.combined(weights);
}

numerics::PeriodicPieces AlsoBent::along(double height) const {
  if (!x_ || !compliance_.bodies().cutter) {
    return {};
  }
  const std::span<const double> at(&height, 1);
  const std::vector<double> G = compliance_.of_cutter(at, compliance_.basis().points());
  std::vector<double> weights(all_.functions());
  std::ranges::copy(G,
                    weights.begin() + static_cast<std::ptrdiff_t>(along_x * G.size()));
  return all_.combined(weights);
}

numerics::PeriodicPieces AlsoBent::moments() const {
  const std::size_t points = compliance_.basis().size();
  const std::size_t n = points + 2;
  std::vector<double> weights(n * all_.functions());
  for (std::size_t q = 0; q < n; ++q) {
    weights[q * all_.functions() + kinds * points + q] = 1.0;
  }
  return all_.combined(weights);
}

}  // namespace trochoid::surface
