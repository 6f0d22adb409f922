#include <trochoid/run/choose_axes.h>

#include <trochoid/run/fit_options.h>
#include <trochoid/signal/axes.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

using Vector3 = std::array<double, 3>;

/// Readings whose residuals differ by less than this are the same data.
constexpr double same_rms = 1e-6;

struct Reading {
  Matrix3 Q;
  double rms = 0.0;
  Vector3 K{};  ///< cutting coefficients t, r, a
  Vector3 K_se{};
};

Vector3 turned(const Matrix3& turn, const Vector3& v) {
  Vector3 out{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out[i] += turn[i][j] * v[j];
    }
  }
  return out;
}

/// Fit with one reading of the channels; rms is infinite where there is no fit.
Reading fitted(const inputs::Case& given, const std::vector<MeasuredRun>& runs,
               const Matrix3& Q, std::string& message) {
  Reading reading{.Q = Q, .rms = INFINITY};
  identification::Options options =
      fit_options(given, given.identify.chip_models.back());
  options.band_harmonics = std::max(2, given.setup.cutter.teeth());
  if (given.identify.band_harmonics > 0) {
    options.band_harmonics =
        std::min(options.band_harmonics, given.identify.band_harmonics);
  }
  const auto fit =
      identification::identify(given.setup, given.law, on_tool(runs, Q), options);
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

std::vector<Reading> all_readings(const inputs::Case& given,
                                  const std::vector<MeasuredRun>& runs,
                                  const Progress& progress, std::string& message) {
  std::vector<Reading> readings;
  if (force::keeps_radius(given.setup)) {
    for (const signal::AxesClass& c : signal::axes_classes()) {
      progress("finding the axes of the dynamometer");
      const Reading first = fitted(given, runs, c.readings.front().Q, message);
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
  for (const Matrix3& Q : signal::axes_candidates()) {
    progress("finding the axes of the dynamometer");
    readings.push_back(fitted(given, runs, Q, message));
  }
  return readings;
}

int positive(const Reading& r) {
  // The tangential force decides first, then the radial one.
  return (r.K[0] > 0 ? 4 : 0) + (r.K[1] > 0 ? 2 : 0) + (r.K[2] > 0 ? 1 : 0);
}

}  // namespace

AxesChoice choose_axes(const inputs::Case& given, const std::vector<MeasuredRun>& runs,
                       const Progress& progress, std::vector<base::Warning>& warnings) {
  AxesChoice choice;
  std::vector<Reading> readings = all_readings(given, runs, progress, choice.message);
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
  const bool safe = positive(chosen) == 7 && chosen.K[0] > 2 * chosen.K_se[0] &&
                    chosen.K[1] > 2 * chosen.K_se[1];
  if (other - readings.begin() > 1 && !safe) {
    warnings.push_back(
        {"axes_signs",
         "Several readings of the channels fit the record equally well and were told "
         "apart by K_tc, K_rc, K_ac > 0, but these coefficients are not all clearly "
         "positive: check the axes of the dynamometer."});
  }
  if (choice.next_rms < 1.5 * choice.rms) {
    warnings.push_back(
        {"axes_close",
         fmt::format(
             "The next best reading of the channels is only {:.2f} times worse: "
             "check the axes of the dynamometer.",
             choice.next_rms / choice.rms)});
  }
  return choice;
}

double reading_rms(const inputs::Case& given, const std::vector<MeasuredRun>& runs,
                   const Matrix3& M) {
  std::string message;
  return fitted(given, runs, M, message).rms;
}

}  // namespace trochoid::run
