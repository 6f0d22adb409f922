#include <trochoid/identification/plan.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/fit_at.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/dense.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trochoid::identification {
namespace {

using base::index;

/// Information below this part of what there would be if all others were known is none:
/// the square of what I-6 counts as dependent.
constexpr double undetermined = 1e-12;

/// The columns that are asked about, in their order, and those that are not.
struct Sorted {
  std::vector<double> wanted;  ///< by columns, shape (count, rows)
  std::vector<double> others;
};

/// The columns of J; those of the runout per metre.
/// @param group  whose coefficients are asked about
Sorted sorted(const Problem& problem, std::span<const double> J, std::size_t group,
              bool slopes) {
  const std::size_t rows = index(problem.rows());
  const std::size_t linear = index(problem.linear());
  const std::size_t columns = index(problem.columns);
  const Unknowns& u = problem.unknowns;
  Sorted out;
  for (std::size_t c = 0; c < J.size() / rows; ++c) {
    const std::span<const double> from = J.subspan(c * rows, rows);
    const bool own = c / columns == group && c < index(problem.force_columns());
    const bool shared = c >= linear && c < linear + index(u.first_resonance());
    const bool runout = shared && c < linear + index(u.runout_count());
    const bool drift = c >= index(problem.force_columns()) && c < linear;
    if (drift && !slopes && (c - index(problem.force_columns())) % 2 == 1) continue;
    std::vector<double>& to = own || shared ? out.wanted : out.others;
    for (const double v : from) to.push_back(runout ? v / u.length : v);
  }
  return out;
}

/// J^T J/s^2 of the columns that are asked about, the others taken out.
Information information(const Problem& problem, std::span<const double> J,
                        std::size_t group, bool slopes, double variance) {
  const std::size_t rows = index(problem.rows());
  Sorted all = sorted(problem, J, group, slopes);
  if (!all.others.empty()) {
    const numerics::Columns others(all.others, rows);
    numerics::project_out(others, numerics::gram_of(others), all.wanted);  // I-20
  }
  Information out{all.wanted.size() / rows, numerics::gram_of({all.wanted, rows})};
  for (double& m : out.matrix) m /= variance;
  return out;
}

/// @brief What is known where everything that is asked about is: the inverse of its
/// covariance, the runout in metres; nothing where a quantity is not determined.
std::optional<Information> inverse_of(const Problem& problem, const Uncertainty& known,
                                      std::size_t group) {
  const std::size_t width = known.reason.size();
  const std::size_t linear = index(problem.linear());
  const std::size_t columns = index(problem.columns);
  const Unknowns& u = problem.unknowns;
  std::vector<std::size_t> asked;   // places among the unknowns
  std::vector<std::size_t> places;  // and among the parameters
  const std::size_t count = columns + index(u.first_resonance());
  for (std::size_t c = 0; c < count; ++c) {
    const std::size_t own = c < columns ? group * columns + c : linear + c - columns;
    if (known.unmeasured[own]) continue;  // zero in rows and columns: nothing is known
    asked.push_back(own);
    places.push_back(c);
  }
  const std::size_t n = asked.size();
  std::vector<double> C(n * n);
  std::vector<double> size(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double variance = known.covariance[asked[i] * width + asked[i]];
    if (!known.reason[asked[i]].empty() || !(variance > 0.0)) return std::nullopt;
    size[i] = std::sqrt(variance);
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      C[i * n + j] =
          known.covariance[asked[i] * width + asked[j]] / (size[i] * size[j]);
    }
  }
  Information out{count, std::vector<double>(count * count)};
  std::vector<double> x(n);
  for (std::size_t j = 0; j < n; ++j) {
    std::vector<double> unit_vector(n, 0.0);
    unit_vector[j] = 1.0;
    numerics::solve_normal(C, unit_vector, x);
    const auto metres = [&](std::size_t k) {
      const bool runout =
          places[k] >= columns && places[k] < columns + index(u.runout_count());
      return runout ? u.length * size[k] : size[k];
    };
    for (std::size_t i = 0; i < n; ++i) {
      out.matrix[places[i] * count + places[j]] = x[i] / (metres(i) * metres(j));
    }
  }
  return out;
}

/// One turn of a trial, without its forces.
Run turn_of(const Trial& trial) {
  Run out{trial.setup.cut, {}, {}, {}, trial.measured};
  const int n = trial.samples_per_turn;
  for (int i = 0; i < n; ++i) out.angle.push_back(unit::turn * (i + 0.5) / n);
  out.force.resize(index(n));
  return out;
}

/// Some of a matrix; rows and columns in the order asked for.
std::vector<double> part(const Information& of, std::span<const std::size_t> rows,
                         std::span<const std::size_t> columns) {
  std::vector<double> out;
  for (const std::size_t i : rows) {
    for (const std::size_t j : columns) out.push_back(of.matrix[i * of.size + j]);
  }
  return out;
}

/// What is known of some parameters, whatever the others are (I-21).
std::vector<double> of_some(const Information& known,
                            std::span<const std::size_t> some) {
  std::vector<std::size_t> rest;
  for (std::size_t i = 0; i < known.size; ++i) {
    if (std::ranges::find(some, i) == some.end()) rest.push_back(i);
  }
  std::vector<double> out = part(known, some, some);
  if (rest.empty()) return out;
  const std::vector<double> others = part(known, rest, rest);
  std::vector<double> x(rest.size());
  for (std::size_t j = 0; j < some.size(); ++j) {
    const std::vector<double> g = part(known, rest, some.subspan(j, 1));
    numerics::solve_normal(others, g, x);
    for (std::size_t i = 0; i < some.size(); ++i) {
      for (std::size_t k = 0; k < rest.size(); ++k) {
        out[i * some.size() + j] -= known.matrix[some[i] * known.size + rest[k]] * x[k];
      }
    }
  }
  return out;
}

/// The matrix with ones on its diagonal, and the roots that were taken out; nothing where
/// a parameter, or a combination, is not determined.
struct Scaled {
  numerics::Matrix matrix;
  numerics::Lu lu;
  std::vector<double> size;
};

std::optional<Scaled> scaled(const Information& known,
                             std::span<const std::size_t> some) {
  const std::vector<double> own = of_some(known, some);
  const std::size_t n = some.size();
  Scaled out{numerics::zeros(n, n), {}, {}};
  for (std::size_t i = 0; i < n; ++i) {
    const double alone = known.matrix[some[i] * known.size + some[i]];
    if (!(own[i * n + i] > undetermined * alone) || !(alone > 0.0)) return std::nullopt;
    out.size.push_back(std::sqrt(own[i * n + i]));
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      out.matrix(i, j) = own[i * n + j] / (out.size[i] * out.size[j]);
    }
  }
  out.lu = numerics::lu(out.matrix);
  if (!(numerics::reciprocal_condition(out.matrix, out.lu) > undetermined)) {
    return std::nullopt;
  }
  return out;
}

}  // namespace

std::vector<std::string> parameter_names(const force::Setup& setup,
                                         const force::Law& law,
                                         const Options& options) {
  Problem problem;
  problem.law = law;
  problem.unknowns = unknowns_of(setup, law, options);
  return names_of(problem);
}

namespace {

constexpr double tolerance_of_means = 1e-6;

/// I-30
Information information_of_means(const Trial& trial) {
  const MeansOfChannels& means = *trial.means;
  const std::vector<double> columns =
      force::channel_means(trial.setup, trial.law, means.sensor, tolerance_of_means);
  const std::size_t count = columns.size() / means.sd.size();
  Information out{.size = parameter_names(trial.setup, trial.law, trial.options).size(),
                  .matrix = {}};
  out.matrix.assign(out.size * out.size, 0.0);
  for (std::size_t k = 0; k < means.sd.size(); ++k) {
    const double* const c = &columns[k * count];
    for (std::size_t i = 0; i < count * count; ++i) {
      const double product = c[i / count] * c[i % count];
      out.matrix[i / count * out.size + i % count] +=
          product / (means.sd[k] * means.sd[k]);
    }
  }
  return out;
}

}  // namespace

Information information_of(std::span<const std::optional<base::Normal>> prior,
                           std::size_t size) {
  Information out{.size = size, .matrix = std::vector<double>(size * size, 0.0)};
  for (std::size_t c = 0; c < prior.size(); ++c) {
    if (prior[c]) out.matrix[c * size + c] = 1.0 / (prior[c]->sd * prior[c]->sd);
  }
  return out;
}

Information information_of(const Trial& trial) {
  if (trial.means) return information_of_means(trial);
  const Run run = turn_of(trial);
  const Prepared prepared = prepare(trial.setup, trial.law, {&run, 1}, trial.options);
  if (!prepared.problem) {
    throw std::invalid_argument("a trial that cannot be fitted: " + prepared.refusal);
  }
  Problem problem = *prepared.problem;
  problem.tolerance = final_tolerance;
  const Point point{trial.setup.runout, trial.law, {problem.fixed_phase}};
  const std::vector<double> J =
      jacobian_of(problem, evaluate(problem, parameters_of(problem, point)),
                  force::coefficients(trial.law));
  const double variance = trial.noise * trial.noise / trial.turns;
  return information(problem, J, 0, false, variance);
}

double effective_noise(const Fit& fit, std::span<const Run> runs) {
  double samples = 0.0;
  for (const Run& run : runs) samples += static_cast<double>(run.angle.size());
  return fit.widening * fit.rms * std::sqrt(samples / fit.freedom);
}

Information information_of(const force::Setup& setup, const force::Law& law,
                           std::span<const Run> runs, const Fit& fit,
                           std::size_t group) {
  const Prepared prepared = prepare(setup, law, runs, fit.options);
  if (!prepared.problem || group >= fit.groups.size()) {
    throw std::invalid_argument("records that cannot be fitted: " + prepared.refusal);
  }
  Problem problem = *prepared.problem;
  problem.tolerance = final_tolerance;
  const Point point{fit.runout, fit.law, fit.phase, fit.resonances};
  Evaluation at = evaluate(problem, parameters_of(problem, point));
  const numerics::LeastSquares linear =
      numerics::least_squares(design(problem, at), measured(problem), rank_tolerance);
  const Uncertainty known = uncertainty(
      problem, at, linear.x, leftover_of(problem, runs, fit, linear.residual));
  if (auto whole = inverse_of(problem, known, group)) return std::move(*whole);
  const std::vector<double> J = jacobian_of(problem, std::move(at), linear.x);
  const double noise = effective_noise(fit, runs);
  return information(problem, J, group, true, noise * noise);
}

Information sum(const Information& a, const Information& b) {
  if (a.size == 0) return b;
  if (b.size == 0) return a;
  if (a.size != b.size) throw std::invalid_argument("information of other parameters");
  Information out = a;
  std::ranges::transform(a.matrix, b.matrix, out.matrix.begin(), std::plus());
  return out;
}

std::optional<double> standard_error(const Information& known, std::size_t parameter) {
  const double one = 1.0;
  return standard_error(known, {&parameter, 1}, {&one, 1});
}

std::optional<double> standard_error(const Information& known,
                                     std::span<const std::size_t> parameters,
                                     std::span<const double> gradient) {
  if (known.size == 0) return std::nullopt;
  const std::optional<Scaled> s = scaled(known, parameters);
  if (!s) return std::nullopt;
  std::vector<double> g;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    g.push_back(gradient[i] / s->size[i]);
  }
  std::vector<double> x(g.size());
  numerics::solve(s->lu, g, x);
  double variance = 0.0;
  for (std::size_t i = 0; i < g.size(); ++i) variance += g[i] * x[i];
  return std::sqrt(variance);
}

std::optional<double> log_determinant(const Information& known,
                                      std::span<const std::size_t> parameters) {
  if (known.size == 0) return std::nullopt;
  const std::optional<Scaled> s = scaled(known, parameters);
  if (!s) return std::nullopt;
  double out = 0.0;
  for (std::size_t i = 0; i < parameters.size(); ++i) {  // I-21
    out -= std::log(std::abs(s->lu.factors(i, i))) + 2.0 * std::log(s->size[i]);
  }
  return out;
}

}  // namespace trochoid::identification
