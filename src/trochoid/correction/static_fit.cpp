#include <trochoid/correction/static_fit.h>

#include <trochoid/correction/ratio.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <stdexcept>

namespace trochoid::correction {

namespace {

constexpr double turn = 2 * std::numbers::pi;
constexpr double rank_tolerance = 1e-10;
/// Step of the central differences, for parameters of about one.
constexpr double difference = 1e-6;
/// Exponents to start from.
constexpr std::array<double, 2> exponents = {0.3, 0.6};
/// Parameters outside of which no metal is.
constexpr double least_exponent = -0.5;
constexpr double most_exponent = 0.98;
constexpr double most_runout = 5.0;  ///< over the feed per tooth
constexpr double most_offset = 1.0;  ///< [rad]

/// Samples that are used, and what is looked for.
struct Problem {
  force::Setup setup;
  StaticFitOptions options;
  std::vector<double> angle;
  std::vector<std::array<double, 3>> force;
  std::size_t axes = 3;  ///< 2: F_z is left out
  std::size_t teeth = 1;
  double size = 1.0;                             ///< rms of the force [N]
  std::array<double, 3> sign = {1.0, 1.0, 1.0};  ///< of K_t1, K_r1, K_a1

  [[nodiscard]] std::size_t law_parameters() const { return 2 * axes; }
  [[nodiscard]] std::size_t parameters() const {
    return law_parameters() + teeth - 1 + (options.fit_offset ? 1 : 0);
  }
  [[nodiscard]] std::size_t residuals() const { return axes * angle.size(); }
};

/// ln K and m of t, r, (a), offsets over f_z but the last one, angle.
struct Parameters {
  force::Power law;
  std::vector<double> rho;
  double offset = 0.0;
};

Parameters read(const Problem& problem, std::span<const double> p) {
  Parameters out;
  out.law = {.K_t1 = problem.sign[0] * std::exp(p[0]),
             .K_r1 = problem.sign[1] * std::exp(p[2]),
             .K_a1 = problem.axes > 2 ? problem.sign[2] * std::exp(p[4]) : 0.0,
             .m_t = p[1],
             .m_r = p[3],
             .m_a = problem.axes > 2 ? p[5] : 0.0};
  const std::size_t first = problem.law_parameters();
  double last = 0.0;
  for (std::size_t j = 0; j + 1 < problem.teeth; ++j) {
    out.rho.push_back(p[first + j] * problem.setup.cut.f_z);
    last -= out.rho.back();
  }
  out.rho.push_back(last);
  out.offset = problem.options.fit_offset ? p.back() : 0.0;
  return out;
}

RigidCut cut_of(const Problem& problem, const Parameters& at) {
  force::Setup setup = problem.setup;
  setup.runout = {.radial_offsets = at.rho};
  return RigidCut(setup, at.law, problem.options.slices);
}

bool possible(const Problem& problem, std::span<const double> p) {
  for (std::size_t q = 0; q < problem.axes; ++q) {
    const double m = p[2 * q + 1];
    if (std::abs(p[2 * q]) > 60 || m < least_exponent || m > most_exponent) {
      return false;
    }
  }
  for (std::size_t k = problem.law_parameters(); k < p.size(); ++k) {
    const bool angle = problem.options.fit_offset && k + 1 == p.size();
    if (std::abs(p[k]) > (angle ? most_offset : most_runout)) {
      return false;
    }
  }
  return true;
}

void residuals_at(const Problem& problem, std::span<const double> p,
                  std::span<double> r) {
  const Parameters at = read(problem, p);
  const RigidCut cut = cut_of(problem, at);
  const PeriodicMotion still = Harmonics{};
  const double scale =
      1 / (problem.size * std::sqrt(static_cast<double>(problem.residuals())));
  for (std::size_t i = 0; i < problem.angle.size(); ++i) {
    const auto F = cut.force(still, problem.angle[i] + at.offset);
    for (std::size_t q = 0; q < problem.axes; ++q) {
      r[i * problem.axes + q] = scale * (F[q] - problem.force[i][q]);
    }
  }
}

bool evaluate(const Problem& problem, std::span<const double> p, std::span<double> r,
              std::span<double> jacobian) {
  if (!possible(problem, p)) {
    return false;
  }
  residuals_at(problem, p, r);
  if (jacobian.empty()) {
    return true;
  }
  const std::size_t m = r.size();
  std::vector<double> up(m);
  std::vector<double> down(m);
  std::vector<double> moved(p.begin(), p.end());
  for (std::size_t k = 0; k < p.size(); ++k) {
    moved[k] = p[k] + difference;
    residuals_at(problem, moved, up);
    moved[k] = p[k] - difference;
    residuals_at(problem, moved, down);
    moved[k] = p[k];
    for (std::size_t i = 0; i < m; ++i) {
      jacobian[k * m + i] = (up[i] - down[i]) / (2 * difference);
    }
  }
  return true;
}

/// Is the tip of a tooth about to enter or leave at this angle?
bool near_an_end(const RigidCut& cut, double phi, double guard) {
  return std::any_of(cut.psi().begin(), cut.psi().end(), [&](double psi) {
    const auto off = [&](double end) {
      const double d = phi - psi - end;
      return std::abs(d - turn * std::round(d / turn));
    };
    return off(cut.arc().from) < guard || off(cut.arc().to) < guard;
  });
}

Problem problem_of(const force::Setup& setup, const ForceRecord& record,
                   const StaticFitOptions& options) {
  Problem problem{.setup = setup, .options = options};
  problem.teeth = static_cast<std::size_t>(setup.cutter.teeth());
  const RigidCut cut(setup, force::Power{}, 1);
  double square = 0.0;
  double axial = 0.0;
  for (std::size_t i = 0; i < record.angle.size(); ++i) {
    const auto& F = record.force[i];
    if (!near_an_end(cut, record.angle[i], options.guard)) {
      problem.angle.push_back(record.angle[i]);
      problem.force.push_back(F);
      square += F[0] * F[0] + F[1] * F[1] + F[2] * F[2];
      axial = std::max(axial, std::abs(F[2]));
    }
  }
  problem.axes = options.axial && axial > 0 ? 3 : 2;
  problem.size = std::sqrt(
      square / static_cast<double>(std::max<std::size_t>(3 * problem.angle.size(), 1)));
  return problem;
}

/// Largest |F_y| in the turn of each tooth.
std::vector<double> peaks_of(const Problem& problem) {
  const RigidCut cut(problem.setup, force::Power{}, 1);
  std::vector<double> peaks(problem.teeth);
  for (std::size_t i = 0; i < problem.angle.size(); ++i) {
    double& peak = peaks[cut.turn_of(problem.angle[i])];
    peak = std::max(peak, std::abs(problem.force[i][1]));
  }
  return peaks;
}

std::vector<double> start_offsets(const Problem& problem, double m) {
  if (!problem.setup.runout.radial_offsets.empty()) {
    std::vector<double> rho = problem.setup.runout.radial_offsets;
    double mean = 0.0;
    for (const double r : rho) {
      mean += r / static_cast<double>(rho.size());
    }
    for (double& r : rho) {
      r -= mean;
    }
    return rho;
  }
  std::vector<double> peaks = peaks_of(problem);
  const double largest = *std::max_element(peaks.begin(), peaks.end());
  for (double& peak : peaks) {
    peak = std::max(peak, 0.02 * largest);
  }
  const RatioEstimate ratio = ratio_estimate(peaks, problem.setup.cut.f_z, m);
  return ratio.ok ? ratio.rho : std::vector<double>(problem.teeth, 0.0);
}

/// Coefficients by linear least squares, for given exponents and offsets.
std::array<double, 3> linear_start(const Problem& problem, Parameters at) {
  std::vector<RigidCut> unit;
  for (std::size_t q = 0; q < problem.axes; ++q) {
    at.law.K_t1 = q == 0 ? 1.0 : 0.0;
    at.law.K_r1 = q == 1 ? 1.0 : 0.0;
    at.law.K_a1 = q == 2 ? 1.0 : 0.0;
    unit.push_back(cut_of(problem, at));
  }
  std::vector<double> columns;
  std::vector<double> b;
  const PeriodicMotion still = Harmonics{};
  for (std::size_t i = 0; i < problem.angle.size(); ++i) {
    std::vector<std::array<double, 3>> F;
    for (const RigidCut& cut : unit) {
      F.push_back(cut.force(still, problem.angle[i]));
    }
    for (std::size_t a = 0; a < problem.axes; ++a) {
      for (const auto& f : F) {
        columns.push_back(f[a]);
      }
      b.push_back(problem.force[i][a]);
    }
  }
  const auto x = numerics::least_squares(columns, static_cast<int>(problem.axes), b,
                                         rank_tolerance)
                     .x;
  std::array<double, 3> K{};
  std::copy(x.begin(), x.end(), K.begin());
  return K;
}

/// Parameters of a start; takes the signs of the coefficients.
std::vector<double> start_of(Problem& problem, const force::Power& law) {
  const Parameters at{law, start_offsets(problem, law.m_t), 0.0};
  std::array<double, 3> K = {law.K_t1, law.K_r1, law.K_a1};
  if (K[0] == 0) {
    K = linear_start(problem, at);
  }
  const std::array<double, 3> m = {law.m_t, law.m_r, law.m_a};
  const double least = std::max(1e-3 * std::abs(K[0]), 1.0);
  std::vector<double> p;
  p.reserve(problem.parameters());
  for (std::size_t q = 0; q < problem.axes; ++q) {
    problem.sign[q] = K[q] < 0 ? -1.0 : 1.0;
    p.push_back(std::log(std::max(std::abs(K[q]), least)));
    p.push_back(m[q]);
  }
  for (std::size_t j = 0; j + 1 < problem.teeth; ++j) {
    p.push_back(at.rho[j] / problem.setup.cut.f_z);
  }
  if (problem.options.fit_offset) {
    p.push_back(0.0);
  }
  return p;
}

/// Covariance of the parameters, row-major; empty where some cannot be told apart.
std::vector<double> covariance(const Problem& problem, const std::vector<double>& p,
                               double cost) {
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

void fill_values(const Problem& problem, const std::vector<double>& p,
                 const std::vector<double>& C, StaticFit& fit) {
  const std::size_t n = p.size();
  const Parameters at = read(problem, p);
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

/// Without the samples at which a chip begins or ends inside the arc of cut.
void leave_out_thin_chips(Problem& problem, const std::vector<double>& rho,
                          double offset) {
  const RigidCut cut = cut_of(problem, {.rho = rho});
  const double thin = problem.options.thin * problem.setup.cut.f_z;
  const PeriodicMotion still = Harmonics{};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < problem.angle.size(); ++i) {
    bool good = true;
    for (int j = 0; j < cut.teeth(); ++j) {
      const double h = cut.chip(still, j, problem.angle[i] + offset).margin;
      good = good && (h == 0 || std::abs(h) > thin);
    }
    if (good) {
      problem.angle[kept] = problem.angle[i];
      problem.force[kept] = problem.force[i];
      ++kept;
    }
  }
  problem.angle.resize(kept);
  problem.force.resize(kept);
}

struct Found {
  std::vector<double> p;
  double final_cost = std::numeric_limits<double>::infinity();
  bool converged = false;
  std::array<double, 3> sign{};
};

Found fitted(const Problem& problem, const std::vector<double>& start,
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
Found best_of(Problem& problem, const std::optional<force::Power>& start,
              int& iterations) {
  if (start && !problem.setup.runout.radial_offsets.empty()) {
    leave_out_thin_chips(problem, start_offsets(problem, start->m_t), 0.0);
    return fitted(problem, start_of(problem, *start), iterations);
  }
  std::vector<force::Power> laws;
  for (const double m : exponents) {
    laws.push_back({.m_t = m, .m_r = m, .m_a = m});
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
  const Parameters at = read(problem, best.p);
  leave_out_thin_chips(problem, at.rho, at.offset);
  return fitted(problem, best.p, iterations);
}

}  // namespace

StaticFit static_fit(const force::Setup& setup, const ForceRecord& record,
                     const StaticFitOptions& options,
                     const std::optional<force::Power>& start) {
  if (record.angle.size() != record.force.size()) {
    throw std::invalid_argument("static_fit: one force for each angle");
  }
  StaticFit fit;
  Problem problem = problem_of(setup, record, options);
  fit.samples = problem.angle.size();
  if (problem.residuals() < 3 * problem.parameters()) {
    fit.reason = fmt::format(
        "{} samples away from entries and exits are too few for {} "
        "unknowns",
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
