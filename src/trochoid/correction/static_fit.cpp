#include <trochoid/correction/static_fit.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/correction/static_problem.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::correction {

namespace {

constexpr double rank_tolerance = 1e-10;
/// Thickest chip of a flute whose runout is seen, over that of a thin one.
constexpr double least_chip = 1.0;
/// Exponents to start from.
constexpr std::array<double, 2> exponents = {0.3, 0.6};

/// Covariance of the parameters, row-major; empty where some cannot be told apart.
std::vector<double> covariance(const StaticProblem& problem,
                               const std::vector<double>& p, double cost) {
  const std::size_t m = problem.residuals();
  const std::size_t n = p.size();
  std::vector<double> r(m);
  std::vector<double> columns(m * n);
  evaluate(problem, p, r, columns);
  std::vector<double> J(m * n);
  for (std::size_t i = 0; i < m; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      J[i * n + k] = columns[k * m + i];
    }
  }
  std::fill(r.begin(), r.end(), 0.0);
  auto fit = numerics::least_squares(J, static_cast<int>(n), r, rank_tolerance);
  for (double& value : fit.inverse_gram) {
    value *= 2 * cost / static_cast<double>(m - n);
  }
  return fit.inverse_gram;
}

/// Standard error of the sum of weights times parameters.
double error_of(const std::vector<double>& C, const std::vector<double>& weights) {
  const std::size_t n = weights.size();
  double sum = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      sum += weights[i] * C[i * n + k] * weights[k];
    }
  }
  return std::sqrt(std::max(sum, 0.0));
}

void fill_values(const StaticProblem& problem, const std::vector<double>& p,
                 const std::vector<double>& C, StaticFit& fit) {
  const std::size_t n = p.size();
  const StaticParameters at = parameters_of(problem, p);
  const auto se = [&](std::size_t k, double factor) {
    return factor * std::sqrt(std::max(C[k * n + k], 0.0));
  };
  fit.law = at.law;
  fit.K_t1 = {at.law.K_t1, se(0, std::abs(at.law.K_t1))};
  fit.m_t = {at.law.m_t, se(1, 1.0)};
  fit.K_r1 = {at.law.K_r1, se(2, std::abs(at.law.K_r1))};
  fit.m_r = {at.law.m_r, se(3, 1.0)};
  if (problem.axes > 2) {
    fit.K_a1 = {at.law.K_a1, se(4, std::abs(at.law.K_a1))};
    fit.m_a = {at.law.m_a, se(5, 1.0)};
  }
  fit.offset = {at.offset, problem.options.fit_offset ? se(n - 1, 1.0) : 0.0};
  // Each offset of a tooth as weights of the parameters.
  std::vector<std::vector<double>> weights(problem.teeth, std::vector<double>(n, 0.0));
  for (std::size_t j = 0; j + 1 < problem.teeth; ++j) {
    weights[j][problem.law_parameters() + j] = problem.setup.cut.f_z;
    weights.back()[problem.law_parameters() + j] = -problem.setup.cut.f_z;
  }
  for (std::size_t j = 0; j < problem.teeth; ++j) {
    const std::size_t last = (j + problem.teeth - 1) % problem.teeth;
    fit.rho.push_back({at.rho[j], error_of(C, weights[j])});
    std::vector<double> w = weights[j];
    for (std::size_t k = 0; k < n; ++k) {
      w[k] -= weights[last][k];
    }
    fit.h_ro.push_back({at.rho[j] - at.rho[last], error_of(C, w)});
  }
}

struct Found {
  std::vector<double> p;
  double final_cost = std::numeric_limits<double>::infinity();
  bool converged = false;
  std::array<double, 3> sign{};
};

Found fitted(const StaticProblem& problem, const std::vector<double>& start,
             int& iterations) {
  const numerics::Residuals residuals =
      [&](std::span<const double> p, std::span<double> r, std::span<double> jacobian) {
        return evaluate(problem, p, r, jacobian);
      };
  const auto found = numerics::levenberg_marquardt(
      residuals, static_cast<int>(problem.residuals()), start, {.max_iterations = 100});
  iterations += found.iterations;
  Found out{found.p, found.final_cost, found.converged, problem.sign};
  if (found.reason == "not started") {
    out.final_cost = std::numeric_limits<double>::infinity();
  }
  return out;
}

/// The best of all starts; its signs are left in the problem.
Found best_of(StaticProblem& problem, const std::optional<force::Power>& start,
              int& iterations) {
  if (start && !problem.setup.runout.radial_offsets.empty()) {
    leave_out_thin_chips(problem, start_offsets(problem, start->m_t), 0.0);
    return fitted(problem, start_of(problem, *start), iterations);
  }
  std::vector<force::Power> laws(exponents.size());
  for (std::size_t i = 0; i < laws.size(); ++i) {
    const double m = exponents[i];
    laws[i] = {.m_t = m, .m_r = m, .m_a = m};
  }
  if (start) {
    laws = {*start};
  }
  Found best;
  for (const force::Power& law : laws) {
    const std::vector<double> p = start_of(problem, law);
    const Found found = fitted(problem, p, iterations);
    if (found.final_cost < best.final_cost) {
      best = found;
    }
  }
  if (!std::isfinite(best.final_cost)) {
    return best;
  }
  problem.sign = best.sign;
  const StaticParameters at = parameters_of(problem, best.p);
  leave_out_thin_chips(problem, at.rho, at.offset);
  return fitted(problem, best.p, iterations);
}

/// Why the runout of a flute is not known: it
/// cuts next to nothing. Empty: they all cut.
std::string hardly_cutting(const StaticProblem& problem, const std::vector<double>& p) {
  force::Setup setup = problem.setup;
  setup.runout = {.radial_offsets = parameters_of(problem, p).rho};
  const RigidCut cut(setup, force::Power{}, 1);
  const auto flutes = cut.peaks(Harmonics{});
  for (std::size_t j = 0; j < flutes.size(); ++j) {
    if (flutes[j].peak_chip < least_chip * problem.options.thin * setup.cut.f_z) {
      return fmt::format(
          "flute {} hardly cuts, or not at all: it stands back by about the chip "
          "of the others, or more, and its runout is not known better",
          j + 1);
    }
  }
  return {};
}

}  // namespace

std::optional<force::Power> power_near(const force::Law& law) {
  using Start = std::optional<force::Power>;
  return std::visit(
      base::Overloaded{[](const force::LinearEdge&) { return Start{}; },
                       [](const force::Power& power) { return Start{power}; },
                       [](const force::PowerEdge&) { return Start{}; }},
      law);
}

StaticFit static_fit(const force::Setup& setup, const ForceRecord& record,
                     const StaticFitOptions& options,
                     const std::optional<force::Power>& start) {
  if (record.angle.size() != record.force.size()) {
    throw std::invalid_argument("static_fit: one force for each angle");
  }
  StaticFit fit;
  StaticProblem problem = static_problem(setup, record, options);
  fit.samples = problem.angle.size();
  if (problem.residuals() < 3 * problem.parameters()) {
    fit.reason = fmt::format(
        "{} samples away from entries and exits are too few for {} unknowns",
        fit.samples, problem.parameters());
    return fit;
  }
  if (!(problem.size > 0)) {
    fit.reason = "there is no force in the record";
    return fit;
  }
  const Found best = best_of(problem, start, fit.iterations);
  if (!std::isfinite(best.final_cost) || !possible(problem, best.p)) {
    fit.reason = "the fit did not start: the record is not like a cut";
    return fit;
  }
  fit.samples = problem.angle.size();
  fit.rms = problem.size * std::sqrt(2 * best.final_cost);
  fit.explained = 1 - 2 * best.final_cost * static_cast<double>(problem.axes) / 3;
  fit.reason = hardly_cutting(problem, best.p);
  if (!fit.reason.empty()) {
    return fit;
  }
  const std::vector<double> C = covariance(problem, best.p, best.final_cost);
  if (C.empty()) {
    fit.reason = "coefficients, exponents and runout cannot be told apart";
    return fit;
  }
  fill_values(problem, best.p, C, fit);
  fit.ok = best.converged;
  fit.reason = best.converged ? "" : "the fit did not converge";
  return fit;
}

}  // namespace trochoid::correction
