#include <trochoid/identification/problem.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/folded.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace trochoid::identification {
namespace {

using base::index;

/// The grid of a turn that serves a band: fine where angles cost little.
TurnGrid grid_of(const Problem& problem, const FoldedRun& run) {
  const int least = std::max(problem.angles, 8 * run.harmonics);
  const auto angles = static_cast<int>(std::bit_ceil(static_cast<unsigned>(least)));
  const bool sudden = enters_suddenly(problem, run, unit::turn / angles);
  const int fine = force::keeps_radius(problem.setup) && !sudden ? 4 * angles : angles;
  return {fine, std::min(run.highest, fine / 2 - 1), sudden};
}

TurnMatrix turn_of(const Problem& problem, const FoldedRun& run,
                   const force::ForceMatrix& matrix) {
  const TurnGrid grid = grid_of(problem, run);
  problem.stop.count(matrix.work(index(grid.angles)));
  return turn_matrix(matrix, grid);
}

/// Row-major, shape (n, columns), into columns that are a stride apart.
void by_columns(std::span<const double> rows, std::size_t columns, std::size_t stride,
                std::span<double> out) {
  for (std::size_t i = 0; i * columns < rows.size(); ++i) {
    for (std::size_t c = 0; c < columns; ++c) {
      out[c * stride + i] = rows[i * columns + c];
    }
  }
}

/// Less of a column than this is rounding: it acts on what is not measured alone.
constexpr double all_unmeasured = 1e-10;

/// Zero in the columns of a run what is not measured.
void leave_out(const Problem& problem, std::size_t r, std::span<double> C) {
  const FoldedRun& run = problem.runs[r];
  const std::size_t stride = index(problem.rows());
  if (measured_count(run) == 3) return;
  const auto squares = [](std::span<const double> v) { return numerics::dot(v, v); };
  for (std::size_t c = 0; c < index(problem.columns); ++c) {
    const std::span<double> column = C.subspan(c * stride, index(run.rows));
    const double whole = squares(column);
    leave_out_unmeasured(run, column);
    if (squares(column) <= all_unmeasured * all_unmeasured * whole) {
      std::ranges::fill(column, 0.0);
    }
  }
}

/// The columns of the channels; the rest is zero before.
void fill_drift(const Problem& problem, std::span<double> D) {
  const std::size_t rows = index(problem.rows());
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& run = problem.runs[r];
    if (run.drift.empty()) continue;
    by_columns(run.drift, 6, rows,
               D.subspan((index(problem.force_columns()) + 6 * r) * rows +
                         first_row(problem, r)));
  }
}

/// Whether two points have the same matrices, before resonances and phases.
bool same_matrices(const Problem& problem, std::span<const double> a,
                   std::span<const double> b) {
  const std::size_t n = index(problem.unknowns.first_resonance());
  return a.size() == b.size() && std::ranges::equal(a.first(n), b.first(n));
}

bool same_resonances(const Problem& problem, std::span<const double> a,
                     std::span<const double> b) {
  const std::size_t first = index(problem.unknowns.first_resonance());
  const std::size_t n = index(problem.unknowns.resonance_count());
  return std::ranges::equal(a.subspan(first, n), b.subspan(first, n));
}

/// What the dynamometer makes of the force of a run.
const Response& response_at(const Problem& problem, const Evaluation& at,
                            std::size_t r) {
  return at.response.empty() ? problem.runs[r].response : at.response[r];
}

/// Less damping is not believed: near a harmonic, amplitude alone would tell it. More than
/// all but that of an amplifier's low-pass is none of a spring.
constexpr std::array damping_range{0.01, 1.5};
/// A resonance is not searched further from its start than this, in ln omega.
constexpr double farthest_resonance = 1.0;

bool resonances_in_range(const Problem& problem, std::span<const double> p) {
  std::size_t i = index(problem.unknowns.first_resonance());
  for (std::size_t q = 0; q < 3; ++q) {
    if (!problem.unknowns.rings[q]) continue;
    const double zeta = problem.resonances[q]->zeta * std::exp(p[i + 1]);
    if (!(std::abs(p[i]) < farthest_resonance) || !(zeta >= damping_range[0]) ||
        !(zeta <= damping_range[1])) {
      return false;
    }
    i += 2;
  }
  return true;
}

}  // namespace

int Unknowns::runout_count() const noexcept {
  if (runout == RunoutUnknowns::offsets) return teeth - 1;
  if (runout == RunoutUnknowns::eccentricity) return direction ? 1 : 2;
  if (runout == RunoutUnknowns::both) return teeth + 1;
  return 0;
}

int Problem::drift_columns() const noexcept {
  return runs.empty() || runs.front().drift.empty() ? 0
                                                    : 6 * static_cast<int>(runs.size());
}

int Problem::rows() const noexcept {
  int sum = 0;
  for (const FoldedRun& run : runs) sum += run.rows;
  return sum;
}

Point point_of(const Problem& problem, std::span<const double> p) {
  const Unknowns& u = problem.unknowns;
  Point out{problem.setup.runout, problem.law, {}};
  if (finds_offsets(u.runout)) {
    out.runout.radial_offsets.assign(index(u.teeth), 0.0);
    for (int k = 1; k < u.teeth; ++k) {
      out.runout.radial_offsets[index(k)] = u.length * p[index(k - 1)];
    }
  }
  if (finds_eccentricity(u.runout)) {
    const std::size_t i = u.runout == RunoutUnknowns::both ? index(u.teeth - 1) : 0;
    const double c = u.direction ? p[i] * std::cos(*u.direction) : p[i];
    const double s = u.direction ? p[i] * std::sin(*u.direction) : p[i + 1];
    out.runout.eccentricity = u.length * std::hypot(c, s);
    out.runout.angle = c == 0.0 && s == 0.0 ? 0.0 : std::atan2(s, c);
  }
  if (u.exponents) {
    const std::size_t at = index(u.runout_count());
    out.law = force::with_exponents(out.law, p.subspan(at).first<3>());
  }
  std::size_t i = index(u.first_resonance());
  for (std::size_t q = 0; q < 3; ++q) {
    if (!u.rings[q]) continue;
    const Resonance& start = *problem.resonances[q];
    out.resonances[q] = {start.omega * std::exp(p[i]), start.zeta * std::exp(p[i + 1])};
    i += 2;
  }
  out.phase.assign(problem.runs.size(), problem.fixed_phase);
  for (int r = 0; r < u.phases; ++r)
    out.phase[index(r)] = p[index(u.first_phase() + r)];
  return out;
}

std::vector<double> parameters_of(const Problem& problem, const Point& point) {
  const Unknowns& u = problem.unknowns;
  std::vector<double> p;
  p.reserve(index(u.count()));
  if (finds_offsets(u.runout)) {
    const auto& s = point.runout.radial_offsets;
    for (std::size_t k = 1; k < index(u.teeth); ++k) {
      p.push_back(s.empty() ? 0.0 : (s[k] - s[0]) / u.length);
    }
  }
  if (finds_eccentricity(u.runout)) {
    const double rho = point.runout.eccentricity / u.length;
    if (u.direction) {
      p.push_back(rho * std::cos(point.runout.angle - *u.direction));
    } else {
      p.push_back(rho * std::cos(point.runout.angle));
      p.push_back(rho * std::sin(point.runout.angle));
    }
  }
  if (u.exponents) {
    const auto m = force::form(point.law).m;
    p.insert(p.end(), m.begin(), m.end());
  }
  for (std::size_t q = 0; q < 3; ++q) {
    if (!u.rings[q]) continue;
    const Resonance& start = *problem.resonances[q];
    const Resonance& here = point.resonances[q].value_or(start);
    p.push_back(std::log(here.omega / start.omega));
    p.push_back(std::log(here.zeta / start.zeta));
  }
  p.insert(p.end(), point.phase.begin(), point.phase.begin() + u.phases);
  return p;
}

bool in_range(const Problem& problem, std::span<const double> p) {
  const Unknowns& u = problem.unknowns;
  const double limit = 0.2 * problem.setup.cutter.profile.D / u.length;
  const int runout = u.runout_count();
  for (int i = 0; i < u.count(); ++i) {
    const double v = p[index(i)];
    if (!std::isfinite(v)) return false;
    if (i < runout && std::abs(v) > limit) return false;
    if (i >= runout && i < u.first_resonance() && (v >= 0.98 || v < -0.5)) return false;
  }
  return resonances_in_range(problem, p);
}

bool enters_suddenly(const Problem& problem, const FoldedRun& run, double step) {
  if (!force::form(problem.law).edge) return false;
  const geometry::Cutter& cutter = problem.setup.cutter;
  const double lag = 2.0 * run.cut.a_p * std::tan(cutter.helix) / cutter.lag_diameter;
  return lag < 2.0 * step;
}

force::Setup setup_of(const Problem& problem, const Point& point,
                      const FoldedRun& run) {
  force::Setup setup = problem.setup;
  setup.runout = point.runout;
  setup.cut = run.cut;
  return setup;
}

std::size_t first_row(const Problem& problem, std::size_t r) noexcept {
  std::size_t out = 0;
  for (std::size_t i = 0; i < r; ++i) out += index(problem.runs[i].rows);
  return out;
}

std::vector<double> read_at_phase(const Problem& problem, const Evaluation& at,
                                  std::size_t r) {
  std::vector<double> out = at_phase(at.turn[r], at.point.phase[r]);
  respond(response_at(problem, at, r), index(problem.columns), out);
  return out;
}

namespace {

/// What all three forces would be.
void fill_all_rows(const Problem& problem, const Evaluation& at, std::size_t r,
                   std::span<double> C) {
  const FoldedRun& run = problem.runs[r];
  const std::size_t stride = index(problem.rows());
  const double phase = at.point.phase[r];
  if (!run.turn_map.empty()) {
    by_columns(rows_of_turn(run, read_at_phase(problem, at, r), problem.columns),
               index(problem.columns), stride, C);
    return;
  }
  std::vector<double> phi(run.angle);
  for (double& a : phi) a += phase;
  problem.stop.count(at.matrix[r].work(phi.size()));
  if (run.band == 0) {
    at.matrix[r].evaluate_columns(phi, run.weight, C, stride);
    return;
  }
  std::vector<double> all(phi.size() * 3 * index(problem.columns));
  at.matrix[r].evaluate(phi, all);
  by_columns(rows_of(run, all, problem.columns), index(problem.columns), stride, C);
}

}  // namespace

void fill_run(const Problem& problem, const Evaluation& at, std::size_t r,
              std::span<double> C) {
  fill_all_rows(problem, at, r, C);
  leave_out(problem, r, C);
}

namespace {

/// Add the rows that readings of a run make, by the coefficients of their turn.
void add_rows(const FoldedRun& run, const Response& response, std::vector<double> turn,
              const TurnRows& to) {
  respond(response, 1, turn);
  std::vector<double> rows = rows_of_turn(run, turn, 1);
  leave_out_unmeasured(run, rows);
  for (std::size_t i = 0; i < to.out.size(); ++i) to.out[i] += to.factor * rows[i];
}

/// The axis of an unknown of the resonances.
std::size_t axis_of(const Unknowns& unknowns, int i) {
  std::size_t axis = 0;
  int passed = i / 2;  // axes that ring before that of the unknown
  while (!unknowns.rings[axis] || passed-- > 0) ++axis;
  return axis;
}

}  // namespace

void add_turn_force(const Problem& problem, const Evaluation& at, const Point& point,
                    const TurnRows& to) {
  const FoldedRun& run = problem.runs[to.run];
  const force::ForceMatrix matrix(setup_of(problem, point, run), point.law,
                                  problem.tolerance);
  const TurnGrid grid = grid_of(problem, run);
  problem.stop.count(matrix.work(index(grid.angles)));
  add_rows(run, response_at(problem, at, to.run),
           at_phase(turn_of_force(matrix, grid, to.K), point.phase[to.run]), to);
}

void add_phase_slope(const Problem& problem, const Evaluation& at, const TurnRows& to) {
  const TurnMatrix turn = times(at.turn[to.run], to.K);
  add_rows(problem.runs[to.run], response_at(problem, at, to.run),
           slope_at_phase(turn, at.point.phase[to.run]), to);
}

void add_resonance_slope(const Problem& problem, const Evaluation& at, int i,
                         const TurnRows& to) {
  const FoldedRun& run = problem.runs[to.run];
  const Response slope = slope_of_resonance(
      run.response, at.point.resonances, run.cut.Omega, axis_of(problem.unknowns, i),
      i % 2 == 0 ? ResonanceUnknown::ln_omega : ResonanceUnknown::ln_zeta);
  add_rows(run, slope, at_phase(times(at.turn[to.run], to.K), at.point.phase[to.run]),
           to);
}

numerics::Columns design(const Problem& problem, const Evaluation& at) noexcept {
  return {at.D, index(problem.rows())};
}

void evaluate(const Problem& problem, std::span<const double> p, Evaluation& at) {
  Point point = point_of(problem, p);
  const bool again = !at.matrix.empty() && same_matrices(problem, p, at.p);
  const bool rings_as_before = again && same_resonances(problem, p, at.p);
  if (!again) {
    at.matrix.clear();
    at.turn.clear();
  }
  at.p.assign(p.begin(), p.end());
  std::swap(at.point, point);
  at.tolerance = problem.tolerance;
  const std::size_t rows = index(problem.rows());
  if (at.D.size() != rows * index(problem.linear())) {
    at.D.reserve(rows * index(problem.linear() + problem.unknowns.count()));
    at.D.assign(rows * index(problem.linear()), 0.0);
    fill_drift(problem, at.D);
  }
  if (problem.unknowns.resonance_count() > 0 && !rings_as_before) {
    at.response.clear();
    for (const FoldedRun& run : problem.runs) {
      at.response.push_back(
          with_resonances(run.response, at.point.resonances, run.cut.Omega));
    }
  }
  for (std::size_t r = 0; r < problem.runs.size(); ++r) {
    const FoldedRun& run = problem.runs[r];
    if (rings_as_before && at.point.phase[r] == point.phase[r]) continue;
    if (!again) {
      at.matrix.emplace_back(setup_of(problem, at.point, run), at.point.law,
                             problem.tolerance);
      at.turn.push_back(run.turn_map.empty() ? TurnMatrix{}
                                             : turn_of(problem, run, at.matrix[r]));
    }
    const std::span<double> own =
        std::span(at.D).subspan(first_column(problem, r) * rows,  // I-19
                                index(problem.columns) * rows);
    fill_run(problem, at, r, own.subspan(first_row(problem, r)));
  }
}

Evaluation evaluate(const Problem& problem, std::span<const double> p) {
  Evaluation out;
  evaluate(problem, p, out);
  return out;
}

bool serves(const Problem& problem, const Evaluation& at, std::span<const double> p) {
  const std::size_t size = index(problem.rows()) * index(problem.linear());
  return std::ranges::equal(at.p, p) && at.D.size() == size &&
         at.tolerance == problem.tolerance;
}

std::vector<double> measured(const Problem& problem) {
  std::vector<double> out;
  out.reserve(index(problem.rows()));
  for (const FoldedRun& run : problem.runs) {
    out.insert(out.end(), run.b.begin(), run.b.end());
  }
  return out;
}

void set_groups(std::span<const Run> runs, Problem& problem) {
  problem.groups.clear();
  problem.group_of.clear();
  for (const Run& run : runs) {
    const auto found = std::ranges::find(problem.groups, run.group);
    problem.group_of.push_back(
        static_cast<std::size_t>(found - problem.groups.begin()));
    if (found == problem.groups.end()) problem.groups.push_back(run.group);
  }
}

std::size_t first_column(const Problem& problem, std::size_t r) noexcept {
  return problem.group_of.empty() ? 0
                                  : base::index(problem.columns) * problem.group_of[r];
}

bool teeth_are_alike(const Problem& problem) {
  const Unknowns& u = problem.unknowns;
  if (u.phases == 0 || !geometry::equally_pitched(problem.setup.cutter.pitch))
    return false;
  const geometry::Runout& given = problem.setup.runout;
  if (u.runout == RunoutUnknowns::both) return true;
  if (u.runout == RunoutUnknowns::offsets) return given.eccentricity == 0.0;
  if (u.runout == RunoutUnknowns::eccentricity) return geometry::equal_offsets(given);
  return geometry::runs_true(given);
}

namespace {

/// A tooth that is shorter than the longest by more feeds than this is no reference.
constexpr double too_short = 0.5;

/// By how many teeth to renumber beside `passed`: none, or to the next tooth that has the
/// stated diameter. From a tooth that hardly cuts all others would stand out, and so far
/// deeper into the stock than the radial depth says.
int to_a_long_tooth(const Unknowns& u, std::span<const double> offsets, int passed) {
  if (offsets.empty()) return 0;
  const double least = std::ranges::max(offsets) - too_short * u.length;
  for (int by = 0; by < u.teeth; ++by) {
    const int step = by % 2 == 0 ? -by / 2 : (by + 1) / 2;
    const int tooth = ((passed + step) % u.teeth + u.teeth) % u.teeth;
    if (offsets[index(tooth)] >= least) return step;
  }
  return 0;
}

}  // namespace

bool apply_gauge(const Problem& problem, std::vector<double>& p) {
  const Unknowns& u = problem.unknowns;
  if (u.phases == 0) return false;
  Point point = point_of(problem, p);
  const double pitch = unit::turn / u.teeth;
  int shift = 0;
  if (teeth_are_alike(problem)) {
    auto passed = static_cast<int>(std::floor(point.phase[0] / pitch + 0.5));
    passed += to_a_long_tooth(u, point.runout.radial_offsets, passed);
    shift = ((passed % u.teeth) + u.teeth) % u.teeth;
    for (double& phase : point.phase) phase -= passed * pitch;
  }
  if (finds_offsets(u.runout) && shift != 0) {
    auto& s = point.runout.radial_offsets;
    std::ranges::rotate(s, s.begin() + shift);
  }
  point.runout.angle -= shift * pitch;
  for (std::size_t r = 0; r < point.phase.size(); ++r) {
    double& phase = point.phase[r];
    if (r > 0 || !teeth_are_alike(problem))
      phase -= unit::turn * std::floor(phase / unit::turn + 0.5);
  }
  p = parameters_of(problem, point);
  return shift != 0;
}

}  // namespace trochoid::identification
