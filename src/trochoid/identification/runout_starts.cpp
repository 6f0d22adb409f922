#include <trochoid/identification/runout_starts.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/problem.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

/// Starts for three and more teeth beyond the regular patterns.
constexpr int scattered_starts = 16;
/// Feeds below this part of the largest have runouts of their own to start from.
constexpr double different_feeds = 0.6;

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

/// Directions of an eccentricity: over one pitch where all phases are tried and teeth
/// can be renumbered, else over the turn.
std::vector<double> directions(const Problem& problem, int over_turn) {
  const int teeth = problem.setup.cutter.teeth();
  const bool alike = teeth_are_alike(problem);
  const int count = alike ? std::max(2, (over_turn + teeth - 1) / teeth) : over_turn;
  const double span = alike ? unit::turn / teeth : unit::turn;
  std::vector<double> out;
  out.reserve(index(count));
  for (int k = 0; k < count; ++k) out.push_back(span * k / count);
  return out;
}

/// Amplitudes in feeds; with feeds that differ much, those of the smallest as well.
std::vector<double> amplitudes(const Problem& problem, double some, double much) {
  double least = problem.unknowns.length;
  for (const FoldedRun& run : problem.runs) least = std::min(least, run.cut.f_z);
  const double ratio = least / problem.unknowns.length;
  return ratio > 0.0 && ratio < different_feeds
             ? std::vector<double>{some * ratio, some, much}
             : std::vector<double>{some, much};
}

void add_pair_starts(const Problem& problem, std::vector<std::vector<double>>& out) {
  const bool alike = teeth_are_alike(problem);
  for (const double s : amplitudes(problem, 0.4, 1.3)) {
    out.push_back({-s});
    if (!alike) out.push_back({s});
  }
}

void add_offset_starts(const Problem& problem, std::vector<std::vector<double>>& out) {
  const std::vector<double> psi = geometry::tooth_angles(problem.setup.cutter);
  const std::size_t n = psi.size();
  const bool alike = teeth_are_alike(problem);
  if (n == 2) {
    add_pair_starts(problem, out);
    return;
  }
  for (const double amplitude : amplitudes(problem, 0.3, 0.9)) {
    for (const double lambda : directions(problem, 8)) {
      out.push_back(eccentric_offsets(psi, amplitude, lambda));
    }
  }
  // One tooth alone is short: tooth 2 where they are alike, for tooth 1 has the diameter that
  // bounds the arc of the cut.
  for (std::size_t tooth = alike ? 1 : 0; tooth < (alike ? 2 : n) && n <= 8; ++tooth) {
    std::vector<double> s(n - 1, tooth == 0 ? 0.8 : 0.0);
    if (tooth > 0) s[tooth - 1] = -0.8;
    out.push_back(s);
  }
  for (int i = 1; i <= scattered_starts; ++i) out.push_back(scattered_offsets(n, i));
  if (n % 2 == 0) {
    for (const double sign : {0.5, -0.5}) {
      std::vector<double> s(n - 1, 0.0);
      for (std::size_t k = 0; k < n - 1; k += 2) s[k] = sign;
      out.push_back(s);
      if (alike) break;
    }
  }
}

void add_eccentric_starts(const Problem& problem,
                          std::vector<std::vector<double>>& out) {
  for (const double rho : amplitudes(problem, 0.3, 0.8)) {
    for (const double lambda : directions(problem, 6)) {
      out.push_back({rho * std::cos(lambda), rho * std::sin(lambda)});
    }
  }
}

/// Either without the other.
void add_starts_of_both(const Problem& problem, std::vector<std::vector<double>>& out) {
  std::vector<std::vector<double>> some;
  add_offset_starts(problem, some);
  for (std::vector<double>& s : some) {
    s.insert(s.end(), 2, 0.0);
    out.push_back(std::move(s));
  }
  some.clear();
  add_eccentric_starts(problem, some);
  for (std::vector<double>& e : some) {
    e.insert(e.begin(), index(problem.unknowns.teeth - 1), 0.0);
    out.push_back(std::move(e));
  }
}

}  // namespace

std::vector<double> given_runout(const Problem& problem) {
  std::vector<double> given =
      parameters_of(problem, {problem.setup.runout, problem.law,
                              std::vector<double>(problem.runs.size(), 0.0)});
  given.resize(index(problem.unknowns.runout_count()));
  return given;
}

std::vector<std::vector<double>> runout_starts(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  std::vector<std::vector<double>> out = {
      std::vector<double>(index(u.runout_count()), 0.0)};
  if (u.runout_count() == 0) return out;
  const std::vector<double> given = given_runout(problem);
  if (std::ranges::any_of(given, [](double v) { return v != 0.0; }))
    out.push_back(given);
  if (u.runout == RunoutUnknowns::both) {
    add_starts_of_both(problem, out);
  } else if (u.runout == RunoutUnknowns::offsets) {
    add_offset_starts(problem, out);
  } else if (u.direction) {
    for (const double e : amplitudes(problem, 0.3, 0.8)) {
      out.push_back({e});
      out.push_back({-e});
    }
  } else {
    add_eccentric_starts(problem, out);
  }
  return out;
}

}  // namespace trochoid::identification
