#include <trochoid/correction/static_fit.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/base/units.h>
#include <trochoid/correction/ratio.h>
#include <trochoid/correction/rigid_cut.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

namespace trochoid::correction {
namespace {

/// Samples that are used, and what is looked for.
struct StaticProblem {
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
struct StaticParameters {
  force::Power law;
  std::vector<double> rho;
  double offset = 0.0;
};

/// Samples away from entries and exits.
StaticProblem static_problem(const force::Setup& setup, const ForceRecord& record,
                             const StaticFitOptions& options);

StaticParameters parameters_of(const StaticProblem& problem, std::span<const double> p);

/// Whether there are such cuts at all.
bool possible(const StaticProblem& problem, std::span<const double> p);

/// @brief R-21 over the size of the force, and its derivatives where asked for.
/// @return false where the parameters are not possible
bool evaluate(const StaticProblem& problem, std::span<const double> p,
              std::span<double> r, std::span<double> jacobian);

/// Offsets to start from: those given, or from the peaks.
std::vector<double> start_offsets(const StaticProblem& problem, double m);

/// Parameters of a start; takes the signs of the coefficients.
std::vector<double> start_of(StaticProblem& problem, const force::Power& law);

/// Leave out the samples at which a chip begins or ends inside the arc of cut.
void leave_out_thin_chips(StaticProblem& problem, const std::vector<double>& rho,
                          double offset);

constexpr double rank_tolerance = 1e-10;
/// Step of the central differences, for parameters of about one.
constexpr double difference = 1e-6;
/// Parameters outside of which no metal is.
constexpr double least_exponent = -0.5;
constexpr double most_exponent = 0.98;
constexpr double most_runout = 5.0;  ///< over the feed per tooth
constexpr double most_offset = 1.0;  ///< [rad]
/// Part of F_z that must go with the force in the plane.
constexpr double axial_share = 0.25;

/// Is F_z a force of the cut? Noise, or a channel that nothing is connected to, would
/// pull K_a1 towards zero, where its exponent means nothing.
bool axial_force(const std::vector<std::array<double, 3>>& force) {
  double zz = 0.0;
  double zp = 0.0;
  double pp = 0.0;
  for (const auto& F : force) {
    const double plane = std::hypot(F[0], F[1]);
    zz += F[2] * F[2];
    zp += F[2] * plane;
    pp += plane * plane;
  }
  return zp * zp > axial_share * zz * pp;
}

RigidCut cut_of(const StaticProblem& problem, const StaticParameters& at) {
  force::Setup setup = problem.setup;
  setup.runout = {.radial_offsets = at.rho};
  return RigidCut(setup, at.law, problem.options.slices);
}

void residuals_at(const StaticProblem& problem, std::span<const double> p,
                  std::span<double> r) {
  const StaticParameters at = parameters_of(problem, p);
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

/// Is the tip of a tooth about to enter or leave at this angle?
bool near_an_end(const RigidCut& cut, double phi, double guard) {
  return std::any_of(cut.psi().begin(), cut.psi().end(), [&](double psi) {
    const auto off = [&](double end) {
      const double d = phi - psi - end;
      return std::abs(d - unit::turn * std::round(d / unit::turn));
    };
    return off(cut.arc().from) < guard || off(cut.arc().to) < guard;
  });
}

/// Coefficients by linear least squares, for given exponents and offsets.
std::array<double, 3> linear_start(const StaticProblem& problem, StaticParameters at) {
  std::vector<RigidCut> unit;
  for (std::size_t q = 0; q < problem.axes; ++q) {
    at.law.K_t1 = q == 0 ? 1.0 : 0.0;
    at.law.K_r1 = q == 1 ? 1.0 : 0.0;
    at.law.K_a1 = q == 2 ? 1.0 : 0.0;
    unit.push_back(cut_of(problem, at));
  }
  std::vector<double> columns;
  std::vector<double> b;
  std::vector<std::array<double, 3>> F(problem.axes);
  const PeriodicMotion still = Harmonics{};
  for (std::size_t i = 0; i < problem.angle.size(); ++i) {
    for (std::size_t q = 0; q < problem.axes; ++q) {
      F[q] = unit[q].force(still, problem.angle[i]);
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

StaticParameters parameters_of(const StaticProblem& problem,
                               std::span<const double> p) {
  StaticParameters out;
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

bool possible(const StaticProblem& problem, std::span<const double> p) {
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

bool evaluate(const StaticProblem& problem, std::span<const double> p,
              std::span<double> r, std::span<double> jacobian) {
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

StaticProblem static_problem(const force::Setup& setup, const ForceRecord& record,
                             const StaticFitOptions& options) {
  StaticProblem problem{.setup = setup, .options = options};
  problem.teeth = static_cast<std::size_t>(setup.cutter.teeth());
  const RigidCut cut(setup, force::Power{}, 1);
  double square = 0.0;
  for (std::size_t i = 0; i < record.angle.size(); ++i) {
    const auto& F = record.force[i];
    if (!near_an_end(cut, record.angle[i], options.guard)) {
      problem.angle.push_back(record.angle[i]);
      problem.force.push_back(F);
      square += F[0] * F[0] + F[1] * F[1] + F[2] * F[2];
    }
  }
  problem.axes = options.axial && axial_force(problem.force) ? 3 : 2;
  problem.size = std::sqrt(
      square / static_cast<double>(std::max<std::size_t>(3 * problem.angle.size(), 1)));
  return problem;
}

std::vector<double> start_offsets(const StaticProblem& problem, double m) {
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
  const RigidCut cut(problem.setup, force::Power{}, 1);
  std::vector<double> peaks = peaks_of_turns(cut, problem.angle, problem.force);
  const double largest = *std::max_element(peaks.begin(), peaks.end());
  for (double& peak : peaks) {
    peak = std::max(peak, 0.02 * largest);
  }
  const RatioEstimate ratio = ratio_estimate(peaks, cut.nominal_chip(), m);
  return ratio.ok ? ratio.rho : std::vector<double>(problem.teeth, 0.0);
}

std::vector<double> start_of(StaticProblem& problem, const force::Power& law) {
  const StaticParameters at{law, start_offsets(problem, law.m_t), 0.0};
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

void leave_out_thin_chips(StaticProblem& problem, const std::vector<double>& rho,
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

/// Thickest chip of a flute whose runout is seen, over that of a thin one.
constexpr double least_chip = 1.0;
/// Exponents to start from.
constexpr std::array<double, 2> exponents = {0.3, 0.6};

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

numerics::Residuals residuals_of(const StaticProblem& problem) {
  return [&problem](std::span<const double> p, std::span<double> r,
                    std::span<double> jacobian) {
    return evaluate(problem, p, r, jacobian);
  };
}

struct Found {
  std::vector<double> p;
  double final_cost = std::numeric_limits<double>::infinity();
  bool converged = false;
  std::array<double, 3> sign{};
};

Found fitted(const StaticProblem& problem, const std::vector<double>& start,
             int& iterations) {
  const auto found = numerics::levenberg_marquardt(
      residuals_of(problem), static_cast<int>(problem.residuals()), start,
      {.max_iterations = 100});
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
  const std::vector<double> C = numerics::covariance_at(
      residuals_of(problem), static_cast<int>(problem.residuals()), best.p,
      best.final_cost, rank_tolerance);
  if (C.empty()) {
    fit.reason = "coefficients, exponents and runout cannot be determined separately";
    return fit;
  }
  fill_values(problem, best.p, C, fit);
  fit.ok = best.converged;
  fit.reason = best.converged ? "" : "the fit did not converge";
  return fit;
}

}  // namespace trochoid::correction
