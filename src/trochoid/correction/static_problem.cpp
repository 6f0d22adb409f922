#include <trochoid/base/units.h>
#include <trochoid/correction/ratio.h>
#include <trochoid/correction/static_problem.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction {

namespace {

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

}  // namespace

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

}  // namespace trochoid::correction
