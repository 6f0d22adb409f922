#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/structure/shapes_problem.h>

#include <algorithm>
#include <cmath>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;
constexpr double rank_tolerance = 1e-12;
constexpr double least_zeta = 1e-9;
constexpr double most_zeta = 0.95;  ///< M-30 has a damped frequency

std::size_t line_count(Responses all) {
  std::size_t n = 0;
  for (const DirectedResponse& one : all) {
    n += one.response.omega.size();
  }
  return n;
}

/// d(phi_j phi_k)/d(phi_m)
Complex slope_of_product(const ShapeTerm& t, const DirectedResponse& one,
                         std::size_t m) {
  return (m == one.motion ? t.phi[one.force] : 0.0) +
         (m == one.force ? t.phi[one.motion] : 0.0);
}

/// Derivatives of M-30 at one line, as a receptance, by the parameters of one term.
void add_slopes(const ShapesModel& model, const ShapeTerm& t,
                const DirectedResponse& one, Complex s, std::vector<Complex>& out) {
  const Complex G = unit_mode(t, s);
  const Complex Q = quadrature(t, s);
  const Complex Z = t.phi[one.motion] * t.phi[one.force];
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
  for (std::size_t m = 0; model.complex_shapes && m < model.directions; ++m) {
    const Complex e = slope_of_product(t, one, m);
    out.push_back(G * (-e.imag() + e.real() * Q));
  }
}

/// A row of a line as its two weighted parts.
std::array<double, 2> parts(const LineWeights& weights, std::size_t line,
                            Complex value) {
  const Complex turned = value * weights.turn[line];
  return {turned.real() * weights.along[line], turned.imag() * weights.across[line]};
}

/// Sizes by which parameters are divided for the solver.
struct Scaling {
  ShapesModel start;
  double phi = 1.0;
  std::vector<std::array<double, 2>> residual;
  double H = 1.0;  ///< of the weighted residuals
};

Scaling scaling_of(Responses all, const AllWeights& weights, const ShapesModel& start) {
  Scaling s{.start = start};
  double phi = 0.0;
  for (const ShapeTerm& term : start.terms) {
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

ShapesModel unscaled(const Scaling& s, std::span<const double> p) {
  ShapesModel model = s.start;
  std::size_t k = 0;
  for (ShapeTerm& term : model.terms) {
    term.omega *= p[k++];
    term.zeta *= std::exp(p[k++]);
    for (Complex& value : term.phi) {
      value = s.phi * p[k++];
    }
    for (std::size_t m = 0; model.complex_shapes && m < model.directions; ++m) {
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
  for (const ShapeTerm& term : s.start.terms) {
    p.insert(p.end(), {1.0, 0.0});
    for (const Complex& value : term.phi) {
      p.push_back(value.real() / s.phi);
    }
    for (std::size_t m = 0; s.start.complex_shapes && m < term.phi.size(); ++m) {
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
std::vector<double> chain(const Scaling& s, const ShapesModel& model) {
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

/// Weighted derivatives of all lines by all parameters: row by row to `put`.
template <class Put>
void each_row(Responses all, const AllWeights& weights, const ShapesModel& model,
              const Put& put) {
  const std::size_t own = model.term_size() * model.terms.size();
  std::size_t row = 0;
  std::vector<Complex> slopes;
  for (std::size_t q = 0; q < all.size(); ++q) {
    const FrequencyResponse& lines = all[q].response;
    for (std::size_t i = 0; i < lines.omega.size(); ++i, row += 2) {
      const Complex s = laplace(all[q], lines.omega[i]);
      const Complex f = factor(lines.kind, lines.omega[i]);
      slopes.clear();
      for (const ShapeTerm& term : model.terms) {
        add_slopes(model, term, all[q], s, slopes);
      }
      for (std::size_t k = 0; k < own; ++k) {
        put(row, k, parts(weights[q], i, f * slopes[k]));
      }
      if (model.residual_terms) {
        put(row, own + 2 * q, parts(weights[q], i, f));
        put(row, own + 2 * q + 1, parts(weights[q], i, f / (s * s)));
      }
    }
  }
}

bool sound(const ShapesModel& model) {
  return std::all_of(model.terms.begin(), model.terms.end(), [](const ShapeTerm& t) {
    return t.omega > 0 && t.zeta > least_zeta && t.zeta < most_zeta;
  });
}

/// What the solver asks for: residuals, and their derivatives by columns.
struct Rows {
  std::span<double> r;
  std::span<double> jacobian;
};

bool evaluate(Responses all, const AllWeights& weights, const Scaling& s,
              std::span<const double> p, Rows rows) {
  const ShapesModel model = unscaled(s, p);
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
    const std::vector<double> scale = chain(s, model);
    const std::size_t m = rows.r.size();
    each_row(all, weights, model,
             [&](std::size_t row, std::size_t k, const std::array<double, 2>& value) {
               rows.jacobian[k * m + row] = value[0] * scale[k] / s.H;
               rows.jacobian[k * m + row + 1] = value[1] * scale[k] / s.H;
             });
  }
  return true;
}

}  // namespace

AllWeights even_weights(Responses all) {
  AllWeights out;
  for (const DirectedResponse& one : all) {
    out.push_back(even_weights(one.response.omega.size()));
    double largest = 0.0;
    for (const Complex& H : one.response.H) {
      largest = std::max(largest, std::abs(H));
    }
    const double weight = largest > 0 ? 1 / largest : 1.0;
    std::fill(out.back().along.begin(), out.back().along.end(), weight);
    std::fill(out.back().across.begin(), out.back().across.end(), weight);
  }
  return out;
}

ShapesSolution fit_shapes(Responses all, const AllWeights& weights,
                          const ShapesModel& start, int iterations) {
  const Scaling scaling = scaling_of(all, weights, start);
  const numerics::Residuals residuals =
      [&](std::span<const double> p, std::span<double> r, std::span<double> jacobian) {
        return evaluate(all, weights, scaling, p, {r, jacobian});
      };
  const auto fit =
      numerics::levenberg_marquardt(residuals, static_cast<int>(2 * line_count(all)),
                                    scaled(scaling), {.max_iterations = iterations});
  ShapesSolution out;
  out.converged = fit.converged;
  out.model = unscaled(scaling, fit.p);
  out.cost = 2 * fit.final_cost * scaling.H * scaling.H;
  return out;
}

void describe(Responses all, const AllWeights& weights, ShapesSolution& solution) {
  solution.leverage.clear();
  solution.covariance.clear();
  const std::size_t n = solution.model.size();
  const std::size_t m = 2 * line_count(all);
  if (m <= n || n == 0) {
    return;
  }
  std::vector<double> J(m * n, 0.0);
  each_row(all, weights, solution.model,
           [&](std::size_t row, std::size_t k, const std::array<double, 2>& value) {
             J[row * n + k] = value[0];
             J[(row + 1) * n + k] = value[1];
           });
  const std::vector<double> zero(m, 0.0);
  const auto fit =
      numerics::least_squares(J, static_cast<int>(n), zero, rank_tolerance);
  if (fit.inverse_gram.empty()) {
    return;
  }
  solution.covariance = fit.inverse_gram;
  std::size_t row = 0;
  for (const DirectedResponse& one : all) {
    solution.leverage.emplace_back();
    for (std::size_t i = 0; i < 2 * one.response.omega.size(); ++i, ++row) {
      double h = 0.0;
      for (std::size_t a = 0; a < n; ++a) {
        double sum = 0.0;
        for (std::size_t b = 0; b < n; ++b) {
          sum += solution.covariance[a * n + b] * J[row * n + b];
        }
        h += sum * J[row * n + a];
      }
      solution.leverage.back().push_back(h);
    }
  }
}

}  // namespace trochoid::structure
