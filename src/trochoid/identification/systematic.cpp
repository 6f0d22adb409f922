#include <trochoid/identification/systematic.h>

#include <trochoid/base/index.h>
#include <trochoid/base/overloaded.h>
#include <trochoid/identification/prepare.h>
#include <trochoid/identification/problem.h>
#include <trochoid/identification/spectrum.h>
#include <trochoid/identification/systematic_columns.h>
#include <trochoid/identification/uncertainty.h>
#include <trochoid/numerics/columns.h>
#include <trochoid/numerics/least_squares.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace trochoid::identification {

namespace {

using base::index;

/// Of the chance of one unknown: with nine of them tried, chance alone reaches about 8.
constexpr double clear_evidence = 25.0;
/// A fault that explains so much of what the best one does may as well be the cause.
constexpr double as_good = 0.8;
/// A fault that explains so much of what repeats turn by turn is tried against noise alone.
constexpr double most_of_excess = 0.5;
/// A part of a reading below this is no fault worth a word.
constexpr double least_fault = 0.003;
/// A column that leaves less of itself (rms) cannot be told from the others.
constexpr double separate = 1e-3;
/// Step of a depth or feed, relative.
constexpr double cut_step = 1e-4;
/// Step of a phase [rad].
constexpr double phase_step = 1e-4;

/// Rows are x, y, z by turns.
void add_part(const ComputedRows& computed, std::size_t reading, std::size_t force,
              double part, std::span<double> out) {
  std::size_t row = 0;
  for (const FoldedRun& run : computed.problem.runs) {
    for (int i = 0; i < run.rows; i += 3, row += 3) {
      if (!run.measured[reading]) continue;
      out[row + reading] += part * computed.force[row + force];
    }
  }
}

/// Change a radial depth, less, since full immersion is the most.
/// @return by how much
double change_radial_depth(geometry::Cut& cut) {
  const auto step = [](auto& milling) {
    const double by = -cut_step * milling.a_e;
    milling.a_e += by;
    return by;
  };
  return std::visit(base::Overloaded{[&](geometry::UpMilling& m) { return step(m); },
                                     [&](geometry::DownMilling& m) { return step(m); },
                                     [](const auto&) { return 0.0; }},
                    cut.engagement);
}

double change_cut(SystematicKind kind, geometry::Cut& cut) {
  if (kind == SystematicKind::radial_depth) return change_radial_depth(cut);
  double& changed = kind == SystematicKind::axial_depth ? cut.a_p : cut.f_z;
  const double by = cut_step * changed;
  changed += by;
  return by;
}

/// Difference quotient over a depth or the feed; empty: no run has it.
std::vector<double> cut_column(const ComputedRows& computed, SystematicKind kind) {
  Problem changed = computed.problem;
  std::vector<double> by;
  for (FoldedRun& run : changed.runs) by.push_back(change_cut(kind, run.cut));
  if (std::ranges::all_of(by, [](double step) { return step == 0.0; })) return {};
  std::vector<double> out =
      force_rows(changed, evaluate(changed, computed.p), computed.x);
  for (std::size_t r = 0; r < changed.runs.size(); ++r) {
    const std::size_t first = first_row(changed, r);
    for (std::size_t i = first; i < first + index(changed.runs[r].rows); ++i) {
      out[i] = by[r] == 0.0 ? 0.0 : (out[i] - computed.force[i]) / by[r];
    }
  }
  return out;
}

/// A reading that comes later by a second.
std::vector<double> delay_column(const ComputedRows& computed, std::size_t reading) {
  const Problem& problem = computed.problem;
  Problem changed = problem;
  changed.fixed_phase += phase_step;
  std::vector<double> p(computed.p.begin(), computed.p.end());
  for (int r = 0; r < problem.unknowns.phases; ++r) {
    p[index(problem.unknowns.first_phase() + r)] += phase_step;
  }
  std::vector<double> out = force_rows(changed, evaluate(changed, p), computed.x);
  std::size_t row = 0;
  for (const FoldedRun& run : problem.runs) {
    for (int i = 0; i < run.rows; ++i, ++row) {
      const bool of_reading = index(i) % 3 == reading && run.measured[reading];
      const double slope = (out[row] - computed.force[row]) / phase_step;
      out[row] = of_reading ? -run.cut.Omega * slope : 0.0;
    }
  }
  return out;
}

/// A fit as it stands, linear about its answer.
class LinearFit {
 public:
  LinearFit(const force::Setup& setup, const force::Law& law, std::span<const Run> runs,
            const Fit& fit)
      : prepared_(prepare(setup, law, runs, fit.options)) {
    if (!prepared_.refusal.empty()) return;
    Problem& problem = *prepared_.problem;
    problem.tolerance = final_tolerance;
    p_ = parameters_of(problem, {fit.runout, fit.law, fit.phase, fit.resonances});
    Evaluation at = evaluate(problem, p_);
    const numerics::LeastSquares linear =
        numerics::least_squares(design(problem, at), measured(problem), rank_tolerance);
    x_ = linear.x;
    residual_ = linear.residual;
    force_ = force_rows(problem, at, x_);
    J_ = jacobian_of(problem, std::move(at), x_);
  }

  [[nodiscard]] bool good() const { return !J_.empty(); }

  [[nodiscard]] std::vector<double> coefficients() const {
    return {x_.begin(), x_.begin() + prepared_.problem->columns};
  }

  [[nodiscard]] std::vector<double> column(const Systematic& one) const {
    return systematic_column({*prepared_.problem, p_, x_, force_}, one);
  }

  /// What one unit of a systematic makes of all unknowns, and what of its column is left.
  [[nodiscard]] numerics::LeastSquares effect(std::span<const double> column) const {
    return numerics::least_squares(
        numerics::Columns(J_, index(prepared_.problem->rows())), column,
        rank_tolerance);
  }

  [[nodiscard]] std::span<const double> residual() const { return residual_; }
  [[nodiscard]] std::span<const double> force() const { return force_; }

 private:
  Prepared prepared_;
  std::vector<double> p_;
  std::vector<double> x_;
  std::vector<double> residual_;
  std::vector<double> force_;
  std::vector<double> J_;
};

/// What the record may tell of its dynamometer.
std::vector<Systematic> tellable() {
  std::vector<Systematic> out;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      out.push_back({i == j ? SystematicKind::gain : SystematicKind::cross_talk, i, j});
    }
    out.push_back({SystematicKind::delay, i});
  }
  return out;
}

/// What a fit leaves, against which a fault must show.
struct Rest {
  double variance = 0.0;  ///< of one equation, as if all were noise [N^2]
  double chance = 0.0;    ///< as of Fit [N^2]
  double excess = 0.0;    ///< sum of squares that repeats turn by turn [N^2]
};

Rest rest_of(std::span<const Run> runs, const Fit& fit) {
  Rest out;
  double samples = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    samples += static_cast<double>(runs[r].angle.size());
    const int band = fit.options.band_harmonics;
    const Spectrum one =
        spectrum_of(runs[r], fit.fitted[r], band > 0 ? 2 * band + 1 : 0);
    for (std::size_t i = 0; i < one.rows(); ++i) {
      out.excess += one.left[i] * one.left[i] - one.scatter[i];
    }
  }
  out.excess = std::max(out.excess, 0.0);
  out.variance = fit.freedom > 0.0 ? fit.rms * fit.rms * samples / fit.freedom : 0.0;
  out.chance = std::max(fit.chance, out.variance);
  return out;
}

/// @return nothing where the column cannot be told from those of the fit
std::optional<SensorFault> tried(const LinearFit& linear, const Systematic& one,
                                 const Rest& rest) {
  const std::vector<double> column = linear.column(one);
  const numerics::LeastSquares effect = linear.effect(column);
  const double whole = numerics::dot(column, column);
  if (!(effect.rss > separate * separate * whole)) return std::nullopt;
  SensorFault out{one};
  if (one.kind == SystematicKind::delay) {
    out.size = std::sqrt(whole / numerics::dot(linear.force(), linear.force()));
  }
  out.value = numerics::dot(column, linear.residual()) / effect.rss;  // I-24
  const double gained = out.value * out.value * effect.rss;
  const double part = rest.excess > 0.0 ? std::min(gained / rest.excess, 1.0) : 0.0;
  const double left = part * rest.variance + (1.0 - part) * rest.chance;
  out.se = std::sqrt(left / effect.rss);
  out.part = part;
  // What something else leaves is not taken for a fault, however much there is of it.
  out.explained = gained / (part >= most_of_excess ? rest.variance : rest.chance);
  out.coefficients = linear.coefficients();
  for (std::size_t c = 0; c < out.coefficients.size(); ++c) {
    out.coefficients[c] -= effect.x[c] * out.value;
  }
  return out;
}

std::vector<SystematicEffect> untold_of(const LinearFit& linear) {
  std::vector<SystematicEffect> out;
  for (const SystematicKind kind :
       {SystematicKind::turn, SystematicKind::all_gains, SystematicKind::axial_depth,
        SystematicKind::radial_depth, SystematicKind::feed}) {
    const std::vector<double> column = linear.column({kind});
    if (column.empty()) continue;
    std::vector<double> x = linear.effect(column).x;  // I-24
    x.resize(linear.coefficients().size());
    out.push_back({{kind}, std::move(x)});
  }
  return out;
}

std::vector<SensorFault> faults_of(const LinearFit& linear, const Rest& rest) {
  std::vector<SensorFault> out;
  if (!(rest.variance > 0.0)) return out;
  for (const Systematic& one : tellable()) {
    if (auto fault = tried(linear, one, rest)) out.push_back(*std::move(fault));
  }
  std::ranges::stable_sort(out, std::greater(), &SensorFault::explained);
  const double best = out.empty() ? 0.0 : out.front().explained;
  std::erase_if(out, [&](const SensorFault& fault) {
    return fault.explained < std::max(clear_evidence, as_good * best) ||
           std::abs(fault.value) * fault.size < least_fault;
  });
  return out;
}

}  // namespace

std::vector<double> force_rows(const Problem& problem, const Evaluation& at,
                               std::span<const double> x) {
  std::vector<double> out(index(problem.rows()), 0.0);
  const std::size_t n = index(problem.force_columns());
  numerics::add_combination(design(problem, at).first(n), x.first(n), 1.0, out);
  return out;
}

std::vector<double> systematic_column(const ComputedRows& computed,
                                      const Systematic& one) {
  std::vector<double> out(computed.force.size(), 0.0);
  switch (one.kind) {
    case SystematicKind::gain:
    case SystematicKind::cross_talk:
      add_part(computed, one.reading, one.force, 1.0, out);
      return out;
    case SystematicKind::delay:
      return delay_column(computed, one.reading);
    case SystematicKind::all_gains:
      return {computed.force.begin(), computed.force.end()};
    case SystematicKind::turn:  // the force seen from a frame that was turned
      add_part(computed, 0, 1, 1.0, out);
      add_part(computed, 1, 0, -1.0, out);
      return out;
    case SystematicKind::axial_depth:
    case SystematicKind::radial_depth:
    case SystematicKind::feed:
      break;
  }
  return cut_column(computed, one.kind);
}

namespace {

/// A constant in one force of one run.
std::vector<double> offset_column(const Problem& problem, std::size_t r,
                                  std::size_t q) {
  const FoldedRun& run = problem.runs[r];
  std::vector<double> constant(3 * run.angle.size(), 0.0);
  for (std::size_t g = 0; g < run.angle.size(); ++g) constant[3 * g + q] = 1.0;
  const std::vector<double> rows = rows_of(run, constant, 1);
  std::vector<double> out(index(problem.rows()), 0.0);
  std::ranges::copy(rows,
                    out.begin() + static_cast<std::ptrdiff_t>(first_row(problem, r)));
  return out;
}

}  // namespace

void add_tolerances(const ComputedRows& computed, const numerics::Columns& J,
                    std::span<double> covariance) {
  const Tolerances& t = computed.problem.tolerances;
  const auto add_column = [&](std::span<const double> column, double sd) {
    const std::vector<double> x = numerics::least_squares(J, column, rank_tolerance).x;
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (std::size_t j = 0; j < x.size(); ++j) {
        covariance[i * x.size() + j] += sd * sd * x[i] * x[j];
      }
    }
  };
  const auto add = [&](const Systematic& one, const std::optional<double>& sd) {
    if (!sd) return;
    const std::vector<double> column = systematic_column(computed, one);
    if (!column.empty()) add_column(column, *sd);
  };
  for (std::size_t r = 0; r < computed.problem.runs.size(); ++r) {
    const FoldedRun& run = computed.problem.runs[r];
    for (std::size_t q = 0; q < 3; ++q) {
      if (run.measured[q] && run.offset_se[q] > 0) {
        add_column(offset_column(computed.problem, r, q), run.offset_se[q]);
      }
    }
  }
  for (std::size_t q = 0; q < 3; ++q) add({SystematicKind::gain, q, q}, t.gain);
  add({SystematicKind::turn}, t.turn);
  add({SystematicKind::axial_depth}, t.axial_depth);
  add({SystematicKind::radial_depth}, t.radial_depth);
  add({SystematicKind::feed}, t.feed);
}

Systematics systematics(const force::Setup& setup, const force::Law& law,
                        std::span<const Run> runs, const Fit& fit) {
  if (!fit.ok) return {};
  const LinearFit linear(setup, law, runs, fit);
  if (!linear.good()) return {};
  return {untold_of(linear), faults_of(linear, rest_of(runs, fit))};
}

}  // namespace trochoid::identification
