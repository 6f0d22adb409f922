#include <trochoid/correction/learning.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction {

namespace {

/// Root mean square over a turn of the first n harmonics, the mean left out.
double size_of(const Harmonics& motion, std::size_t n) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(n, motion.c.size()); ++i) {
    sum += std::norm(motion.c[i]) / 2;
  }
  return std::sqrt(sum);
}

}  // namespace

// six parameters: what is wanted, the first try, the plant at a speed, and its table
Learned learn(const PeriodicMotion& motion, const Harmonics& start, const Plant& model,
              double Omega, const MeasuredTable& measured,
              const LearningOptions& options) {
  const std::size_t count = start.c.size();
  const Harmonics wanted = harmonics_of(motion, static_cast<int>(count));
  const double enough = options.enough * size_of(wanted, count);
  Learned out;
  out.command = start;
  for (;;) {
    Harmonics error = measured(out.command);
    error.c.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      error.c[i] = wanted.c[i] - error.c[i];
    }
    out.error.push_back(size_of(error, count));
    out.converged = out.error.back() <= enough;
    if (out.converged || out.iterations >= options.iterations ||
        !std::isfinite(out.error.back())) {
      return out;
    }
    for (std::size_t i = 0; i < count; ++i) {
      const double omega = (static_cast<double>(i) + 1) * Omega;
      out.command.c[i] += options.gain * error.c[i] / response(model, omega);
    }
    ++out.iterations;
  }
}

std::vector<double> learning_factors(const Plant& real, const Plant& model,
                                     double Omega, double gain, int n_max) {
  std::vector<double> factors;
  for (int n = 1; n <= n_max; ++n) {
    factors.push_back(std::abs(1.0 - gain * response(real, n * Omega) /
                                         response(model, n * Omega)));
  }
  return factors;
}

std::optional<int> iterations_needed(std::span<const double> factors, double part) {
  const double largest = *std::max_element(factors.begin(), factors.end());
  if (!(largest < 1)) {
    return std::nullopt;
  }
  return largest > 0 ? static_cast<int>(std::ceil(std::log(part) / std::log(largest)))
                     : 1;
}

double phase_error_allowed(double gain) noexcept {
  return gain > 0 && gain < 2 ? std::acos(gain / 2) : 0.0;
}

double settling_time(const Plant& model) noexcept {
  return 5 * structure::low_frequency_delay(model.actuator);
}

}  // namespace trochoid::correction
