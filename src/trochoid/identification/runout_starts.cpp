#include <trochoid/identification/runout_starts.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

/// Starts for three and more teeth beyond the regular patterns.
constexpr int scattered_starts = 16;

using base::index;

/// Offsets like those of an eccentric tool, relative to tooth 1.
std::vector<double> eccentric_offsets(const std::vector<double>& psi, double amplitude,
                                      double lambda) {
  std::vector<double> out;
  for (std::size_t k = 1; k < psi.size(); ++k) {
    out.push_back(amplitude * (std::cos(psi[k] - lambda) - std::cos(lambda)));
  }
  return out;
}

/// Offsets spread evenly over (-0.9, 0.9) in all teeth (an additive recurrence with the
/// roots of x^(n) = x + 1).
std::vector<double> scattered_offsets(std::size_t n, int i) {
  double root = 1.5;
  for (int step = 0; step < 40; ++step) {
    root = std::pow(1.0 + root, 1.0 / static_cast<double>(n));
  }
  std::vector<double> out;
  for (std::size_t k = 1; k < n; ++k) {
    const double a = i * std::pow(root, -static_cast<double>(k));
    out.push_back(1.8 * (a - std::floor(a)) - 0.9);
  }
  return out;
}

void add_offset_starts(const Problem& problem, std::vector<std::vector<double>>& out) {
  const std::vector<double> psi = geometry::tooth_angles(problem.setup.cutter);
  const std::size_t n = psi.size();
  if (n == 2) {
    for (const double s : {0.4, -0.4, 1.3, -1.3}) out.push_back({s});
    return;
  }
  for (const double amplitude : {0.3, 0.9}) {
    for (int k = 0; k < 8; ++k) {
      out.push_back(eccentric_offsets(psi, amplitude, 0.125 * unit::turn * k));
    }
  }
  for (std::size_t tooth = 0; tooth < n && n <= 8; ++tooth) {
    std::vector<double> s(n - 1, tooth == 0 ? 0.8 : 0.0);  // tooth 1 alone is short
    if (tooth > 0) s[tooth - 1] = -0.8;
    out.push_back(s);
  }
  for (int i = 1; i <= scattered_starts; ++i) out.push_back(scattered_offsets(n, i));
  if (n % 2 == 0) {
    for (const double sign : {0.5, -0.5}) {
      std::vector<double> s(n - 1, 0.0);
      for (std::size_t k = 0; k < n - 1; k += 2) s[k] = sign;
      out.push_back(s);
    }
  }
}

}  // namespace

std::vector<std::vector<double>> runout_starts(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  std::vector<std::vector<double>> out = {
      std::vector<double>(index(u.runout_count()), 0.0)};
  if (u.runout_count() == 0) return out;
  std::vector<double> given =
      parameters_of(problem, {problem.setup.runout, problem.law,
                              std::vector<double>(problem.runs.size(), 0.0)});
  given.resize(index(u.runout_count()));
  if (std::ranges::any_of(given, [](double v) { return v != 0.0; }))
    out.push_back(given);
  if (u.runout == RunoutUnknowns::offsets) {
    add_offset_starts(problem, out);
  } else if (u.direction) {
    for (const double e : {0.3, -0.3, 0.8, -0.8}) out.push_back({e});
  } else {
    for (const double rho : {0.3, 0.8}) {
      for (int k = 0; k < 6; ++k) {
        const double lambda = unit::turn * k / 6.0;
        out.push_back({rho * std::cos(lambda), rho * std::sin(lambda)});
      }
    }
  }
  return out;
}

}  // namespace trochoid::identification
