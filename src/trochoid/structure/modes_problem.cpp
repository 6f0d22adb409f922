#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/structure/modes_problem.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;
constexpr double rank_tolerance = 1e-12;

/// Derivatives of M-6 at one line, as a receptance, in the order of the parameters.
std::vector<Complex> slopes(const ModesModel& model, double omega) {
  std::vector<Complex> out;
  out.reserve(model.size());
  for (const ModeTerm& t : model.terms) {
    const Complex D(t.omega * t.omega - omega * omega, 2 * t.zeta * t.omega * omega);
    const Complex G = 1.0 / D;
    out.push_back(-t.A * G * G * Complex(2 * t.omega, 2 * t.zeta * omega));
    out.push_back(-t.A * G * G * Complex(0, 2 * t.omega * omega));
    out.push_back(G);
  }
  if (model.residual_terms) {
    out.emplace_back(1.0);
    out.emplace_back(-1.0 / (omega * omega));
  }
  return out;
}

/// The linear parameters A, U, L for given frequencies and dampings.
void fit_linear(const FrequencyResponse& lines, ModesModel& model) {
  const std::size_t n = model.terms.size() + (model.residual_terms ? 2 : 0);
  const std::size_t m = 2 * lines.omega.size();
  std::vector<double> A(m * n);
  std::vector<double> b(m);
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex f = factor(lines.kind, lines.omega[i]);
    const auto row = slopes(model, lines.omega[i]);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t own =
          k < model.terms.size() ? 3 * k + 2 : k + 2 * model.terms.size();
      const Complex value = f * row[own];
      A[2 * i * n + k] = value.real();
      A[(2 * i + 1) * n + k] = value.imag();
    }
    b[2 * i] = lines.H[i].real();
    b[2 * i + 1] = lines.H[i].imag();
  }
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, rank_tolerance);
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    model.terms[r].A = fit.x[r];
  }
  if (model.residual_terms) {
    model.above = fit.x[n - 2];
    model.below = fit.x[n - 1];
  }
}

/// Parameters near 0 or 1 for the solver.
struct Scaling {
  ModesModel start;
  double A = 1.0;
  double above = 1.0;
  double below = 1.0;
  double H = 1.0;  ///< of the residuals
};

Scaling scaling_of(const FrequencyResponse& lines, const ModesModel& start) {
  Scaling s{.start = start};
  double A = 0.0;
  for (const ModeTerm& term : start.terms) {
    A = std::max(A, std::abs(term.A));
  }
  s.A = A > 0 ? A : 1.0;
  double sum = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < lines.H.size(); ++i) {
    sum += std::norm(lines.H[i]);
    largest =
        std::max(largest, std::abs(lines.H[i] / factor(lines.kind, lines.omega[i])));
  }
  s.H = sum > 0 ? std::sqrt(sum) : 1.0;
  s.above = largest > 0 ? largest : 1.0;
  s.below = s.above * lines.omega.front() * lines.omega.front();
  return s;
}

ModesModel unscaled(const Scaling& s, std::span<const double> p) {
  ModesModel model = s.start;
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    model.terms[r].omega = s.start.terms[r].omega * p[3 * r];
    model.terms[r].zeta = s.start.terms[r].zeta * std::exp(p[3 * r + 1]);
    model.terms[r].A = s.A * p[3 * r + 2];
  }
  if (model.residual_terms) {
    model.above = s.above * p[p.size() - 2];
    model.below = s.below * p[p.size() - 1];
  }
  return model;
}

std::vector<double> scaled(const Scaling& s) {
  std::vector<double> p;
  for (const ModeTerm& term : s.start.terms) {
    p.insert(p.end(), {1.0, 0.0, term.A / s.A});
  }
  if (s.start.residual_terms) {
    p.insert(p.end(), {s.start.above / s.above, s.start.below / s.below});
  }
  return p;
}

/// d(natural parameter)/d(scaled parameter)
std::vector<double> chain(const Scaling& s, const ModesModel& model) {
  std::vector<double> out;
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    out.insert(out.end(), {s.start.terms[r].omega, model.terms[r].zeta, s.A});
  }
  if (model.residual_terms) {
    out.insert(out.end(), {s.above, s.below});
  }
  return out;
}

bool evaluate(const FrequencyResponse& lines, const Scaling& s,
              std::span<const double> p, std::span<double> r,
              std::span<double> jacobian) {
  const ModesModel model = unscaled(s, p);
  for (const ModeTerm& term : model.terms) {
    if (!(term.omega > 0) || !(term.zeta > 1e-9) || term.zeta > 10) {
      return false;
    }
  }
  const std::vector<double> scale = chain(s, model);
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex f = factor(lines.kind, lines.omega[i]) / s.H;
    const Complex gap = f * receptance(model, lines.omega[i]) - lines.H[i] / s.H;
    r[2 * i] = gap.real();
    r[2 * i + 1] = gap.imag();
    if (jacobian.empty()) {
      continue;
    }
    const auto row = slopes(model, lines.omega[i]);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const Complex value = f * row[k] * scale[k];
      jacobian[k * r.size() + 2 * i] = value.real();
      jacobian[k * r.size() + 2 * i + 1] = value.imag();
    }
  }
  return true;
}

/// s^2 (J^T J)^-1 in the natural parameters (M-7).
void add_covariance(const FrequencyResponse& lines, const Scaling& s,
                    ModesSolution& solution) {
  const std::size_t n = solution.model.size();
  const std::size_t m = 2 * lines.omega.size();
  if (m <= n) {
    return;
  }
  std::vector<double> J(m * n);
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex f = factor(lines.kind, lines.omega[i]) / s.H;
    const auto row = slopes(solution.model, lines.omega[i]);
    for (std::size_t k = 0; k < n; ++k) {
      const Complex value = f * row[k];
      J[2 * i * n + k] = value.real();
      J[(2 * i + 1) * n + k] = value.imag();
    }
  }
  const std::vector<double> zero(m, 0.0);
  const auto fit =
      numerics::least_squares(J, static_cast<int>(n), zero, rank_tolerance);
  if (fit.inverse_gram.empty()) {
    return;
  }
  const double s2 = solution.rss / (s.H * s.H) / static_cast<double>(m - n);
  solution.covariance = fit.inverse_gram;
  for (double& value : solution.covariance) {
    value *= s2;
  }
  for (std::size_t k = 0; k < n; ++k) {
    solution.variance.push_back(solution.covariance[k * n + k]);
  }
}

}  // namespace

std::complex<double> receptance(const ModesModel& model, double omega) {
  Complex H = 0.0;
  for (const ModeTerm& t : model.terms) {
    H += t.A / Complex(t.omega * t.omega - omega * omega, 2 * t.zeta * t.omega * omega);
  }
  if (model.residual_terms) {
    H += model.above - model.below / (omega * omega);  // M-6
  }
  return H;
}

ModesSolution fit_modes(const FrequencyResponse& lines,
                        const std::vector<ModeTerm>& starts, bool residual_terms) {
  ModesSolution out;
  out.model.terms = starts;
  out.model.residual_terms = residual_terms;
  fit_linear(lines, out.model);
  const Scaling scaling = scaling_of(lines, out.model);
  const auto count = static_cast<int>(2 * lines.omega.size());
  const numerics::Residuals residuals =
      [&](std::span<const double> p, std::span<double> r, std::span<double> jacobian) {
        return evaluate(lines, scaling, p, r, jacobian);
      };
  const auto fit = numerics::levenberg_marquardt(residuals, count, scaled(scaling),
                                                 {.max_iterations = 100});
  out.converged = fit.converged;
  out.model = unscaled(scaling, fit.p);
  std::vector<double> r(static_cast<std::size_t>(count));
  evaluate(lines, scaling, fit.p, r, {});
  for (const double value : r) {
    out.rss += value * value;
  }
  out.rss *= scaling.H * scaling.H;
  add_covariance(lines, scaling, out);
  return out;
}

FittedMode fitted_mode(const ModesSolution& solution, std::size_t r) {
  const ModeTerm& t = solution.model.terms[r];
  FittedMode out{.mode = {.mass = 1 / t.A,
                          .stiffness = t.omega * t.omega / t.A,
                          .damping = 2 * t.zeta * t.omega / t.A},
                 .omega = t.omega,
                 .zeta = t.zeta};
  if (solution.covariance.empty()) {
    return out;
  }
  const std::size_t n = solution.model.size();
  const auto error = [&](double by_omega, double by_zeta, double by_A) {
    const std::array<double, 3> g = {by_omega, by_zeta, by_A};
    double sum = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t b = 0; b < 3; ++b) {
        sum += g[a] * g[b] * solution.covariance[(3 * r + a) * n + 3 * r + b];
      }
    }
    return std::sqrt(std::max(sum, 0.0));
  };
  const double w = t.omega;
  out.omega_se = error(1, 0, 0);
  out.zeta_se = error(0, 1, 0);
  out.mass_se = error(0, 0, 1 / (t.A * t.A));
  out.stiffness_se = error(2 * w / t.A, 0, -w * w / (t.A * t.A));
  out.damping_se = error(2 * t.zeta / t.A, 2 * w / t.A, -2 * t.zeta * w / (t.A * t.A));
  return out;
}

}  // namespace trochoid::structure
