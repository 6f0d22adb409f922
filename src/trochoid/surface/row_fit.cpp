#include <trochoid/surface/row_fit.h>

#include <trochoid/numerics/dense.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace trochoid::surface {

namespace {

using numerics::Matrix;
using Values = std::vector<double>;

/// Products of all columns and what is measured, with the priors of the form in them.
struct Normal {
  Matrix A;           ///< of the unknowns, then the form
  Values g;           ///< of these with what is left
  double rest = 0.0;  ///< of what is left with itself
};

/// @param J  of the unknowns; empty: the form alone
Values rows_of(const RowProblem& problem, const Values& f, const Values& J) {
  const std::size_t unknowns = J.size() / problem.error.size();
  const std::size_t k = problem.form.count;
  Values rows;
  rows.reserve(problem.error.size() * (unknowns + k + 1));
  for (std::size_t i = 0; i < problem.error.size(); ++i) {
    const double* slopes = J.data() + i * unknowns;
    rows.insert(rows.end(), slopes, slopes + unknowns);
    const double* B = problem.form.values.data() + i * k;
    rows.insert(rows.end(), B, B + k);
    rows.push_back(problem.error[i] - f[i]);
  }
  return rows;
}

Normal normal_of(const RowProblem& problem, const Scatter& scatter, const Values& rows,
                 std::size_t unknowns) {
  const std::size_t n = unknowns + problem.form.count;
  const Values G = weighted_products({rows, n + 1, problem.count}, scatter);
  Normal normal{numerics::zeros(n, n), Values(n), 0.0};
  const double s2 = scatter.s2;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      normal.A(a, b) = G[a * (n + 1) + b] / s2;
    }
    normal.g[a] = G[a * (n + 1) + n] / s2;
  }
  normal.rest = G.back() / s2;
  for (std::size_t k = 0; k < problem.form.count; ++k) {
    normal.A(unknowns + k, unknowns + k) += problem.prior[k];
  }
  return normal;
}

/// The unknowns from `first` on alone, the others where they are: x, and the cost left.
std::pair<Values, double> solved_from(const Normal& normal, std::size_t first) {
  const std::size_t n = normal.g.size() - first;
  if (n == 0) {
    return {{}, normal.rest};
  }
  // Columns of very different size: scaled to one.
  Matrix A = numerics::zeros(n, n);
  Values scale(n);
  Values g(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double square = normal.A(first + i, first + i);
    scale[i] = square > 0 ? 1 / std::sqrt(square) : 1.0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      A(i, k) = scale[i] * scale[k] * normal.A(first + i, first + k);
    }
    g[i] = scale[i] * normal.g[first + i];
  }
  Values x(n);
  numerics::solve(numerics::lu(A), g, x);
  double cost = normal.rest;
  for (std::size_t i = 0; i < n; ++i) {
    x[i] *= scale[i];
    cost -= x[i] * normal.g[first + i];
  }
  return {x, cost};
}

/// The form that is best beside f, and the cost.
std::pair<Values, double> form_alone(const RowProblem& problem, const Values& f) {
  const Values rows = rows_of(problem, f, {});
  return solved_from(normal_of(problem, problem.scatter, rows, 0), 0);
}

/// (A)^-1 and the logarithm of its determinant.
std::pair<Values, double> inverse_of(const Matrix& A) {
  const std::size_t n = A.rows;
  Matrix scaled = A;
  Values scale(n);
  double log_det = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    scale[i] = 1 / std::sqrt(std::max(A(i, i), std::numeric_limits<double>::min()));
    log_det += 2 * std::log(scale[i]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      scaled(i, k) *= scale[i] * scale[k];
    }
  }
  const numerics::Lu factors = numerics::lu(scaled);
  Values inverse(n * n);
  Values unit(n);
  Values x(n);
  for (std::size_t k = 0; k < n; ++k) {
    std::fill(unit.begin(), unit.end(), 0.0);
    unit[k] = 1.0;
    numerics::solve(factors, unit, x);
    for (std::size_t i = 0; i < n; ++i) {
      inverse[i * n + k] = scale[i] * scale[k] * x[i];
    }
    log_det -= std::log(std::abs(factors.factors(k, k)));
  }
  return {inverse, log_det};
}

void describe(const RowProblem& problem, Values rows, const Normal& normal,
              RowFit& fit) {
  const std::size_t unknowns = fit.p.size();
  const std::size_t width = unknowns + problem.form.count + 1;
  const auto [inverse, log_det] = inverse_of(normal.A);
  fit.covariance = inverse;
  Scatter own{.s2 = problem.scatter.s2};
  const auto variances = inverse_of(normal_of(problem, own, rows, unknowns).A).first;
  for (std::size_t k = 0; k < width - 1; ++k) {
    fit.own.push_back(variances[k * width]);
  }
  for (std::size_t i = 0; i < problem.error.size(); ++i) {
    double& left = rows[i * width + width - 1];
    for (std::size_t k = 0; k < fit.form.size(); ++k) {
      left -= rows[i * width + unknowns + k] * fit.form[k];
    }
    fit.residual.push_back(left);
  }
  fit.columns = std::move(rows);
  const double freedom =
      std::max(1.0, problem.independent - static_cast<double>(unknowns));
  fit.evidence = -0.5 * freedom * std::log(std::max(fit.cost, 1e-300)) + 0.5 * log_det;
  for (const double prior : problem.prior) {
    fit.evidence += prior > 0 ? 0.5 * std::log(prior) : 0.0;
  }
  fit.ok = std::all_of(inverse.begin(), inverse.end(),
                       [](double x) { return std::isfinite(x); });
}

/// L of C = L L^T, row-major; C the leading part of a covariance.
/// @param width  of the covariance
Values errors_of(const Values& covariance, std::size_t width, std::size_t n) {
  Values L(n * n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k <= i; ++k) {
      double sum = covariance[i * width + k];
      for (std::size_t j = 0; j < k; ++j) {
        sum -= L[i * n + j] * L[k * n + j];
      }
      L[i * n + k] = i == k
                         ? std::sqrt(std::max(sum, 1e-12 * covariance[i * (width + 1)]))
                         : sum / L[k * n + k];
    }
  }
  return L;
}

/// E-27, row-major, shape (rows, unknowns); empty where the model has no answer.
Values slopes_along(const Values& L, const RowValues& values, const Values& p) {
  const std::size_t n = p.size();
  Values J;
  for (std::size_t k = 0; k < n; ++k) {
    Values above = p;
    Values below = p;
    for (std::size_t i = k; i < n; ++i) {
      above[i] += L[i * n + k];
      below[i] -= L[i * n + k];
    }
    const Values up = values(above);
    const Values down = values(below);
    if (up.empty() || down.empty()) {
      return {};
    }
    J.resize(up.size() * n);
    for (std::size_t row = 0; row < up.size(); ++row) {
      J[row * n + k] = 0.5 * (up[row] - down[row]);
    }
  }
  // From the directions to the unknowns: L is triangular.
  for (std::size_t row = 0; row * n < J.size(); ++row) {
    double* slope = J.data() + row * n;
    for (std::size_t k = n; k-- > 0;) {
      for (std::size_t i = k + 1; i < n; ++i) {
        slope[k] -= slope[i] * L[i * n + k];
      }
      slope[k] /= L[k * n + k];
    }
  }
  return J;
}

}  // namespace

RowFit fit_along_errors(const RowProblem& problem, const RowValues& values,
                        RowFit fit) {
  constexpr int most_steps = 4;
  constexpr int most_halvings = 4;
  constexpr double negligible = 1e-2;  // of the cost: a step of 0.1 se
  const std::size_t n = fit.p.size();
  Values f = values(fit.p);
  for (int step = 0; step < most_steps && !f.empty(); ++step) {
    const Values J = slopes_along(errors_of(fit.covariance, n + problem.form.count, n),
                                  values, fit.p);
    if (J.empty()) {
      return fit;
    }
    RowFit here{.p = fit.p};
    std::tie(here.form, here.cost) = form_alone(problem, f);
    Values rows = rows_of(problem, f, J);
    const Normal normal = normal_of(problem, problem.scatter, rows, n);
    const auto [x, go] = solved_from(normal, 0);
    describe(problem, std::move(rows), normal, here);
    if (!here.ok) {
      return fit;
    }
    fit = std::move(here);
    if (fit.cost - go <= negligible) {
      return fit;
    }
    double better = fit.cost;
    double share = 1.0;
    Values p(n);
    for (int k = 0; k < most_halvings && better >= fit.cost; ++k, share *= 0.5) {
      for (std::size_t i = 0; i < n; ++i) {
        p[i] = fit.p[i] + share * x[i];
      }
      f = values(p);
      better = f.empty() ? fit.cost : form_alone(problem, f).second;
    }
    if (better >= fit.cost) {
      return fit;
    }
    fit.p = p;
  }
  return fit;
}

RowFit fit_rows(const RowProblem& problem, const RowModel& model, Values start) {
  constexpr int most_steps = 40;
  constexpr double negligible = 1e-2;  // of the cost: a step of 0.1 se
  constexpr int most_halvings = 5;
  // Slopes over half a standard error: the kinks of the model are finer than that.
  constexpr double step_in_se = 0.5;
  RowFit fit;
  Values p = std::move(start);
  Values differences;
  Values rows;
  Normal normal;
  fit.cost = std::numeric_limits<double>::infinity();
  int halvings = 0;
  for (int k = 0; k < most_steps; ++k) {
    const Linearised at = model(p, differences);
    if (!at.good && fit.p.empty()) {
      return fit;
    }
    const auto [form, stay] = form_alone(problem, at.f);
    if (at.good && stay < fit.cost) {
      const bool settled = fit.cost - stay <= negligible;
      fit.p = p;
      fit.form = form;
      fit.cost = stay;
      rows = rows_of(problem, at.f, at.slopes());
      normal = normal_of(problem, problem.scatter, rows, p.size());
      if (settled) {  // whatever the slopes promise: they are none of the kinks
        break;
      }
      halvings = std::max(0, halvings - 1);
    } else if (++halvings > most_halvings) {
      break;
    }
    const bool first = differences.empty();
    const Values variances = inverse_of(normal.A).first;
    differences.resize(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) {
      differences[i] = step_in_se * std::sqrt(variances[i * (normal.A.rows + 1)]);
    }
    const auto [x, go] = solved_from(normal, 0);
    const double share = std::ldexp(1.0, -halvings);
    if (!first && share * (2 - share) * (fit.cost - go) <= negligible) {
      break;
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
      p[i] = fit.p[i] + share * x[i];
    }
  }
  describe(problem, std::move(rows), normal, fit);
  return fit;
}

}  // namespace trochoid::surface
