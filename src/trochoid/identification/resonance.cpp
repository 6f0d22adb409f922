#include <trochoid/identification/resonance.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/spectrum.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace trochoid::identification {

namespace {

using base::index;
using std::complex;

constexpr int most_resolved = 60;
/// Slower ones than this harmonic are those of the machine, not of a dynamometer.
constexpr int first_harmonic = 3;
/// Less damping is not believed: near a harmonic, amplitude alone would tell it.
constexpr double least_damping = 0.02;
constexpr std::array dampings{0.02, 0.03, 0.05, 0.08, 0.12, 0.2};
/// A resonance that explains less of what is left is none.
constexpr double least_explained_left = 0.3;
/// What a rigid fit leaves must repeat turn by turn so much beyond what scatter makes of it.
constexpr double repeating = 1.2;
/// The second time the force is better known.
constexpr int rounds_of_fits = 2;

/// Measured and computed amplitude of one axis at one harmonic.
struct Line {
  double omega = 0.0;  ///< [rad/s]
  complex<double> measured;
  complex<double> force;
};

complex<double> gain(double omega, double omega_n, double zeta) {
  const double x = omega / omega_n;
  return 1.0 / complex<double>(1.0 - x * x, 2.0 * zeta * x);
}

double squares(std::span<const Line> lines, double omega_n, double zeta) {
  double sum = 0.0;
  for (const Line& l : lines) {
    sum += std::norm(l.measured - gain(l.omega, omega_n, zeta) * l.force);
  }
  return sum;
}

/// Lines of each axis over all runs.
std::array<std::vector<Line>, 3> lines_of(
    std::span<const Run> runs,
    std::span<const std::vector<std::array<double, 3>>> fitted,
    std::span<const Response> response) {
  std::array<std::vector<Line>, 3> out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const int highest = resolved_harmonics(runs[r]);
    const auto measured = turn_lines(runs[r].angle, runs[r].force, highest);
    const auto computed = turn_lines(runs[r].angle, fitted[r], highest);
    for (std::size_t q = 0; q < 3; ++q) {
      for (std::size_t k = 1; k < measured[q].size(); ++k) {
        complex<double> force = computed[q][k];
        if (r < response.size() && k < response[r].harmonic.size()) {
          force /= response[r].harmonic[k][4 * q];
        }
        out[q].push_back(
            {static_cast<double>(k) * runs[r].cut.Omega, measured[q][k], force});
      }
    }
  }
  return out;
}

/// Sum of squares of the lines of each axis that scatter makes [N^2].
std::array<double, 3> noise_of(
    std::span<const Run> runs,
    std::span<const std::vector<std::array<double, 3>>> fitted) {
  std::array<double, 3> out{};
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Spectrum one = spectrum_of(runs[r], fitted[r], 0);
    if (one.highest < 0) continue;
    // A row is sqrt(n/2) times the cosine or sine part of a line.
    const double lines = resolved_harmonics(runs[r]);
    const double scale = 2.0 / static_cast<double>(runs[r].angle.size());
    for (std::size_t q = 0; q < 3; ++q) {
      double sum = 0.0;
      for (std::size_t k = 1; k < one.lines(); ++k) {
        sum += scale * one.scatter[q * one.lines() + k];
      }
      out[q] += sum * lines / one.highest;
    }
  }
  return out;
}

/// The best of a grid, then smaller and smaller steps about it.
Resonance best_resonance(std::span<const Line> lines, double lowest, double highest,
                         double noise) {
  constexpr int steps = 160;
  Resonance best;
  double least = INFINITY;
  const auto try_one = [&](double omega_n, double zeta) {
    if (zeta < least_damping) return false;
    const double s = squares(lines, omega_n, zeta);
    if (!(s < least)) return false;
    least = s;
    best.omega = omega_n;
    best.zeta = zeta;
    return true;
  };
  for (int i = 0; i <= steps; ++i) {
    const double omega_n = lowest * std::pow(highest / lowest, i / double(steps));
    for (const double zeta : dampings) try_one(omega_n, zeta);
  }
  double step = 0.02;
  while (step > 1e-5) {
    const Resonance at = best;
    for (const double f : {1.0 - step, 1.0 + step}) {
      try_one(at.omega * f, at.zeta);
      try_one(at.omega, at.zeta * (1.0 + 10.0 * (f - 1.0)));
    }
    step *= 0.6;
  }
  double before = 0.0;
  for (const Line& l : lines) before += std::norm(l.measured - l.force);
  best.explained = before > noise ? (before - least) / (before - noise) : 0.0;
  return best;
}

std::vector<Response> responses(std::span<const Run> runs, const Resonances& found) {
  std::vector<Response> out;
  for (const Run& run : runs) {
    out.push_back(response_of(found, run.cut.Omega, resolved_harmonics(run)));
  }
  return out;
}

/// The harmonics below the slowest resonance that bear it: its frequency is known to a
/// per cent, by which the amplification then changes by little more.
int band_below(std::span<const Run> runs, const Resonances& found) {
  constexpr double bearable = 0.7;
  double highest = most_resolved;
  for (const Run& run : runs) {
    highest = std::min(highest, double(resolved_harmonics(run)));
    for (const auto& r : found) {
      if (r) highest = std::min(highest, bearable * r->omega / run.cut.Omega);
    }
  }
  return static_cast<int>(highest);
}

bool any(const Resonances& found) {
  return std::ranges::any_of(found, [](const auto& r) { return r.has_value(); });
}

}  // namespace

bool repeats(std::span<const Run> runs, const Fit& fit) {
  double left = 0.0;
  double scatter = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Spectrum one = spectrum_of(runs[r], fit.fitted[r], 0);
    if (one.highest < 0) return false;
    for (std::size_t i = 0; i < one.rows(); ++i) {
      left += one.left[i] * one.left[i];
      scatter += one.scatter[i];
    }
  }
  return left > repeating * scatter;
}

int resolved_harmonics(const Run& run) {
  const double span = std::abs(run.angle.back() - run.angle.front());
  const double per_turn =
      span > 0 ? static_cast<double>(run.angle.size() - 1) * unit::turn / span : 1.0;
  return static_cast<int>(std::clamp(0.4 * per_turn, 1.0, double(most_resolved)));
}

Resonances find_resonances(std::span<const Run> runs,
                           std::span<const std::vector<std::array<double, 3>>> fitted,
                           std::span<const Response> response) {
  double slowest = INFINITY;
  double highest = INFINITY;
  for (const Run& run : runs) {
    slowest = std::min(slowest, run.cut.Omega);
    highest = std::min(highest, resolved_harmonics(run) * run.cut.Omega);
  }
  Resonances out;
  const double lowest = first_harmonic * slowest;
  if (!(highest > 2.0 * lowest)) return out;
  const auto lines = lines_of(runs, fitted, response);
  const auto noise = noise_of(runs, fitted);
  for (std::size_t q = 0; q < 3; ++q) {
    const Resonance best = best_resonance(lines[q], lowest, 1.5 * highest, noise[q]);
    if (best.explained > least_explained_left) out[q] = best;
  }
  return out;
}

Response response_of(const Resonances& resonances, double Omega, int highest) {
  Response out;
  for (int k = 0; k <= highest; ++k) {
    Response::Matrix H{};
    for (std::size_t q = 0; q < 3; ++q) {
      H[4 * q] = resonances[q]
                     ? gain(k * Omega, resonances[q]->omega, resonances[q]->zeta)
                     : 1.0;
    }
    out.harmonic.push_back(H);
  }
  return out;
}

std::optional<Fit> fit_through_resonance(const force::Setup& setup,
                                         const force::Law& law,
                                         std::span<const Run> runs, const Fit& rigid) {
  Resonances found = find_resonances(runs, rigid.fitted, {});
  if (!any(found)) return std::nullopt;
  std::optional<Fit> fit;
  for (int i = 0; i < rounds_of_fits; ++i) {
    const Fit& from = fit ? *fit : rigid;
    Options options = rigid.options;
    options.response = responses(runs, found);
    options.band_harmonics = band_below(runs, found);
    options.start = Start{from.runout, from.phase};
    if (!any(found) || options.band_harmonics < setup.cutter.teeth()) break;
    Fit next = identify(setup, law, runs, options);
    if (!next.ok) break;
    next.resonances = found;
    found = find_resonances(runs, next.fitted, options.response);
    fit = std::move(next);
  }
  return fit;
}

}  // namespace trochoid::identification
