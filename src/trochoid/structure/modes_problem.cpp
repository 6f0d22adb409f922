#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/structure/modes_problem.h>

#include <algorithm>
#include <array>
#include <cmath>

// The two forms of M-6 and M-30 take the products of one row in orders of their own, here
// and in modes_model.cpp. It matters in the last digit of an answer only.

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;
using Parts = std::array<double, 2>;

constexpr double rank_tolerance = 1e-12;
constexpr double least_zeta = 1e-9;
constexpr double most_zeta = 10.0;
constexpr double most_zeta_of_shapes = 0.95;  ///< M-30 has a damped frequency

std::size_t line_count(Responses all) {
  std::size_t n = 0;
  for (const DirectedResponse& one : all) {
    n += one.response.omega.size();
  }
  return n;
}

/// d(phi_j phi_k)/d(phi_m)
Complex slope_of_product(const ModeTerm& t, const DirectedResponse& one,
                         std::size_t m) {
  return (m == one.motion ? t.phi[one.force] : 0.0) +
         (m == one.force ? t.phi[one.motion] : 0.0);
}

/// Derivatives of M-6 at one line, as a receptance, by the parameters of one term.
void add_slopes_of_residue(const ModeTerm& t, Complex s, std::vector<Complex>& out) {
  const Complex G = unit_mode(t, s);
  const double A = t.phi.front().real();
  const double omega = s.imag();
  out.push_back(-A * G * G * Complex(2 * t.omega, 2 * t.zeta * omega));
  out.push_back(-A * G * G * Complex(0, 2 * t.omega * omega));
  out.push_back(G);
}

/// Derivatives of M-30 at one line, as a receptance, by the parameters of one term.
void add_slopes_of_shape(const ModesModel& model, const ModeTerm& t,
                         const DirectedResponse& one, Complex s,
                         std::vector<Complex>& out) {
  const Complex G = unit_mode(t, s);
  const Complex Q = quadrature(t, s);
  const Complex Z = product(model, t, one);
  const Complex N = Z.real() + Z.imag() * Q;
  const double q = std::sqrt(1 - t.zeta * t.zeta);
  const Complex Q_omega = -s / (t.omega * t.omega * q);
  const Complex Q_zeta = (1.0 + t.zeta * s / t.omega) / (q * q * q);
  out.push_back(G * (Z.imag() * Q_omega - N * G * 2.0 * (t.omega + t.zeta * s)));
  out.push_back(G * (Z.imag() * Q_zeta - N * G * 2.0 * t.omega * s));
  for (std::size_t m = 0; m < model.directions; ++m) {
    const Complex e = slope_of_product(t, one, m);
    out.push_back(G * (e.real() + e.imag() * Q));
  }
  for (std::size_t m = 0; model.complex_shapes() && m < model.directions; ++m) {
    const Complex e = slope_of_product(t, one, m);
    out.push_back(G * (-e.imag() + e.real() * Q));
  }
}

/// A row of a line as its two weighted parts: real and imaginary.
Parts parts(const LineWeights& weights, std::size_t line, Complex value) {
  const Complex turned = value * weights.turn[line];
  return {turned.real() * weights.along[line], turned.imag() * weights.across[line]};
}

/// Sizes by which parameters are divided, so that all are near 0 or 1 for the solver.
struct Scaling {
  ModesModel start;
  double phi = 1.0;
  std::vector<std::array<double, 2>> residual;
  double H = 1.0;  ///< of the weighted residuals
};

Scaling scaling_of(Responses all, const AllWeights& weights, const ModesModel& start) {
  Scaling s{.start = start};
  double phi = 0.0;
  for (const ModeTerm& term : start.terms) {
    for (const Complex& value : term.phi) {
      phi = std::max(phi, std::abs(value));
    }
  }
  s.phi = phi > 0 ? phi : 1.0;
  double sum = 0.0;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const FrequencyResponse& lines = all[q].response;
    double largest = 0.0;
    for (std::size_t i = 0; i < lines.H.size(); ++i) {
      const auto [along, across] = parts(weights[q], i, lines.H[i]);
      sum += along * along + across * across;
      largest =
          std::max(largest, std::abs(lines.H[i] / factor(lines.kind, lines.omega[i])));
    }
    const double size = largest > 0 ? largest : 1.0;
    s.residual.push_back({size, size * lines.omega.front() * lines.omega.front()});
  }
  s.H = sum > 0 ? std::sqrt(sum) : 1.0;
  return s;
}

ModesModel unscaled(const Scaling& s, std::span<const double> p) {
  ModesModel model = s.start;
  std::size_t k = 0;
  for (ModeTerm& term : model.terms) {
    term.omega *= p[k++];
    term.zeta *= std::exp(p[k++]);
    for (Complex& value : term.phi) {
      value = s.phi * p[k++];
    }
    for (std::size_t m = 0; model.complex_shapes() && m < model.directions; ++m) {
      term.phi[m] += Complex(0.0, s.phi * p[k++]);
    }
  }
  for (std::size_t q = 0; model.residual_terms && q < model.residual.size(); ++q) {
    model.residual[q] = {s.residual[q][0] * p[k], s.residual[q][1] * p[k + 1]};
    k += 2;
  }
  return model;
}

std::vector<double> scaled(const Scaling& s) {
  std::vector<double> p;
  for (const ModeTerm& term : s.start.terms) {
    p.insert(p.end(), {1.0, 0.0});
    for (const Complex& value : term.phi) {
      p.push_back(value.real() / s.phi);
    }
    for (std::size_t m = 0; s.start.complex_shapes() && m < term.phi.size(); ++m) {
      p.push_back(term.phi[m].imag() / s.phi);
    }
  }
  for (std::size_t q = 0; s.start.residual_terms && q < s.residual.size(); ++q) {
    for (std::size_t k = 0; k < 2; ++k) {
      p.push_back(s.start.residual[q][k] / s.residual[q][k]);
    }
  }
  return p;
}

/// d(natural parameter)/d(scaled parameter)
std::vector<double> chain(const Scaling& s, const ModesModel& model) {
  std::vector<double> out;
  for (std::size_t r = 0; r < model.terms.size(); ++r) {
    out.insert(out.end(), {s.start.terms[r].omega, model.terms[r].zeta});
    out.insert(out.end(), model.term_size() - 2, s.phi);
  }
  for (std::size_t q = 0; model.residual_terms && q < s.residual.size(); ++q) {
    out.insert(out.end(), s.residual[q].begin(), s.residual[q].end());
  }
  return out;
}

/// What derivatives are multiplied with, one of each parameter, and all divided by.
struct Scale {
  std::vector<double> by;
  double H = 1.0;
};

/// Weighted derivatives of all lines by all parameters: row by row to `put`.
template <class Put>
void each_row(Responses all, const AllWeights& weights, const ModesModel& model,
              const Scale& scale, const Put& put) {
  const std::size_t own = model.term_size() * model.terms.size();
  std::size_t row = 0;
  std::vector<Complex> slopes;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const FrequencyResponse& lines = all[q].response;
    for (std::size_t i = 0; i < lines.omega.size(); ++i, row += 2) {
      const Complex s = laplace(all[q], lines.omega[i]);
      const Complex f = factor(lines.kind, lines.omega[i]);
      slopes.clear();
      for (const ModeTerm& term : model.terms) {
        if (model.is_residue()) {
          add_slopes_of_residue(term, s, slopes);
        } else {
          add_slopes_of_shape(model, term, all[q], s, slopes);
        }
      }
      const auto weighted = [&](std::size_t k, Complex value) -> Parts {
        if (model.is_residue()) {
          return parts(weights[q], i, value * (scale.by[k] / scale.H));
        }
        const auto [re, im] = parts(weights[q], i, value);
        return {re * scale.by[k] / scale.H, im * scale.by[k] / scale.H};
      };
      for (std::size_t k = 0; k < own; ++k) {
        put(row, k, weighted(k, f * slopes[k]));
      }
      if (model.residual_terms) {
        const std::size_t k = own + 2 * q;
        put(row, k, weighted(k, f));
        put(row, k + 1, weighted(k + 1, below(model, f, s)));
      }
    }
  }
}

bool sound(const ModesModel& model) {
  const double most = model.is_residue() ? most_zeta : most_zeta_of_shapes;
  return std::all_of(model.terms.begin(), model.terms.end(), [&](const ModeTerm& t) {
    return t.omega > 0 && t.zeta > least_zeta && t.zeta < most;
  });
}

/// What the solver asks for: residuals, and their derivatives by columns.
struct SolverRows {
  std::span<double> r;
  std::span<double> jacobian;
};

bool evaluate(Responses all, const AllWeights& weights, const Scaling& s,
              std::span<const double> p, SolverRows rows) {
  const ModesModel model = unscaled(s, p);
  if (!sound(model)) {
    return false;
  }
  std::size_t at = 0;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const std::vector<Complex> left = gaps(model, all[q], q);
    for (std::size_t i = 0; i < left.size(); ++i) {
      const auto both = parts(weights[q], i, -left[i] / s.H);
      rows.r[at++] = both[0];
      rows.r[at++] = both[1];
    }
  }
  if (!rows.jacobian.empty()) {
    std::fill(rows.jacobian.begin(), rows.jacobian.end(), 0.0);
    const std::size_t m = rows.r.size();
    each_row(all, weights, model, {chain(s, model), s.H},
             [&](std::size_t row, std::size_t k, const Parts& value) {
               rows.jacobian[k * m + row] = value[0];
               rows.jacobian[k * m + row + 1] = value[1];
             });
  }
  return true;
}

/// Leverage of one row of J, whose (J^T J)^-1 is given.
double leverage(ModeForm form, std::span<const double> row,
                std::span<const double> inverse_gram) {
  double h = 0.0;
  for (std::size_t a = 0; a < row.size(); ++a) {
    double sum = 0.0;
    for (std::size_t b = 0; b < row.size(); ++b) {
      const double G = inverse_gram[a * row.size() + b];
      if (form == ModeForm::residue) {
        h += row[a] * G * row[b];
      } else {
        sum += G * row[b];
      }
    }
    h += sum * row[a];
  }
  return h;
}

/// Sum of the squared weighted residuals of the only response.
double cost_of(const ModesModel& model, const DirectedResponse& one,
               const LineWeights& weights) {
  double sum = 0.0;
  const std::vector<Complex> left = gaps(model, one, 0);
  for (std::size_t i = 0; i < left.size(); ++i) {
    const auto [along, across] = parts(weights, i, left[i]);
    sum += along * along + across * across;
  }
  return sum;
}

}  // namespace

AllWeights even_weights(Responses all, ModeForm form) {
  AllWeights out;
  for (const DirectedResponse& one : all) {
    double largest = 0.0;
    for (const Complex& H : one.response.H) {
      largest = std::max(largest, std::abs(H));
    }
    const bool by_size = form != ModeForm::residue && largest > 0;
    const std::size_t n = one.response.omega.size();
    std::vector<double> weight;
    for (std::size_t i = 0; i < n; ++i) {
      weight.push_back((by_size ? 1 / largest : 1.0) * one.response.calmer(i));
    }
    out.push_back(
        {.turn = std::vector<Complex>(n, 1.0), .along = weight, .across = weight});
  }
  return out;
}

Residues fit_residues(const DirectedResponse& one, const LineWeights& weights,
                      const ModesModel& model) {
  const std::size_t each = model.complex_shapes() ? 2 : 1;
  const std::size_t terms = model.terms.size();
  const std::size_t n = each * terms + (model.residual_terms ? 2 : 0);
  const FrequencyResponse& lines = one.response;
  std::vector<double> A(2 * lines.omega.size() * n);
  std::vector<double> b(2 * lines.omega.size());
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const Complex s = laplace(one, lines.omega[i]);
    const Complex f = factor(lines.kind, lines.omega[i]);
    const auto put = [&](std::size_t k, Complex value) {
      const auto both = parts(weights, i, value);
      A[2 * i * n + k] = both[0];
      A[(2 * i + 1) * n + k] = both[1];
    };
    for (std::size_t r = 0; r < terms; ++r) {
      const Complex G = f * unit_mode(model.terms[r], s);
      put(each * r, G);
      if (model.complex_shapes()) {
        put(each * r + 1, G * quadrature(model.terms[r], s));
      }
    }
    if (model.residual_terms) {
      put(n - 2, f);
      put(n - 1, below(model, f, s));
    }
    const auto both = parts(weights, i, lines.H[i]);
    b[2 * i] = both[0];
    b[2 * i + 1] = both[1];
  }
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, rank_tolerance);
  Residues out;
  for (std::size_t r = 0; r < terms; ++r) {
    out.Z.emplace_back(fit.x[each * r], each == 2 ? fit.x[each * r + 1] : 0.0);
  }
  if (model.residual_terms) {
    out.residual = {fit.x[n - 2], fit.x[n - 1]};
  }
  return out;
}

ModesSolution fit_modes(Responses all, const AllWeights& weights,
                        const ModesModel& start, int iterations) {
  const Scaling scaling = scaling_of(all, weights, start);
  const numerics::Residuals residuals =
      [&](std::span<const double> p, std::span<double> r, std::span<double> jacobian) {
        return evaluate(all, weights, scaling, p, {r, jacobian});
      };
  const auto fit =
      numerics::levenberg_marquardt(residuals, static_cast<int>(2 * line_count(all)),
                                    scaled(scaling), {.max_iterations = iterations});
  ModesSolution out;
  out.converged = fit.converged;
  out.model = unscaled(scaling, fit.p);
  out.cost = start.is_residue() ? cost_of(out.model, all.front(), weights.front())
                                : 2 * fit.final_cost * scaling.H * scaling.H;
  return out;
}

void describe(Responses all, const AllWeights& weights, ModesSolution& solution) {
  solution.leverage.clear();
  solution.covariance.clear();
  const ModesModel& model = solution.model;
  const std::size_t n = model.size();
  const std::size_t m = 2 * line_count(all);
  if (m <= n || n == 0) {
    return;
  }
  std::vector<double> J(m * n, 0.0);
  each_row(all, weights, model, {std::vector<double>(n, 1.0)},
           [&](std::size_t row, std::size_t k, const Parts& value) {
             J[row * n + k] = value[0];
             J[(row + 1) * n + k] = value[1];
           });
  const std::vector<double> zero(m, 0.0);
  const auto fit =
      numerics::least_squares(J, static_cast<int>(n), zero, rank_tolerance);
  if (fit.inverse_gram.empty()) {
    return;
  }
  const std::span<const double> rows = J;
  std::size_t row = 0;
  for (const DirectedResponse& one : all) {
    solution.leverage.emplace_back();
    for (std::size_t i = 0; i < 2 * one.response.omega.size(); ++i, ++row) {
      solution.leverage.back().push_back(
          leverage(model.form, rows.subspan(row * n, n), fit.inverse_gram));
    }
  }
  solution.covariance = fit.inverse_gram;
  if (model.is_residue()) {  // of shapes the weights know it
    for (double& value : solution.covariance) {
      value *= all.front().response.noise_bandwidth;  // M-23
    }
  }
}

double left_over(const ModesModel& model, const DirectedResponse& one,
                 std::size_t which) {
  double sum = 0.0;
  for (const Complex& left : gaps(model, one, which)) {
    sum += std::norm(left);
  }
  return sum;
}

double power(const FrequencyResponse& lines) {
  double sum = 0.0;
  for (const Complex& H : lines.H) {
    sum += std::norm(H);
  }
  return sum;
}

double covariance(const ModesSolution& solution, std::size_t r,
                  std::span<const double> g, std::size_t s, std::span<const double> h) {
  const std::size_t n = solution.model.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) {
    for (std::size_t j = 0; j < h.size(); ++j) {
      sum +=
          g[i] * h[j] * solution.covariance[(r * g.size() + i) * n + s * h.size() + j];
    }
  }
  return sum;
}

}  // namespace trochoid::structure
