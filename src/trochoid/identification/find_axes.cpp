#include <trochoid/identification/find_axes.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::identification {

namespace {

using Vector3 = std::array<double, 3>;

/// Readings whose residuals differ by less than this are the same data.
constexpr double same_rms = 1e-6;

struct Reading {
  signal::Matrix3 Q;
  double rms = 0.0;
  Vector3 K{};  ///< cutting coefficients t, r, a
  Vector3 K_se{};
};

Vector3 turned(const signal::Matrix3& turn, const Vector3& v) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out[i] += turn[i][j] * v[j];
    }
  }
  return out;
}

/// Fit with one reading of the channels; rms is infinite where there is no fit.
Reading fitted(const AxesProblem& problem, std::span<const ChannelRun> runs,
               const signal::Matrix3& Q, std::string& message) {
  Reading reading{.Q = Q, .rms = INFINITY};
  Options options = problem.options;
  options.band_harmonics = std::max(2, problem.setup.cutter.teeth());
  if (problem.options.band_harmonics > 0) {
    options.band_harmonics =
        std::min(options.band_harmonics, problem.options.band_harmonics);
  }
  const Fit fit = identify(problem.setup, problem.law, on_tool(runs, Q), options);
  if (!fit.ok) {
    message = fit.message;
    if (!(fit.rms > 0)) {
      return reading;
    }
    // Refused, but what it leaves unexplained still tells how wrong this reading is.
  }
  reading.rms = fit.rms;
  for (std::size_t q = 0; q < 3; ++q) {
    if (fit.coefficients[q]) {
      reading.K[q] = fit.coefficients[q]->value;
      reading.K_se[q] = fit.coefficients[q]->se;
    }
  }
  return reading;
}

std::vector<Reading> all_readings(const AxesProblem& problem,
                                  std::span<const ChannelRun> runs,
                                  const std::function<void()>& told,
                                  std::string& message) {
  std::vector<Reading> readings;
  const auto fit = [&](const signal::Matrix3& Q) {
    if (told) {
      told();
    }
    return fitted(problem, runs, Q, message);
  };
  if (!force::keeps_radius(problem.setup)) {
    for (const signal::Matrix3& Q : signal::axes_candidates()) {
      readings.push_back(fit(Q));
    }
    return readings;
  }
  for (const signal::AxesClass& c : signal::axes_classes()) {
    const Reading first = fit(c.readings.front().Q);
    for (const signal::AxesReading& r : c.readings) {
      const Vector3 se = turned(r.turn, first.K_se);
      readings.push_back({r.Q,
                          first.rms,
                          turned(r.turn, first.K),
                          {std::abs(se[0]), std::abs(se[1]), std::abs(se[2])}});
    }
  }
  return readings;
}

int positive(const Reading& r) {
  // The tangential force decides first, then the radial one.
  return (r.K[0] > 0 ? 4 : 0) + (r.K[1] > 0 ? 2 : 0) + (r.K[2] > 0 ? 1 : 0);
}

}  // namespace

std::vector<Run> on_tool(std::span<const ChannelRun> runs, const signal::Matrix3& M) {
  std::vector<Run> out;
  for (const ChannelRun& run : runs) {
    auto force = signal::force_on_tool(run.channel, M);
    if (!force) {
      throw std::invalid_argument("the matrix of the dynamometer cannot be inverted");
    }
    out.push_back({run.cut, run.angle, std::move(*force)});
  }
  return out;
}

AxesChoice find_axes(const AxesProblem& problem, std::span<const ChannelRun> runs,
                     const std::function<void()>& told) {
  AxesChoice choice;
  std::vector<Reading> readings = all_readings(problem, runs, told, choice.message);
  std::stable_sort(readings.begin(), readings.end(),
                   [](const Reading& a, const Reading& b) { return a.rms < b.rms; });
  const double best = readings.front().rms;
  const auto other = std::find_if(
      readings.begin(), readings.end(),
      [&](const Reading& r) { return r.rms > best * (1 + same_rms) + 1e-9; });
  const Reading& chosen = *std::max_element(
      readings.begin(), other,
      [](const Reading& a, const Reading& b) { return positive(a) < positive(b); });
  if (!std::isfinite(chosen.rms) || positive(chosen) == 0) {
    choice.message = "no reading of the channels could be fitted: " + choice.message;
    choice.rms = chosen.rms;
    return choice;
  }
  choice.ok = true;
  choice.matrix = chosen.Q;
  choice.rms = chosen.rms;
  choice.next_rms = other == readings.end() ? INFINITY : other->rms;
  const bool clear = positive(chosen) == 7 && chosen.K[0] > 2 * chosen.K_se[0] &&
                     chosen.K[1] > 2 * chosen.K_se[1];
  choice.signs_clear = clear || other - readings.begin() <= 1;
  return choice;
}

double reading_rms(const AxesProblem& problem, std::span<const ChannelRun> runs,
                   const signal::Matrix3& M) {
  std::string message;
  return fitted(problem, runs, M, message).rms;
}

}  // namespace trochoid::identification
