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

/// 1/D: the dynamic stiffness of a unit mass, without the checks of a complex division.
Complex inverse(const ModeTerm& t, double omega) {
  const double re = t.omega * t.omega - omega * omega;
  const double im = 2 * t.zeta * t.omega * omega;
  const double norm = re * re + im * im;
  return {re / norm, -im / norm};
}

/// What the residual terms are multiplied with in M-6.
std::array<double, 2> residual_slopes(double omega) {
  return {1.0, -1.0 / (omega * omega)};
}

/// Derivatives of M-6 at one line, as a receptance, in the order of the parameters.
std::vector<Complex> slopes(const ModesModel& model, double omega) {
  std::vector<Complex> out;
  out.reserve(model.size());
  for (const ModeTerm& t : model.terms) {
    const Complex G = inverse(t, omega);
    out.push_back(-t.A * G * G * Complex(2 * t.omega, 2 * t.zeta * omega));
    out.push_back(-t.A * G * G * Complex(0, 2 * t.omega * omega));
    out.push_back(G);
  }
  const auto residual = residual_slopes(omega);
  out.insert(out.end(), residual.begin(),
             residual.begin() + static_cast<std::ptrdiff_t>(model.residual_size()));
  return out;
}

/// A row of a line as its two weighted parts: real and imaginary.
std::array<double, 2> parts(const LineWeights& weights, std::size_t line,
                            Complex value) {
  const Complex turned = value * weights.turn[line];
  return {turned.real() * weights.along[line], turned.imag() * weights.across[line]};
}

/// What the solver asks for: residuals, and their derivatives by columns.
struct Rows {
  std::span<double> r;
  std::span<double> jacobian;
};

/// Parameters near 0 or 1 for the solver.
struct Scaling {
  ModesModel start;
  double A = 1.0;
  std::array<double, 2> residual{};
  double H = 1.0;  ///< of the weighted residuals
};

Scaling scaling_of(const FrequencyResponse& lines, const LineWeights& weights,
                   const ModesModel& start) {
  Scaling s{.start = start};
  double A = 0.0;
  for (const ModeTerm& term : start.terms) {
    A = std::max(A, std::abs(term.A));
  }
  s.A = A > 0 ? A : 1.0;
  double sum = 0.0;
  double largest = 0.0;
  for (std::size_t i = 0; i < lines.H.size(); ++i) {
    const auto [along, across] = parts(weights, i, lines.H[i]);
    sum += along * along + across * across;
    largest =
        std::max(largest, std::abs(lines.H[i] / factor(lines.kind, lines.omega[i])));
  }
  s.H = sum > 0 ? std::sqrt(sum) : 1.0;
  const double size = largest > 0 ? largest : 1.0;
  s.residual = {size, size * lines.omega.front() * lines.omega.front()};
  return s;
}

ModesModel unscaled(const Scaling& s, std::span<const double> p) {
  ModesModel model = s.start;
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    model.terms[r].omega = s.start.terms[r].omega * p[3 * r];
    model.terms[r].zeta = s.start.terms[r].zeta * std::exp(p[3 * r + 1]);
    model.terms[r].A = s.A * p[3 * r + 2];
  }
  const std::size_t first = 3 * model.terms.size();
  for (std::size_t k = 0; k < model.residual_size(); ++k) {
    model.residual[k] = s.residual[k] * p[first + k];
  }
  return model;
}

std::vector<double> scaled(const Scaling& s) {
  std::vector<double> p;
  for (const ModeTerm& term : s.start.terms) {
    p.insert(p.end(), {1.0, 0.0, term.A / s.A});
  }
  for (std::size_t k = 0; k < s.start.residual_size(); ++k) {
    p.push_back(s.start.residual[k] / s.residual[k]);
  }
  return p;
}

/// d(natural parameter)/d(scaled parameter)
std::vector<double> chain(const Scaling& s, const ModesModel& model) {
  std::vector<double> out;
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    out.insert(out.end(), {s.start.terms[r].omega, model.terms[r].zeta, s.A});
  }
  out.insert(out.end(), s.residual.begin(),
             s.residual.begin() + static_cast<std::ptrdiff_t>(model.residual_size()));
  return out;
}

bool evaluate(const FrequencyResponse& lines, const LineWeights& weights,
              const Scaling& s, std::span<const double> p, Rows rows) {
  const ModesModel model = unscaled(s, p);
  for (const ModeTerm& term : model.terms) {
    if (!(term.omega > 0) || !(term.zeta > 1e-9) || term.zeta > 10) {
      return false;
    }
  }
  const std::vector<double> scale = chain(s, model);
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex f = factor(lines.kind, lines.omega[i]);
    const auto gap =
        parts(weights, i, (f * receptance(model, lines.omega[i]) - lines.H[i]) / s.H);
    rows.r[2 * i] = gap[0];
    rows.r[2 * i + 1] = gap[1];
    if (rows.jacobian.empty()) {
      continue;
    }
    const auto row = slopes(model, lines.omega[i]);
    for (std::size_t k = 0; k < row.size(); ++k) {
      const auto value = parts(weights, i, f * row[k] * (scale[k] / s.H));
      rows.jacobian[k * rows.r.size() + 2 * i] = value[0];
      rows.jacobian[k * rows.r.size() + 2 * i + 1] = value[1];
    }
  }
  return true;
}

/// Leverage of each row of J, whose (J^T J)^-1 is given.
std::vector<double> leverages(std::span<const double> J, std::size_t n,
                              std::span<const double> inverse_gram) {
  std::vector<double> out;
  for (std::size_t i = 0; i < J.size() / n; ++i) {
    double h = 0.0;
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        h += J[i * n + a] * inverse_gram[a * n + b] * J[i * n + b];
      }
    }
    out.push_back(h);
  }
  return out;
}

}  // namespace

std::complex<double> receptance(const ModesModel& model, double omega) {
  Complex H = 0.0;
  for (const ModeTerm& t : model.terms) {
    H += t.A * inverse(t, omega);
  }
  const auto residual = residual_slopes(omega);
  for (std::size_t k = 0; k < model.residual_size(); ++k) {
    H += model.residual[k] * residual[k];  // M-6
  }
  return H;
}

LineWeights even_weights(std::size_t lines) {
  return {.turn = std::vector<Complex>(lines, 1.0),
          .along = std::vector<double>(lines, 1.0),
          .across = std::vector<double>(lines, 1.0)};
}

std::vector<Complex> gaps(const FrequencyResponse& lines, const ModesModel& model) {
  std::vector<Complex> out;
  out.reserve(lines.omega.size());
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    out.push_back(lines.H[i] - factor(lines.kind, lines.omega[i]) *
                                   receptance(model, lines.omega[i]));
  }
  return out;
}

void fit_linear(const FrequencyResponse& lines, const LineWeights& weights,
                ModesModel& model) {
  const std::size_t terms = model.terms.size();
  const std::size_t n = terms + model.residual_size();
  if (n == 0) {
    return;
  }
  std::vector<double> A(2 * lines.omega.size() * n);
  std::vector<double> b(2 * lines.omega.size());
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex f = factor(lines.kind, lines.omega[i]);
    const auto row = slopes(model, lines.omega[i]);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t own = k < terms ? 3 * k + 2 : k + 2 * terms;
      const auto value = parts(weights, i, f * row[own]);
      A[2 * i * n + k] = value[0];
      A[(2 * i + 1) * n + k] = value[1];
    }
    const auto value = parts(weights, i, lines.H[i]);
    b[2 * i] = value[0];
    b[2 * i + 1] = value[1];
  }
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, rank_tolerance);
  for (std::size_t r = 0; r < terms; ++r) {
    model.terms[r].A = fit.x[r];
  }
  for (std::size_t k = 0; k < model.residual_size(); ++k) {
    model.residual[k] = fit.x[terms + k];
  }
}

ModesSolution fit_modes(const FrequencyResponse& lines, const LineWeights& weights,
                        ModesModel start, int iterations) {
  ModesSolution out;
  const Scaling scaling = scaling_of(lines, weights, start);
  const auto count = static_cast<int>(2 * lines.omega.size());
  const numerics::Residuals residuals =
      [&](std::span<const double> p, std::span<double> r, std::span<double> jacobian) {
        return evaluate(lines, weights, scaling, p, {r, jacobian});
      };
  const auto fit = numerics::levenberg_marquardt(residuals, count, scaled(scaling),
                                                 {.max_iterations = iterations});
  out.converged = fit.converged;
  out.model = unscaled(scaling, fit.p);
  const std::vector<Complex> left = gaps(lines, out.model);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const auto [along, across] = parts(weights, i, left[i]);
    out.rss += std::norm(left[i]);
    out.cost += along * along + across * across;
  }
  return out;
}

void describe(const FrequencyResponse& lines, const LineWeights& weights,
              ModesSolution& solution) {
  solution.leverage.clear();
  solution.covariance.clear();
  solution.variance.clear();
  const std::size_t n = solution.model.size();
  const std::size_t m = 2 * lines.omega.size();
  if (m <= n || n == 0) {
    return;
  }
  std::vector<double> J(m * n);
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex f = factor(lines.kind, lines.omega[i]);
    const auto row = slopes(solution.model, lines.omega[i]);
    for (std::size_t k = 0; k < n; ++k) {
      const auto value = parts(weights, i, f * row[k]);
      J[2 * i * n + k] = value[0];
      J[(2 * i + 1) * n + k] = value[1];
    }
  }
  const std::vector<double> zero(m, 0.0);
  const auto fit =
      numerics::least_squares(J, static_cast<int>(n), zero, rank_tolerance);
  if (fit.inverse_gram.empty()) {
    return;
  }
  solution.leverage = leverages(J, n, fit.inverse_gram);
  solution.covariance = fit.inverse_gram;
  for (double& value : solution.covariance) {
    value *= lines.noise_bandwidth;  // M-23
  }
  for (std::size_t k = 0; k < n; ++k) {
    solution.variance.push_back(solution.covariance[k * n + k]);
  }
}

namespace {

using Slopes = std::array<double, 3>;  ///< by omega, zeta and A of a term

/// A term with the exponential window taken out (M-22).
struct WithoutWindow {
  double w = 0.0;      ///< [rad/s]
  double sigma = 0.0;  ///< [1/s]
  double zeta = 0.0;
  Slopes by_w{};
  Slopes by_sigma{};
  Slopes by_zeta{};
};

WithoutWindow without_window(const ModeTerm& t, double a) {
  WithoutWindow out;
  out.sigma = t.zeta * t.omega - a;
  out.w =
      std::sqrt(std::max(t.omega * t.omega - 2 * a * t.zeta * t.omega + a * a, 0.0));
  if (out.w == 0) {
    return out;
  }
  out.zeta = out.sigma / out.w;
  out.by_sigma = {t.zeta, t.omega, 0};
  out.by_w = {(t.omega - a * t.zeta) / out.w, -a * t.omega / out.w, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    out.by_zeta[i] = (out.by_sigma[i] - out.zeta * out.by_w[i]) / out.w;
  }
  return out;
}

/// What the covariance of two terms makes of a quantity of each.
double covariance(const ModesSolution& solution, std::size_t r, const Slopes& g,
                  std::size_t s, const Slopes& h) {
  const std::size_t n = solution.model.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      sum += g[i] * h[j] * solution.covariance[(3 * r + i) * n + 3 * s + j];
    }
  }
  return sum;
}

}  // namespace

FittedMode fitted_mode(const ModesSolution& solution, std::size_t r,
                       double window_decay) {
  const ModeTerm& t = solution.model.terms[r];
  const auto [w, sigma, zeta, by_w, by_sigma, by_zeta] =
      without_window(t, window_decay);
  FittedMode out{
      .mode = {.mass = 1 / t.A, .stiffness = w * w / t.A, .damping = 2 * sigma / t.A},
      .omega = w,
      .zeta = zeta};
  if (solution.covariance.empty() || w == 0) {
    return out;
  }
  const auto error = [&](const Slopes& g) {
    return std::sqrt(std::max(covariance(solution, r, g, r, g), 0.0));
  };
  const double A2 = t.A * t.A;
  out.omega_se = error(by_w);
  out.zeta_se = error(by_zeta);
  out.mass_se = error({0, 0, 1 / A2});
  out.stiffness_se = error({2 * w * by_w[0] / t.A, 2 * w * by_w[1] / t.A, -w * w / A2});
  out.damping_se =
      error({2 * by_sigma[0] / t.A, 2 * by_sigma[1] / t.A, -2 * sigma / A2});
  return out;
}

std::vector<double> mode_covariance(const ModesSolution& solution,
                                    std::span<const std::size_t> terms,
                                    double window_decay) {
  std::vector<double> out;
  if (solution.covariance.empty()) {
    return out;
  }
  const auto slopes = [&](std::size_t k) {
    const ModeTerm& t = solution.model.terms[terms[k / 3]];
    const WithoutWindow free = without_window(t, window_decay);
    const std::array<Slopes, 3> all = {
        free.by_w, free.by_zeta, {0, 0, -1 / (t.A * t.A)}};
    return all[k % 3];
  };
  for (std::size_t i = 0; i < 3 * terms.size(); ++i) {
    for (std::size_t j = 0; j < 3 * terms.size(); ++j) {
      out.push_back(
          covariance(solution, terms[i / 3], slopes(i), terms[j / 3], slopes(j)));
    }
  }
  return out;
}

}  // namespace trochoid::structure
