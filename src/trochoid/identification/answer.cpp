#include <trochoid/identification/answer.h>

#include <trochoid/base/estimate.h>
#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/residuals.h>
#include <trochoid/identification/turn_force.h>
#include <trochoid/numerics/student.h>

#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace trochoid::identification {
namespace {

using std::numbers::pi;
/// Of the peak force, for what is a tenth of a per mille of the noise of any record.
constexpr double interpolation_tolerance = 2e-7;
/// Fewer different angles than this are computed one by one.
constexpr std::size_t few_enough_angles = 1500;

using base::index;

/// Force at angles of the tip of tooth 1, shape (n).
std::vector<std::array<double, 3>> force_at(const force::ForceMatrix& matrix,
                                            std::span<const double> phi,
                                            std::span<const double> K) {
  std::vector<double> C(3 * K.size() * phi.size());
  matrix.evaluate(phi, C);
  std::vector<std::array<double, 3>> out(phi.size());
  for (std::size_t g = 0; g < out.size(); ++g) {
    for (std::size_t q = 0; q < 3; ++q) {
      out[g][q] = 0.0;
      for (std::size_t c = 0; c < K.size(); ++c) {
        out[g][q] += C[(3 * g + q) * K.size() + c] * K[c];
      }
    }
  }
  return out;
}

/// The same, interpolated where the angles are many and each costs a quadrature.
std::vector<std::array<double, 3>> force_of(const force::ForceMatrix& matrix,
                                            std::span<const double> phi,
                                            std::span<const double> K,
                                            bool interpolated) {
  if (!interpolated) return force_at(matrix, phi, K);
  const TurnForce turn(
      [&](std::span<const double> angles) { return force_at(matrix, angles, K); },
      interpolation_tolerance);
  std::vector<std::array<double, 3>> out;
  out.reserve(phi.size());
  for (const double angle : phi) out.push_back(turn.at(angle));
  return out;
}

/// What the rows of a run say of the force at its samples: those at the same angle share
/// it.
std::vector<std::array<double, 3>> force_of_rows(const Problem& problem,
                                                 const Evaluation& at, std::size_t r,
                                                 std::span<const double> K) {
  const FoldedRun& folded = problem.runs[r];
  std::vector<double> rows(3 * folded.angle.size());
  const std::size_t stride = index(problem.rows());
  const std::size_t first = first_column(problem, r) * stride + first_row(problem, r);
  const numerics::Columns D(std::span(at.D).subspan(first), rows.size(), stride);
  numerics::add_combination(D.first(K.size()), K, 1.0, rows);
  std::vector<std::array<double, 3>> out;
  out.reserve(folded.group.size());
  for (const std::size_t g : folded.group) {
    const double w = folded.weight[g];
    out.push_back({rows[3 * g] / w, rows[3 * g + 1] / w, rows[3 * g + 2] / w});
  }
  return out;
}

/// What a dynamometer that is not rigid reads at the samples of a run, shape (n).
std::vector<std::array<double, 3>> reading_of_run(const Problem& problem,
                                                  const Run& run, const Evaluation& at,
                                                  std::size_t r,
                                                  std::span<const double> K) {
  const std::vector<double> C = read_at_phase(problem, at, r);
  std::vector<double> turn(C.size() / K.size(), 0.0);  // shape (terms, 3)
  for (std::size_t i = 0; i < turn.size(); ++i) {
    for (std::size_t c = 0; c < K.size(); ++c) turn[i] += C[i * K.size() + c] * K[c];
  }
  std::vector<std::array<double, 3>> out;
  out.reserve(run.angle.size());
  for (const double phi : run.angle) {
    std::array<double, 3>& F = out.emplace_back();
    const std::complex<double> step = std::polar(1.0, phi);
    std::complex<double> wave = 1.0;
    for (std::size_t q = 0; q < 3; ++q) F[q] = turn[q];
    for (std::size_t i = 3; i + 5 < turn.size(); i += 6) {
      wave *= step;
      for (std::size_t q = 0; q < 3; ++q) {
        F[q] += turn[i + q] * wave.real() + turn[i + 3 + q] * wave.imag();
      }
    }
  }
  return out;
}

/// Force at every sample of a run, shape (n).
std::vector<std::array<double, 3>> force_of_run(const Problem& problem, const Run& run,
                                                const Evaluation& at, std::size_t r,
                                                std::span<const double> K) {
  const FoldedRun& folded = problem.runs[r];
  if (!folded.response.rigid()) return reading_of_run(problem, run, at, r, K);
  if (folded.band == 0 && !folded.binned) return force_of_rows(problem, at, r, K);
  std::vector<double> phi(run.angle);
  for (double& a : phi) a += at.point.phase[r];
  const bool interpolated =
      !force::keeps_radius(problem.setup) && folded.angle.size() > few_enough_angles;
  return force_of(at.matrix[r], phi, K, interpolated);
}

/// Why each unknown has no value, over those that have none.
class Reasons {
 public:
  Reasons(const Problem& problem, const Uncertainty& known, Fit& fit)
      : known_(known), names_(names_of(problem)), fit_(fit) {}

  /// Takes down the reason if it is not.
  bool determined(std::size_t i) {
    if (known_.reason[i].empty()) return true;
    refuse(names_[i], known_.reason[i]);
    return false;
  }

  /// Takes it down if it has none.
  bool has_error(std::size_t i) {
    if (known_.on_edge[i]) fit_.on_edge.push_back(names_[i]);
    return !known_.on_edge[i];
  }

  void refuse(const std::string& name, const std::string& reason) {
    fit_.unidentifiable.emplace_back(name, reason);
  }

  [[nodiscard]] double covariance(std::size_t i, std::size_t j) const {
    return known_.covariance[i * names_.size() + j];
  }
  [[nodiscard]] double se(std::size_t i) const { return std::sqrt(covariance(i, i)); }

  /// Of a 95 % interval (I-8).
  [[nodiscard]] double half_width(std::size_t i) const {
    return fit_.interval_factor * se(i);
  }

  [[nodiscard]] Estimate estimate(std::size_t i, double value) const {
    const double half = half_width(i);
    return {value, se(i), value - half, value + half};
  }

  [[nodiscard]] const std::string& reason(std::size_t i) const {
    return known_.reason[i];
  }
  [[nodiscard]] const std::string& name(std::size_t i) const { return names_[i]; }

 private:
  const Uncertainty& known_;
  std::vector<std::string> names_;
  Fit& fit_;
};

void fill_offsets(const Unknowns& u, std::size_t first, Reasons& reasons, Fit& fit) {
  for (int k = 1; k < u.teeth; ++k) {
    const std::size_t i = first + index(k - 1);
    if (reasons.determined(i) && reasons.has_error(i)) {
      fit.radial_offsets_se[index(k)] = u.length * reasons.se(i);
    }
  }
}

/// The one component of the eccentricity that the record determines.
void fill_single_direction(const Unknowns& u, std::size_t i, double e,
                           Reasons& reasons) {
  const std::string reason = fmt::format(
      "only its component rho cos(lambda - {:.3g} deg) = {:.4g} +- {:.2g} mm (95 %) "
      "makes the radii of the teeth differ",
      *u.direction / unit::deg, e * u.length / unit::mm,
      reasons.half_width(i) * u.length / unit::mm);
  reasons.refuse("eccentricity_mm", reason);
  reasons.refuse("angle_deg", reason);
}

/// @brief Why the record does not hold amount and angle of an eccentricity; empty: it
/// does. Its 95 % region must not hold zero, nor reach as far as it is from there.
std::string not_held(const Unknowns& u, std::size_t i, std::array<double, 2> e,
                     const Reasons& reasons) {
  const double xx = reasons.covariance(i, i);
  const double xy = reasons.covariance(i, i + 1);
  const double yy = reasons.covariance(i + 1, i + 1);
  const double mean = 0.5 * (xx + yy);
  const double swing = std::hypot(0.5 * (xx - yy), xy);
  const double longest = 0.5 * std::atan2(2.0 * xy, xx - yy);  // axis of the region
  const double along = e[0] * std::cos(longest) + e[1] * std::sin(longest);
  const double across = e[1] * std::cos(longest) - e[0] * std::sin(longest);
  const double wide = mean + swing;
  const double narrow = std::max(mean - swing, 1e-30);
  constexpr double region = 5.99;  // of chi squared with two degrees of freedom, 95 %
  const bool holds_zero =
      along * along / std::max(wide, 1e-30) + across * across / narrow < region;
  const bool too_long = region * wide > along * along + across * across;
  if (!holds_zero && !too_long) return "";
  return fmt::format(
      "the 95 % region of the eccentricity {}; what is known is its component rho "
      "cos(lambda - {:.3g} deg) = {:.4g} +- {:.2g} mm (95 %)",
      holds_zero ? "includes zero" : "is as long as the eccentricity itself",
      (longest + 0.5 * pi) / unit::deg, across * u.length / unit::mm,
      base::normal_interval * std::sqrt(narrow) * u.length / unit::mm);
}

/// rho and lambda from e_x and e_y by the chain rule.
void fill_eccentricity(const Unknowns& u, std::size_t i, std::array<double, 2> e,
                       Reasons& reasons, Fit& fit) {
  if (!reasons.reason(i).empty() || !reasons.reason(i + 1).empty()) {
    const std::string& why =
        reasons.reason(i).empty() ? reasons.reason(i + 1) : reasons.reason(i);
    reasons.refuse("eccentricity_mm", why);
    reasons.refuse("angle_deg", why);
    return;
  }
  const bool smooth = reasons.has_error(i);
  if (!reasons.has_error(i + 1) || !smooth) return;
  if (const std::string why = not_held(u, i, e, reasons); !why.empty()) {
    reasons.refuse("eccentricity_mm", why);
    reasons.refuse("angle_deg", why);
    return;
  }
  const double rho = std::hypot(e[0], e[1]);
  const double c = rho > 0.0 ? e[0] / rho : 1.0;
  const double s = rho > 0.0 ? e[1] / rho : 0.0;
  const double xx = reasons.covariance(i, i);
  const double xy = reasons.covariance(i, i + 1);
  const double yy = reasons.covariance(i + 1, i + 1);
  fit.eccentricity_se =
      u.length * std::sqrt(std::max(0.0, c * c * xx + 2.0 * c * s * xy + s * s * yy));
  const double l2 = u.length * u.length;
  fit.eccentricity_covariance = {l2 * xx, l2 * xy, l2 * yy};
  fit.angle_se =
      std::sqrt(std::max(0.0, s * s * xx - 2.0 * c * s * xy + c * c * yy)) / rho;
}

/// The coefficients of every group; those of the first are those of the fit.
void fill_groups(const Problem& problem, const force::Law& law,
                 std::span<const double> K, Reasons& reasons, Fit& fit) {
  const std::size_t columns = index(problem.columns);
  for (std::size_t g = 0; g < problem.groups.size(); ++g) {
    const std::size_t first = g * columns;
    Group& group = fit.groups.emplace_back(
        Group{problem.groups[g],
              {},
              force::with_coefficients(law, K.subspan(first, columns))});
    for (std::size_t r = 0; r < problem.runs.size(); ++r) {
      if (first_column(problem, r) == first) group.runs.push_back(r);
    }
    group.coefficients.resize(columns);
    for (std::size_t c = 0; c < columns; ++c) {
      if (reasons.determined(first + c)) {
        group.coefficients[c] = reasons.estimate(first + c, K[first + c]);
      }
    }
  }
  fit.law = fit.groups.front().law;
  fit.coefficients = fit.groups.front().coefficients;
}

void fill_resonances(const Problem& problem, const Point& point, Reasons& reasons,
                     Fit& fit) {
  std::size_t i = index(problem.linear() + problem.unknowns.first_resonance());
  fit.resonances = point.resonances;
  for (auto& one : fit.resonances) {
    if (!one) continue;
    if (reasons.determined(i)) one->omega_se = one->omega * reasons.se(i);
    if (reasons.determined(i + 1)) one->zeta_se = one->zeta * reasons.se(i + 1);
    i += 2;
  }
}

void fill_phases(const Problem& problem, Reasons& reasons, Fit& fit) {
  const Unknowns& u = problem.unknowns;
  const std::size_t first = index(problem.linear() + u.first_phase());
  for (std::size_t r = 0; r < index(u.phases); ++r) {
    if (!reasons.determined(first + r)) continue;
    const double se =
        std::hypot(reasons.se(first + r), problem.runs[r].lever_se);  // I-23
    if (se > pi / u.teeth) {
      reasons.refuse(
          reasons.name(first + r),
          fmt::format("its standard error of {:.3g} deg is more than half the "
                      "pitch of the teeth",
                      se / unit::deg));
    } else {
      fit.phase_se[r] = se;
    }
  }
}

}  // namespace

double equations_of(const Problem& problem, std::span<const Run> runs) {
  double count = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const FoldedRun& folded = problem.runs[r];
    const double triples = folded.band > 0
                               ? folded.rows / 3.0  // with those of the slopes
                               : static_cast<double>(runs[r].angle.size());
    count += measured_count(folded) * triples;
  }
  return count;
}

void fill_fitted(const Problem& problem, std::span<const Run> runs,
                 const Evaluation& at, const numerics::LeastSquares& linear, Fit& fit) {
  const std::span<const double> x(linear.x);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const FoldedRun& folded = problem.runs[r];
    const std::size_t n = runs[r].angle.size();
    std::array<ChannelOffset, 3> offsets{};
    if (!folded.drift.empty()) {
      const std::span<const double> own =
          x.subspan(index(problem.force_columns()) + 6 * r, 6);
      for (std::size_t q = 0; q < 3; ++q) offsets[q] = {own[2 * q], own[2 * q + 1]};
      fit.channel_offsets.push_back(offsets);
    }
    const std::span<const double> K =
        x.subspan(first_column(problem, r), index(problem.columns));
    std::vector<std::array<double, 3>>& fitted =
        fit.fitted.emplace_back(force_of_run(problem, runs[r], at, r, K));
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t q = 0; q < 3; ++q) {
        fitted[i][q] += offsets[q].constant + offsets[q].slope * slope_at(i, n);  // I-7
        if (!folded.measured[q]) fitted[i][q] = runs[r].force[i][q];
      }
    }
  }
  fill_residuals(problem, runs, linear.residual, fit);
}

void fill_estimates(const Problem& problem, std::span<const double> p,
                    std::span<const double> K, const Uncertainty& known, Fit& fit) {
  const Unknowns& u = problem.unknowns;
  const std::size_t linear = index(problem.linear());
  const Point point = point_of(problem, p);
  Reasons reasons(problem, known, fit);
  fit.freedom = known.freedom;
  fit.widening = known.widening;
  fit.interval_factor = numerics::student_t(0.975, known.quantile_freedom);  // I-8
  fill_groups(problem, point.law, K, reasons, fit);
  for (std::size_t c = index(problem.force_columns()); c < linear; ++c) {
    reasons.determined(c);
  }
  fit.runout = point.runout;
  fit.runout.radial_offsets.resize(index(u.teeth), 0.0);
  fit.radial_offsets_se.assign(index(u.teeth), std::nullopt);
  fit.chance = known.chance;
  const std::size_t first = u.runout == RunoutUnknowns::both ? index(u.teeth - 1) : 0;
  if (finds_offsets(u.runout)) fill_offsets(u, linear, reasons, fit);
  if (u.runout == RunoutUnknowns::eccentricity && u.direction) {
    fill_single_direction(u, linear, p[0], reasons);
  } else if (finds_eccentricity(u.runout)) {
    fill_eccentricity(u, linear + first, {p[first], p[first + 1]}, reasons, fit);
  }
  for (std::size_t e = 0; e < index(u.exponent_count()); ++e) {
    const std::size_t i = index(u.runout_count()) + e;
    fit.exponents.emplace_back();
    if (reasons.determined(linear + i)) {
      fit.exponents.back() = reasons.estimate(linear + i, p[i]);
    }
  }
  fit.phase = point.phase;
  fit.phase_se.assign(point.phase.size(), std::nullopt);
  fill_phases(problem, reasons, fit);
  fill_resonances(problem, point, reasons, fit);
  fit.found = found_together(problem, p, K, known);
}

void refuse_coefficients(const Problem& problem, Fit& fit) {
  const std::vector<std::string> names = names_of(problem);
  for (std::size_t c = 0; c < index(problem.force_columns()); ++c) {
    fit.unidentifiable.emplace_back(names[c], fit.message);
  }
}

void refuse_runout_of_one_tooth(Fit& fit) {
  const std::string reason =
      "a single tooth meets only marks of its own "
      "radius, so its runout changes nothing";
  if (finds_offsets(fit.options.runout)) {
    fit.unidentifiable.emplace_back("radial_offsets_mm", reason);
  }
  if (finds_eccentricity(fit.options.runout)) {
    fit.unidentifiable.emplace_back("eccentricity_mm", reason);
    fit.unidentifiable.emplace_back("angle_deg", reason);
  }
}

namespace {

using base::index;

/// An unknown, where it stands among all of them, and its unit there.
struct Placed {
  Found found;
  std::size_t column = 0;
  double unit = 1.0;
};

void add_runout(const Unknowns& u, std::span<const double> p, std::size_t first,
                std::vector<Placed>& out) {
  if (u.teeth == 1) return;  // its runout changes nothing
  std::size_t i = 0;
  const auto add = [&](FoundKind kind, std::size_t at) {
    out.push_back(
        {{.kind = kind, .at = at, .value = u.length * p[i]}, first + i, u.length});
    ++i;
  };
  for (int k = 1; finds_offsets(u.runout) && k < u.teeth; ++k) {
    add(FoundKind::offset, index(k));
  }
  // Of a single direction the other component is not known.
  if (finds_eccentricity(u.runout) && !u.direction) {
    add(FoundKind::eccentricity_x, 0);
    add(FoundKind::eccentricity_y, 0);
  }
}

/// All that may be told, known or not.
std::vector<Placed> all_of(const Problem& problem, std::span<const double> p,
                           std::span<const double> K) {
  std::vector<Placed> out;
  const std::size_t columns = index(problem.columns);
  for (std::size_t c = 0; c < index(problem.force_columns()); ++c) {
    out.push_back({{.at = c % columns, .group = c / columns, .value = K[c]}, c});
  }
  const Unknowns& u = problem.unknowns;
  const std::size_t linear = index(problem.linear());
  add_runout(u, p, linear, out);
  for (std::size_t e = 0; e < index(u.exponent_count()); ++e) {
    const std::size_t i = index(u.runout_count()) + e;
    out.push_back({{.kind = FoundKind::exponent, .at = e, .value = p[i]}, linear + i});
  }
  return out;
}

}  // namespace

FoundTogether found_together(const Problem& problem, std::span<const double> p,
                             std::span<const double> K, const Uncertainty& known) {
  std::vector<Placed> placed = all_of(problem, p, K);
  const auto has = [&](std::size_t column) {
    return known.reason[column].empty() && !known.on_edge[column];
  };
  // One component of an eccentricity without the other is no key of a case.
  std::erase_if(placed, [&](const Placed& one) {
    return !has(one.column) ||
           (one.found.kind == FoundKind::eccentricity_x && !has(one.column + 1)) ||
           (one.found.kind == FoundKind::eccentricity_y && !has(one.column - 1));
  });
  FoundTogether out;
  const std::size_t width = known.reason.size();
  for (const Placed& one : placed) {
    out.unknowns.push_back(one.found);
    for (const Placed& other : placed) {
      out.covariance.push_back(one.unit * other.unit *
                               known.covariance[one.column * width + other.column]);
    }
  }
  return out;
}

}  // namespace trochoid::identification
