#include <trochoid/base/index.h>
#include <trochoid/identification/derivatives.h>
#include <trochoid/identification/local_minimum.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/reliability.h>
#include <trochoid/identification/systematic_columns.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/student.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace trochoid::identification {
namespace {

constexpr double insensitive = 1e-6;  ///< of the measured force, for one scaled unit
constexpr double dependent = 1e-6;    ///< of the largest singular value
constexpr double separable = 0.01;
/// Of what a fit leaves unexplained: a direction that shows less is lost in it.
constexpr double lost_in_rest = 0.5;
constexpr double takes_part = 1e-3;  ///< of the largest part in a null direction

constexpr Step fine_step{1e-4, 1e-5};
constexpr Step fine_step_back{-1e-4, -1e-5};
/// Slopes to either side that differ by more than this are those of an edge.
constexpr double edge_ratio = 3.0;

using base::index;

/// Columns that are kept, in their order.
std::vector<double> keep_columns(const numerics::Columns& A,
                                 const std::vector<std::size_t>& kept) {
  std::vector<double> out;
  out.reserve(A.rows * kept.size());
  for (const std::size_t c : kept) out.insert(out.end(), A[c].begin(), A[c].end());
  return out;
}

/// The change of the force with an unknown. Where the force jumps as the unknown passes a
/// value, the jump itself says nothing about the neighbourhood: of both one-sided
/// differences the smaller one is without it.
/// @param[out] column  shape (rows)
/// @param behind       as much memory
/// @return whether the slopes to either side are very different
bool find_slope(const Derivatives& derivatives, int i, bool jumps,
                std::span<double> column, std::span<double> behind) {
  derivatives.find(i, fine_step, column);
  derivatives.find(i, fine_step_back, behind);
  const double a = numerics::norm(column);
  const double b = numerics::norm(behind);
  if (jumps) {
    if (b <= a) std::ranges::copy(behind, column.begin());
    return false;
  }
  std::ranges::transform(column, behind, column.begin(),
                         [](double x, double y) { return 0.5 * (x + y); });
  return std::max(a, b) > edge_ratio * std::min(a, b);
}

/// Derivatives of the force by all unknowns.
struct Jacobian {
  std::vector<double> J;      ///< [D] and the derivatives beside it, by columns
  std::vector<bool> on_edge;  ///< shape (linear + count)
};

Jacobian full_jacobian(const Problem& problem, Evaluation at,
                       std::span<const double> K) {
  const std::size_t linear = index(problem.linear());
  const std::size_t width = linear + at.p.size();
  const std::size_t rows = index(problem.rows());
  const Derivatives derivatives(problem, at, K);
  const bool jumps = sum_of_squares_jumps(problem);
  Jacobian out{std::move(at.D), std::vector<bool>(width, false)};
  out.J.resize(rows * width);
  std::vector<double> behind(rows);
  for (std::size_t i = 0; i < at.p.size(); ++i) {
    out.on_edge[linear + i] =
        find_slope(derivatives, static_cast<int>(i), jumps,
                   std::span(out.J).subspan((linear + i) * rows, rows), behind);
  }
  return out;
}

std::string together(const std::vector<std::string>& names,
                     const std::vector<std::size_t>& members, std::size_t self) {
  std::string list;
  for (const std::size_t m : members) {
    if (m != self) list += (list.empty() ? "" : ", ") + names[m];
  }
  return "cannot be determined separately from " + list;
}

/// Forces of a run that are not measured: `the axial force was not measured`.
std::string missing_forces(const FoldedRun& run) {
  std::string list;
  for (std::size_t q = 0; q < 3; ++q) {
    if (run.measured[q]) continue;
    list += list.empty() ? "" : " and ";
    list += q == 2 ? "the axial force" : q == 1 ? "the force in y" : "the force in x";
  }
  return list + (measured_count(run) == 2 ? " was" : " were") + " not measured";
}

void drop_insensitive(const numerics::Columns& J, std::size_t linear, double force_norm,
                      Uncertainty& out) {
  for (std::size_t c = linear; c < J.count(); ++c) {
    if (!(numerics::norm(J[c]) > insensitive * force_norm)) {
      out.reason[c] = "the force does not depend on it";
    }
  }
}

/// Mark what takes part in null directions; the rest of the unknowns is not concerned.
numerics::LeastSquares drop_dependent(const numerics::Columns& J,
                                      const std::vector<std::string>& names,
                                      std::span<const double> b,
                                      std::vector<std::size_t>& kept,
                                      Uncertainty& out) {
  for (;;) {
    const std::vector<double> A =
        kept.size() < J.count() ? keep_columns(J, kept) : std::vector<double>{};
    numerics::LeastSquares fit = numerics::least_squares(
        A.empty() ? J : numerics::Columns(A, J.rows), b, dependent);
    if (fit.null_space.empty()) return fit;
    const std::span<const double> v(fit.null_space.data(), kept.size());
    const auto size = [](double a, double c) { return std::abs(a) < std::abs(c); };
    const auto largest = std::ranges::max_element(v, size);
    std::vector<std::size_t> members;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (std::abs(v[i]) > takes_part * std::abs(*largest)) members.push_back(kept[i]);
    }
    for (const std::size_t m : members) {
      if (out.reason[m].empty()) out.reason[m] = together(names, members, m);
    }
    kept.erase(kept.begin() + (largest - v.begin()));
  }
}

/// Unknowns that are determined, by their columns.
struct Determined {
  numerics::Columns J;
  const std::vector<std::size_t>& which;
  const std::vector<double>& inverse_gram;
};

/// Of those determined, the ones that all runs have in common.
std::vector<std::size_t> shared_of(const Problem& problem,
                                   const std::vector<std::size_t>& kept) {
  const std::size_t own = index(problem.linear() + problem.unknowns.first_phase());
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const bool channel_offset =
        kept[i] >= index(problem.force_columns()) && kept[i] < index(problem.linear());
    // With groups of records the coefficients are each group's own.
    const bool of_group = kept[i] < index(problem.force_columns()) &&
                          problem.force_columns() > problem.columns;
    if (!channel_offset && !of_group && kept[i] < own) out.push_back(i);
  }
  return out;
}

/// By how much the intervals of the coefficients are wider than white noise makes them.
double widening_of(const Problem& problem, const Determined& unknowns,
                   std::span<const double> covariance, double variance) {
  double sum = 0.0;
  double count = 0.0;
  const std::size_t p = unknowns.which.size();
  for (std::size_t i = 0; i < p; ++i) {
    if (unknowns.which[i] >= index(problem.force_columns())) continue;
    sum += covariance[i * p + i] / (variance * unknowns.inverse_gram[i * p + i]);
    count += 1.0;
  }
  return count > 0 && variance > 0 ? std::sqrt(sum / count) : 1.0;
}

/// @return of the determined unknowns
/// @param out  its freedom is known; that of the quantile and the widening are set
std::vector<double> covariance_of(const Problem& problem, const Determined& unknowns,
                                  const Leftover& left, Uncertainty& out) {
  const double variance = out.freedom > 0.0 ? left.rss / out.freedom : 0.0;
  std::vector<double> white_noise = unknowns.inverse_gram;
  for (double& v : white_noise) v *= variance;
  out.chance = variance;
  if (left.runs.empty() || !(variance > 0)) return white_noise;
  auto found = sandwich(problem, unknowns.J, unknowns.inverse_gram,
                        shared_of(problem, unknowns.which), left);
  if (!found) {
    if (problem.runs.front().band > 0) return white_noise;
    out.widening = interval_widening(left.runs, left.fitted,
                                     static_cast<int>(unknowns.which.size()));
    for (double& v : white_noise) v *= out.widening * out.widening;
    out.chance *= out.widening * out.widening;
    return white_noise;
  }
  out.quantile_freedom = std::min(out.freedom, std::max(1.0, found->freedom));
  out.chance = found->chance;
  out.widening = widening_of(problem, unknowns, found->covariance, variance) *
                 numerics::student_t(0.975, out.quantile_freedom) /
                 numerics::student_t(0.975, out.freedom);
  return std::move(found->covariance);
}

}  // namespace

std::vector<std::string> names_of(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  std::vector<std::string> out;
  for (const std::string& group : problem.groups) {
    const bool alone = problem.groups.size() == 1;
    for (const force::Quantity& K : force::coefficient_quantities(problem.law)) {
      out.push_back(alone ? std::string(K.key)
                          : fmt::format("{} of {}", K.key, label_of_group(group)));
    }
  }
  for (int i = 0; i < problem.drift_columns(); ++i) {
    out.push_back(fmt::format("{} of channel {} in run {}",
                              i % 2 == 0 ? "offset" : "drift", i % 6 / 2 + 1,
                              i / 6 + 1));
  }
  if (finds_offsets(u.runout)) {
    for (int k = 1; k < u.teeth; ++k) {
      out.push_back(fmt::format("radial_offsets_mm[{}]", k + 1));
    }
  }
  if (finds_eccentricity(u.runout)) {
    out.emplace_back("eccentricity_mm");
    if (!u.direction) out.emplace_back("angle_deg");
  }
  if (u.exponents) out.insert(out.end(), {"m_t", "m_r", "m_a"});
  constexpr std::array axes{"x", "y", "z"};
  for (std::size_t q = 0; q < 3; ++q) {
    if (!u.rings[q]) continue;
    out.push_back(fmt::format("resonances.{}.frequency_Hz", axes[q]));
    out.push_back(fmt::format("resonances.{}.damping_ratio", axes[q]));
  }
  for (int r = 0; r < u.phases; ++r) {
    out.push_back(u.phases == 1 ? "phase_deg" : fmt::format("phase_deg[{}]", r + 1));
  }
  return out;
}

std::vector<std::string> unmeasured_reasons(const Problem& problem,
                                            const numerics::Columns& D) {
  std::vector<std::string> out(index(problem.linear()));
  const std::size_t force = index(problem.force_columns());
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& run = problem.runs[r];
    if (measured_count(run) == 3) continue;
    const std::string why = missing_forces(run);
    for (std::size_t i = 0; i < index(problem.columns); ++i) {
      const std::size_t c = first_column(problem, r) + i;
      if (numerics::norm(D[c]) == 0.0) out[c] = why;
    }
    for (std::size_t i = 0; i < 6 && problem.drift_columns() > 0; ++i) {
      if (!run.measured[i / 2]) out[force + 6 * r + i] = why;
    }
  }
  return out;
}

std::vector<double> jacobian_of(const Problem& problem, Evaluation at,
                                std::span<const double> K) {
  return full_jacobian(problem, std::move(at), K).J;
}

Uncertainty uncertainty(const Problem& problem, Evaluation at,
                        std::span<const double> K, const Leftover& left) {
  const std::vector<std::string> names = names_of(problem);
  const std::size_t width = names.size();
  const std::size_t linear = index(problem.linear());
  const std::vector<double> p = at.p;
  const std::vector<double> force = force_rows(problem, at, K);
  const auto [all, on_edge] = full_jacobian(problem, std::move(at), K);
  const numerics::Columns J(all, index(problem.rows()));
  const std::vector<double> b = measured(problem);
  Uncertainty out;
  out.reason = unmeasured_reasons(problem, J);
  out.reason.resize(width);
  for (const std::string& why : out.reason) out.unmeasured.push_back(!why.empty());
  out.on_edge.assign(width, false);
  drop_insensitive(J, linear, numerics::norm(b), out);
  std::vector<std::size_t> kept;
  const std::size_t runout_end = linear + index(problem.unknowns.runout_count());
  for (std::size_t c = 0; c < width; ++c) {
    out.on_edge[c] = on_edge[c] && c < runout_end && out.reason[c].empty();
    if (out.reason[c].empty() && !out.on_edge[c]) kept.push_back(c);
  }
  const numerics::LeastSquares fit = drop_dependent(J, names, b, kept, out);
  out.freedom = left.equations - static_cast<double>(kept.size());
  out.quantile_freedom = out.freedom;
  const std::vector<double> some =
      kept.size() < width ? keep_columns(J, kept) : std::vector<double>{};
  const numerics::Columns own = some.empty() ? J : numerics::Columns(some, J.rows);
  std::vector<double> covariance =
      covariance_of(problem, {own, kept, fit.inverse_gram}, left, out);
  add_tolerances({problem, p, K, force}, own, covariance);
  out.covariance.assign(width * width, 0.0);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    for (std::size_t j = 0; j < kept.size(); ++j) {
      out.covariance[kept[i] * width + kept[j]] = covariance[i * kept.size() + j];
    }
  }
  return out;
}

Uncertainty uncertainty(const Problem& problem, std::span<const double> p,
                        std::span<const double> K, const Leftover& left) {
  return uncertainty(problem, evaluate(problem, p), K, left);
}

namespace {

/// Sum of squares of the samples of a run about the means of its channels.
double squares_about_means(const FoldedRun& run) {
  double out = 0.0;
  for (std::size_t q = 0; q < 3; ++q) {
    double weight = 0.0;
    double sum = 0.0;
    for (std::size_t g = 0; g < run.angle.size(); ++g) {
      const double w = run.weight[g] * run.weight[g];
      weight += w;
      sum += w * run.force[g][q];
    }
    for (std::size_t g = 0; g < run.angle.size(); ++g) {
      const double d = run.weight[g] * (run.force[g][q] - sum / weight);
      out += d * d;
    }
  }
  return out;
}

/// The same of rows of a band, or about constants and slopes.
double squares_about_columns(const FoldedRun& run) {
  std::vector<double> A = run.drift;
  if (A.empty()) {
    const std::size_t u = run.angle.size();
    std::vector<double> ones(9 * u, 0.0);
    for (std::size_t g = 0; g < u; ++g) {
      for (std::size_t q = 0; q < 3; ++q) ones[9 * g + 4 * q] = 1.0;
    }
    A = rows_of(run, ones, 3);
  }
  std::vector<double> b = run.b;
  numerics::project_out(A, run.drift.empty() ? 3 : 6, b, 1);
  return numerics::dot(b, b);
}

}  // namespace

double rss_of_means(const Problem& problem) {
  double sum = 0.0;
  for (const FoldedRun& run : problem.runs) {
    sum += run.band == 0 && run.drift.empty() ? squares_about_means(run)
                                              : squares_about_columns(run);
  }
  return sum;
}

std::optional<double> single_direction(const Problem& problem,
                                       std::span<const double> p,
                                       std::span<const double> K, double unexplained) {
  const Unknowns& u = problem.unknowns;
  if (u.runout != RunoutUnknowns::eccentricity || u.direction) return std::nullopt;
  const double least = std::max(separable, lost_in_rest * unexplained);
  Problem first = problem;
  first.setup.runout.order = geometry::EccentricityOrder::first;
  const std::vector<double> all = full_jacobian(first, evaluate(first, p), K).J;
  const numerics::Columns J(all, index(problem.rows()));
  const std::size_t linear = index(problem.linear());
  const std::size_t width = linear + p.size();
  std::vector<std::size_t> others(linear);
  std::iota(others.begin(), others.end(), std::size_t{0});
  for (std::size_t c = linear + 2; c < width; ++c) others.push_back(c);
  std::vector<double> E = keep_columns(J, {linear, linear + 1});
  const std::vector<double> rest = keep_columns(J, others);
  const numerics::Columns A(rest, J.rows);
  numerics::project_out(A, numerics::gram_of(A), E);
  const std::vector<double> squares = numerics::gram_of({E, J.rows});
  const double xx = squares[0];
  const double xy = squares[1];
  const double yy = squares[3];
  const double half = 0.5 * (xx + yy);
  const double swing = std::hypot(0.5 * (xx - yy), xy);
  if (half - swing > least * least * (half + swing)) return std::nullopt;
  return 0.5 * std::atan2(2.0 * xy, xx - yy);
}

}  // namespace trochoid::identification
