#include <trochoid/base/estimate.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/structure/identify_actuator.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>

namespace trochoid::structure {

namespace {

constexpr double margin = 3.0;  ///< of M-14, in standard errors
constexpr double steps_rank_tolerance = 1e-12;
constexpr double least_of_step = 0.95;  ///< of the variance
constexpr double unsettled = 0.02;      ///< of the step, left at the end
constexpr double drifting = 0.05;       ///< of the step, over the last tenth
constexpr double least_signal = 4.0;    ///< step over noise
constexpr std::size_t least_samples = 10;

/// The record in parts of the step, and of a time that is about that of the rise.
struct Problem {
  const StepRecord* record = nullptr;
  double tau = 1.0;     ///< unit of time [s]
  double origin = 0.0;  ///< start of the step, as first guessed [s]
  bool free_start = true;
};

/// Parameters: gain, ln(S/tau), ln(P/tau^2), rest over step, and (start - origin)/tau.
struct Parameters {
  ActuatorDynamics dynamics;
  double rest = 0.0;   ///< over the step
  double start = 0.0;  ///< [s]
};

Parameters read(const Problem& problem, std::span<const double> p) {
  return {.dynamics = {.gain = p[0],
                       .sum = problem.tau * std::exp(p[1]),
                       .product = problem.tau * problem.tau * std::exp(p[2])},
          .rest = p[3],
          .start = problem.origin + (problem.free_start ? problem.tau * p[4] : 0.0)};
}

double model(const Parameters& at, double t) {
  return at.rest + step_response(at.dynamics, t - at.start);
}

/// Residuals; derivatives by central differences, which the smooth model allows.
bool evaluate(const Problem& problem, std::span<const double> p, std::span<double> r,
              std::span<double> jacobian) {
  if (std::abs(p[1]) > 20 || std::abs(p[2]) > 30) {
    return false;
  }
  const StepRecord& record = *problem.record;
  const std::size_t n = record.time.size();
  const double scale = 1 / std::sqrt(static_cast<double>(n));
  const Parameters at = read(problem, p);
  for (std::size_t i = 0; i < n; ++i) {
    r[i] = scale * (model(at, record.time[i]) - record.position[i] / record.step);
  }
  if (jacobian.empty()) {
    return true;
  }
  constexpr double h = 1e-5;
  std::vector<double> moved(p.begin(), p.end());
  for (std::size_t k = 0; k < p.size(); ++k) {
    moved[k] = p[k] + h;
    const Parameters up = read(problem, moved);
    moved[k] = p[k] - h;
    const Parameters down = read(problem, moved);
    moved[k] = p[k];
    for (std::size_t i = 0; i < n; ++i) {
      jacobian[k * n + i] =
          scale * (model(up, record.time[i]) - model(down, record.time[i])) / (2 * h);
    }
  }
  return true;
}

/// Mean of the positions from sample `from` to before sample `to`.
double mean(const StepRecord& record, std::size_t from, std::size_t to) {
  double sum = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    sum += record.position[i];
  }
  return sum / static_cast<double>(to - from);
}

/// First guesses from the record itself.
struct Guess {
  double rest = 0.0;     ///< [m]
  double settled = 0.0;  ///< [m]
  double start = 0.0;    ///< [s]
  double half = 0.0;     ///< from the start to half of the rise [s]
};

Guess guess(const StepRecord& record) {
  const std::size_t n = record.time.size();
  Guess out;
  out.settled = mean(record, n - std::max<std::size_t>(n / 10, 1), n);
  std::size_t before = 0;
  const double known = record.start    ? *record.start
                       : record.change ? (*record.change)[0]
                                       : -std::numeric_limits<double>::infinity();
  while (before < n && record.time[before] <= known) {
    ++before;
  }
  out.rest = before > 0 ? mean(record, 0, before) : record.position.front();
  const double rise = out.settled - out.rest;
  std::size_t middle = before;
  while (middle + 1 < n && (record.position[middle] - out.rest) / rise < 0.5) {
    ++middle;
  }
  std::size_t early = middle;
  while (early > 0 && (record.position[early] - out.rest) / rise > 0.1) {
    --early;
  }
  // Of a critically damped step 10 % comes after 0.53, 50 % after 1.68 of 1/omega_n.
  const double from_10_to_50 = record.time[middle] - record.time[early];
  out.start = record.start    ? *record.start
              : record.change ? ((*record.change)[0] + (*record.change)[1]) / 2
                              : std::max(record.time[early] - 0.46 * from_10_to_50,
                                         record.time.front());
  const double spacing =
      (record.time.back() - record.time.front()) / static_cast<double>(n - 1);
  out.half = std::max(record.time[middle] - out.start, spacing / 2);
  return out;
}

struct Solved {
  std::vector<double> p;
  double cost = std::numeric_limits<double>::infinity();
  bool converged = false;
};

numerics::Residuals residuals_of(const Problem& problem) {
  return [&problem](std::span<const double> p, std::span<double> r,
                    std::span<double> jacobian) {
    return evaluate(problem, p, r, jacobian);
  };
}

/// From several dampings: the sum of squares can have more than one valley.
Solved solve(const Problem& problem, const Guess& first) {
  const StepRecord& record = *problem.record;
  const auto count = static_cast<int>(record.time.size());
  const numerics::Residuals residuals = residuals_of(problem);
  Solved out;
  for (const double zeta : {0.1, 0.4, 1.0, 2.5}) {
    const double omega_tau = 1.05 + 0.63 * zeta;  // half of the rise at tau
    std::vector<double> p = {(first.settled - first.rest) / record.step,
                             std::log(2 * zeta / omega_tau), -2 * std::log(omega_tau),
                             first.rest / record.step};
    if (problem.free_start) {
      p.push_back(0.0);
    }
    const auto fit =
        numerics::levenberg_marquardt(residuals, count, p, {.max_iterations = 200});
    if (fit.final_cost < out.cost && fit.reason != "not started") {
      out = {fit.p, fit.final_cost, fit.converged};
    }
  }
  return out;
}

/// Standard error of a function with this gradient over the parameters 1 and 2.
double error(const std::vector<double>& C, std::size_t n, double by_1, double by_2) {
  const double value =
      by_1 * by_1 * C[n + 1] + 2 * by_1 * by_2 * C[n + 2] + by_2 * by_2 * C[2 * n + 2];
  return std::sqrt(std::max(value, 0.0));
}

void add_errors(const std::vector<double>& C, std::size_t n, double tau,
                ActuatorFit& fit) {
  const double S = fit.dynamics.sum;
  const double P = fit.dynamics.product;
  fit.gain_se = std::sqrt(std::max(C[0], 0.0));
  fit.sum_se = error(C, n, S, 0);
  fit.product_se = error(C, n, 0, P);
  const double zeta = damping_ratio(fit.dynamics);
  fit.damping_ratio_se = error(C, n, zeta, -zeta / 2);
  const double frequency = natural_frequency(fit.dynamics) / unit::turn;
  fit.frequency_se = error(C, n, 0, frequency / 2);
  fit.start_se = n > 4 ? tau * std::sqrt(std::max(C[4 * n + 4], 0.0)) : 0.0;
  const double discriminant = S * S - 4 * P;  // M-14
  const double discriminant_se = error(C, n, 2 * S * S, -4 * P);
  if (discriminant <= margin * discriminant_se) {
    fit.time_constants_reason =
        discriminant < -margin * discriminant_se
            ? fmt::format(
                  "the actuator is underdamped (damping ratio {:.4g}): it has "
                  "no real time constants",
                  zeta)
            : fmt::format(
                  "the damping ratio, {:.5g} +- {:.1g}, is too near to 1: only "
                  "the sum and the product of the time constants are known",
                  zeta, base::normal_interval * fit.damping_ratio_se);
    return;
  }
  const auto T = time_constants(fit.dynamics);
  fit.time_constants = T;
  const double root = std::sqrt(discriminant);
  fit.time_constants_se = {error(C, n, (*T)[0] * S / root, -P / root),
                           error(C, n, -(*T)[1] * S / root, P / root)};
}

/// Why this record shows no step that has come to rest; empty: it does.
std::string fault_of(const StepRecord& record, const ActuatorFit& fit) {
  const double rise = std::abs(fit.dynamics.gain * record.step);
  if (!(rise > least_signal * fit.rms)) {
    return fmt::format(
        "there is no step in the record: the position changes by "
        "{:.3g} um, what the fit leaves is {:.3g} um",
        rise * 1e6, fit.rms * 1e6);
  }
  const double left = record.time.back() - fit.start;
  const double a = damping_ratio(fit.dynamics) < 1
                       ? fit.dynamics.sum / (2 * fit.dynamics.product)
                       : 1 / (*time_constants(fit.dynamics))[0];
  const double rest = std::exp(-a * std::max(left, 0.0));
  if (rest > unsettled) {
    return fmt::format(
        "the step does not settle within the record: at its end {:.0f} % "
        "of the motion is still to come or to die out. A longer record "
        "is needed",
        100 * rest);
  }
  const std::size_t n = record.time.size();
  const std::size_t tenth = std::max<std::size_t>(n / 10, 2);
  const double drift =
      mean(record, n - tenth / 2, n) - mean(record, n - 2 * (tenth / 2), n - tenth / 2);
  const double noise = 2 * fit.rms / std::sqrt(static_cast<double>(tenth / 2));
  if (std::abs(drift) > drifting * rise + margin * noise) {
    return fmt::format(
        "the step never settles: the position still drifts by {:.3g} um "
        "over the last tenth of the record",
        drift * 1e6);
  }
  if (fit.explained < least_of_step) {
    return fmt::format(
        "two poles do not explain this step: they leave {:.1f} % of its variance",
        100 * (1 - fit.explained));
  }
  return {};
}

void add_quality(const StepRecord& record, ActuatorFit& fit) {
  const std::size_t n = record.time.size();
  const double middle = mean(record, 0, n);
  double rss = 0.0;
  double all = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    fit.fitted.push_back(fit.rest +
                         record.step *
                             step_response(fit.dynamics, record.time[i] - fit.start));
    rss += std::pow(record.position[i] - fit.fitted.back(), 2);
    all += std::pow(record.position[i] - middle, 2);
  }
  fit.rms = std::sqrt(rss / static_cast<double>(n));
  fit.explained = all > 0 ? 1 - rss / all : 0.0;
}

}  // namespace

ActuatorFit identify_actuator(const StepRecord& record) {
  const std::size_t n = record.time.size();
  if (n != record.position.size() || record.step == 0) {
    throw std::invalid_argument(
        "identify_actuator: times and positions must be equally many, the step not 0");
  }
  ActuatorFit fit;
  if (n < least_samples) {
    fit.reason = fmt::format("the record has {} samples: at least {} are needed", n,
                             least_samples);
    return fit;
  }
  const Guess first = guess(record);
  if (first.settled == first.rest) {
    fit.reason = "there is no step in the record: the position does not change";
    return fit;
  }
  const Problem problem{.record = &record,
                        .tau = first.half,
                        .origin = first.start,
                        .free_start = !record.start};
  const Solved solved = solve(problem, first);
  if (solved.p.empty() || !std::isfinite(solved.cost)) {
    fit.reason = "the fit did not start: the record is not like a step";
    return fit;
  }
  const Parameters at = read(problem, solved.p);
  fit.dynamics = at.dynamics;
  fit.rest = at.rest * record.step;
  fit.start = at.start;
  add_quality(record, fit);
  fit.reason = fault_of(record, fit);
  if (fit.reason.empty() && !solved.converged) {
    fit.reason = "the fit did not converge";
  }
  if (!fit.reason.empty()) {
    return fit;
  }
  const auto C = numerics::covariance_at(residuals_of(problem),
                                         static_cast<int>(record.time.size()), solved.p,
                                         solved.cost, steps_rank_tolerance);
  if (C.empty()) {
    fit.reason =
        "gain, sum and product of the time constants cannot be determined separately";
    return fit;
  }
  add_errors(C, solved.p.size(), problem.tau, fit);
  fit.ok = true;
  return fit;
}

}  // namespace trochoid::structure
