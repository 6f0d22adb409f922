#include <trochoid/identification/channel_search.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/levenberg_marquardt.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace trochoid::identification {

namespace {

/// Of the starts that were looked at, so many are followed.
constexpr std::size_t most_searches = 4;
constexpr double furthest = 20.0;     ///< of a scaled unknown of the runout
constexpr double start_offset = 0.3;  ///< of the feed per tooth

bool in_range(const ChannelProblem& problem, std::span<const double> p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    if (runout_unknown(problem, i) && !(std::abs(p[i]) < furthest)) return false;
  }
  return true;
}

/// What coefficients leave of the rows, all of them free (I-27).
bool residuals_at(const ChannelSearch& search, std::span<const double> p, double size,
                  std::span<double> r) {
  if (!in_range(search.problem, p)) return false;
  const auto left = search.at(point_of(search.problem, p)).residual;
  for (std::size_t i = 0; i < r.size(); ++i) r[i] = left[i] / size;
  return true;
}

/// Whether forces of edges that differ are asked for.
bool searches_own_edges(const ChannelProblem& problem) {
  return problem.request.axial_offsets || problem.request.tilt ||
         !force::edges_alike(problem.setup);
}

/// One column of slopes. Where edges differ, forces bend within a step, as a corner takes in
/// more of its flat tip: slopes are taken from both sides.
/// @param[in,out] q      the place, back there when done
/// @param[in,out] slope  in: residuals at the place
bool slopes_at(const ChannelSearch& search, std::size_t j, double size,
               std::vector<double>& q, std::span<double> slope) {
  const double step = step_of(search.problem, j);
  const double here = q[j];
  const bool both = searches_own_edges(search.problem);
  std::vector<double> before(slope.begin(), slope.end());
  q[j] = here - step;
  bool good = !both || residuals_at(search, q, size, before);
  q[j] = here + step;
  good = good && residuals_at(search, q, size, slope);
  q[j] = here;
  for (std::size_t i = 0; i < slope.size(); ++i) {
    slope[i] = (slope[i] - before[i]) / (both ? 2 * step : step);
  }
  return good;
}

numerics::Residuals residuals_of(const ChannelSearch& search, double size) {
  return [&search, size](std::span<const double> p, std::span<double> r,
                         std::span<double> jacobian) {
    bool good = residuals_at(search, p, size, r);
    std::vector<double> q(p.begin(), p.end());
    for (std::size_t j = 0; good && j < p.size() && !jacobian.empty(); ++j) {
      const auto slope = jacobian.subspan(j * r.size(), r.size());
      std::ranges::copy(r, slope.begin());
      good = slopes_at(search, j, size, q, slope);
    }
    return good;
  };
}

/// Unknowns and the square of what they leave.
struct Tried {
  std::vector<double> p;
  double cost = 0.0;
};

Tried searched_from(const ChannelSearch& search, const std::vector<double>& start) {
  const double size = std::sqrt(
      std::inner_product(search.y.begin(), search.y.end(), search.y.begin(), 1e-300));
  const auto rows = with_prior(search.problem, {}, search.y, search.scale).b.size();
  const auto found = numerics::levenberg_marquardt(
      residuals_of(search, search.scale * size), static_cast<int>(rows), start,
      {.gradient_tolerance = 1e-16, .parameter_tolerance = 1e-9});
  return {found.p, found.final_cost};
}

bool has_turning_channels(const ChannelProblem& problem) {
  return std::ranges::any_of(problem.sensor.channels, [](const force::Channel& one) {
    return force::turns_with_tool(one.axis);
  });
}

bool alike_but_for_runout(const ChannelProblem& problem) {
  const geometry::Cutter& cutter = problem.setup.cutter;
  return geometry::equally_pitched(cutter.pitch) &&
         force::edges_alike({.cutter = cutter,
                             .runout = {},
                             .cut = problem.setup.cut,
                             .chip = problem.setup.chip});
}

/// Whether teeth can be renumbered without changing anything but names.
bool can_renumber(const ChannelProblem& problem) {
  const ChannelRequest& q = problem.request;
  const geometry::Runout& given = problem.setup.runout;
  if (problem.free_phases.empty() || !alike_but_for_runout(problem)) return false;
  if (has_turning_channels(problem) && !q.sensor_free) return false;
  const bool offsets = finds_offsets(q.runout) || geometry::equal_offsets(given);
  const bool centre = finds_eccentricity(q.runout) || given.eccentricity == 0.0;
  const bool upright = q.tilt || given.tilt == 0.0;
  const auto& a = given.axial_offsets;
  const bool level = q.axial_offsets || std::ranges::all_of(a, [&](double offset) {
                       return offset == a.front();
                     });
  return offsets && centre && upright && level;
}

/// Angles from `from` on, `count` of them over `range`.
std::vector<double> spread(double from, double range, int count) {
  std::vector<double> out(static_cast<std::size_t>(count));
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = from + range * static_cast<double>(i) / count;
  }
  return out;
}

/// A phase and an angle of the sensor, and what they leave of one record.
struct Looked {
  double phase = 0.0;
  double sensor = 0.0;
  double rss = 0.0;
};

/// A block of about as many angles as it takes to tell a phase.
ChannelProblem thinned(const ChannelProblem& problem, std::size_t b) {
  constexpr std::size_t enough = 120;
  ChannelProblem out = problem;
  const ChannelBlock& block = problem.blocks[b];
  const std::size_t step = std::max<std::size_t>(block.angles() / enough, 1);
  out.blocks = {every(block, problem.channels(), step)};
  out.free_phases = {0};
  return out;
}

/// @brief All phases, and angles of the sensor where that is free, of one record.
std::vector<Looked> look_at_phases(const ChannelProblem& problem, std::size_t b,
                                   const ChannelPoint& start) {
  const ChannelProblem one = thinned(problem, b);
  const auto N = static_cast<int>(problem.teeth());
  const bool a_pitch = can_renumber(problem) && geometry::runs_true(start.runout);
  const double range = a_pitch ? unit::turn / N : unit::turn;
  const int count = a_pitch ? 24 : std::max(72, 12 * N);
  const bool sensor_free = problem.request.sensor_free && has_turning_channels(problem);
  const auto sensors = sensor_free ? spread(-0.5 * unit::turn, unit::turn, 24)
                                   : std::vector{start.sensor};
  ChannelPoint at{.runout = start.runout, .phase = {0.0}, .sensor = 0.0};
  std::vector<Looked> out;
  for (const double phase : spread(-0.5 * range, range, count)) {
    at.phase[0] = phase;
    at.sensor = sensor_free ? 0.0 : start.sensor;
    const auto along = block_rows(one, at, 0);
    at.sensor += 0.25 * unit::turn;
    const auto across = sensor_free ? block_rows(one, at, 0) : along;
    for (const double sensor : sensors) {
      std::vector<double> rows = along;
      for (std::size_t i = 0; sensor_free && i < rows.size(); ++i) {
        const std::size_t k = i / problem.columns % problem.channels();
        if (!force::turns_with_tool(problem.sensor.channels[k].axis)) continue;
        rows[i] = std::cos(sensor) * along[i] + std::sin(sensor) * across[i];
      }
      const auto fit =
          solved({std::move(rows), one.blocks[0].y}, channel_rank_tolerance);
      out.push_back({phase, sensor, fit.rss});
    }
  }
  std::ranges::sort(out, {}, &Looked::rss);
  return out;
}

/// Runouts from which to search.
std::vector<geometry::Runout> runouts_to_try(const ChannelProblem& problem) {
  const ChannelRequest& q = problem.request;
  const geometry::Runout& given = problem.setup.runout;
  std::vector<geometry::Runout> out{given};
  if (!finds_offsets(q.runout) && !finds_eccentricity(q.runout)) return out;
  geometry::Runout none = given;
  none.radial_offsets.clear();
  none.eccentricity = 0.0;
  if (!geometry::runs_true(given)) out.push_back(none);
  const auto N = problem.teeth();
  const double amount = start_offset * problem.length;
  for (const double turned : {0.0, 0.25, 0.5, 0.75}) {
    geometry::Runout one = none;
    if (finds_offsets(q.runout)) {
      one.radial_offsets.assign(N, 0.0);
      for (std::size_t j = 0; j < N; ++j) {
        const double share = static_cast<double>(j) / static_cast<double>(N);
        one.radial_offsets[j] = amount * std::cos(unit::turn * (share - turned));
      }
    } else {
      one.eccentricity = amount;
      one.angle = unit::turn * turned;
    }
    if (N == 2 && (turned == 0.25 || turned == 0.75)) continue;
    out.push_back(std::move(one));
  }
  return out;
}

/// Whether two places have the same phase and angle of the sensor, about.
bool near(const Looked& a, const Looked& b) {
  constexpr double close = 0.3;  // [rad]
  return std::abs(std::remainder(a.phase - b.phase, unit::turn)) < close &&
         std::abs(std::remainder(a.sensor - b.sensor, unit::turn)) < close;
}

/// The best of those that are not near one another.
std::vector<Looked> best_apart(const std::vector<Looked>& looked, std::size_t most) {
  std::vector<Looked> out;
  for (const Looked& one : looked) {
    if (out.size() == most) break;
    const auto like_it = [&](const Looked& other) { return near(one, other); };
    if (std::ranges::none_of(out, like_it)) out.push_back(one);
  }
  return out;
}

/// @brief Phases that suit a runout best: the best few of the first record, the best one
/// of the others. They hardly depend on the runout.
std::vector<ChannelPoint> at_best_phases(const ChannelProblem& problem,
                                         const geometry::Runout& runout) {
  const std::size_t most = problem.request.sensor_free ? 6 : 2;
  std::vector<ChannelPoint> out{
      {.runout = runout,
       .phase = std::vector<double>(problem.blocks.size(),
                                    problem.request.phase.value_or(0.0)),
       .sensor = problem.sensor.angle}};
  for (const std::size_t b : problem.free_phases) {
    const auto best = best_apart(look_at_phases(problem, b, out[0]), most);
    if (b == problem.free_phases[0]) out.resize(best.size(), out[0]);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const Looked& place = b == problem.free_phases[0] ? best[k] : best[0];
      out[k].phase[b] = place.phase;
      if (b == problem.free_phases[0]) out[k].sensor = place.sensor;
    }
  }
  return out;
}

/// @brief The best of some starts, but of those near one another in phase and sensor two at
/// most: mirrored answers leave nearly as little until they are searched.
std::vector<Tried> few_of_each_kind(const ChannelProblem& problem,
                                    const std::vector<Tried>& sorted) {
  const std::size_t most =
      problem.request.sensor_free ? 2 * most_searches : most_searches;
  const auto place = [&](const Tried& one) {
    const ChannelPoint point = point_of(problem, one.p);
    const auto& free = problem.free_phases;
    return Looked{free.empty() ? 0.0 : point.phase[free[0]], point.sensor, 0.0};
  };
  std::vector<Tried> out;
  for (const Tried& one : sorted) {
    const auto alike = std::ranges::count_if(
        out, [&](const Tried& other) { return near(place(one), place(other)); });
    if (alike < 2 && out.size() < most) out.push_back(one);
  }
  return out;
}

/// @brief Points from which to search, the best first.
std::vector<Tried> starts_of(const ChannelSearch& search) {
  const ChannelProblem& problem = search.problem;
  std::vector<Tried> out;
  if (problem.request.near_given) {
    const ChannelPoint given{.runout = problem.setup.runout,
                             .phase = std::vector<double>(problem.blocks.size(), 0.0),
                             .sensor = problem.sensor.angle};
    return {{parameters_of(problem, given), 0.0}};
  }
  const auto runouts = runouts_to_try(problem);
  const auto places = at_best_phases(problem, runouts.front());
  for (const geometry::Runout& runout : runouts) {
    for (ChannelPoint one : places) {
      one.runout = runout;
      const auto p = parameters_of(problem, one);
      out.push_back({p, search.at(point_of(problem, p)).rss});
    }
  }
  std::ranges::sort(out, {}, &Tried::cost);
  return few_of_each_kind(problem, out);
}

/// @brief Name the teeth so that the phase of the first record lies within half a pitch of
/// 0 where that is a matter of names.
/// @return whether they were renamed
bool rename_teeth(const ChannelProblem& problem, std::vector<double>& p) {
  ChannelPoint point = point_of(problem, p);
  bool renamed = false;
  if (can_renumber(problem)) {
    const auto N = static_cast<int>(problem.teeth());
    const double pitch = unit::turn / N;
    const double passed = std::floor(point.phase[problem.free_phases[0]] / pitch + 0.5);
    const int shift = ((static_cast<int>(passed) % N) + N) % N;
    for (const std::size_t b : problem.free_phases) point.phase[b] -= passed * pitch;
    for (auto* offsets : {&point.runout.radial_offsets, &point.runout.axial_offsets}) {
      if (!offsets->empty())
        std::rotate(offsets->begin(), offsets->begin() + shift, offsets->end());
    }
    point.runout.angle -= passed * pitch;
    point.runout.tilt_angle -= passed * pitch;
    if (problem.request.sensor_free) point.sensor -= passed * pitch;
    renamed = passed != 0.0;
  }
  const auto wrap = [](double& angle) { angle = std::remainder(angle, unit::turn); };
  for (std::size_t i = can_renumber(problem) ? 1 : 0; i < problem.free_phases.size();
       ++i) {
    wrap(point.phase[problem.free_phases[i]]);
  }
  if (problem.request.sensor_free) wrap(point.sensor);
  p = parameters_of(problem, point);
  return renamed;
}

}  // namespace

Equations with_prior(const ChannelProblem& problem, std::vector<double> A,
                     std::span<const double> y, double scale) {
  Equations out{std::move(A), {y.begin(), y.end()}};
  for (double& a : out.A) a *= scale;
  for (double& b : out.b) b *= scale;
  const auto& prior = problem.request.prior;
  const std::size_t columns = out.A.size() / std::max<std::size_t>(y.size(), 1);
  for (std::size_t c = 0; c < prior.size(); ++c) {
    if (!prior[c]) continue;
    std::vector<double> row(columns, 0.0);
    row[c] = 1.0 / prior[c]->sd;
    out.A.insert(out.A.end(), row.begin(), row.end());
    out.b.push_back(prior[c]->mean / prior[c]->sd);
  }
  return out;
}

numerics::Combinations solved(const Equations& equations, double tolerance) {
  return numerics::known_combinations(
      equations.A, static_cast<int>(equations.A.size() / equations.b.size()),
      equations.b, tolerance);
}

numerics::Combinations ChannelSearch::at(const ChannelPoint& point) const {
  return solved(with_prior(problem, rows_at(problem, point), y, scale),
                channel_rank_tolerance);
}

namespace {

/// The same teeth with numbers that are `by` higher, the sensor where it was.
ChannelPoint renumbered(const ChannelProblem& problem, ChannelPoint point, int by) {
  const auto N = static_cast<int>(problem.teeth());
  const double turn = by * unit::turn / N;
  for (const std::size_t b : problem.free_phases) point.phase[b] += turn;
  for (auto* offsets : {&point.runout.radial_offsets, &point.runout.axial_offsets}) {
    if (offsets->empty()) continue;
    std::rotate(offsets->begin(), offsets->begin() + (N - by), offsets->end());
  }
  point.runout.angle += turn;
  point.runout.tilt_angle += turn;
  return point;
}

/// @brief Of minima that leave the same the one with the signs of a cut.
///
/// Where teeth are alike and u, v stand fixed to tooth 1, other numbers of the teeth turn the
/// coefficients: the channels are the same with K_t as K_r, or both negative. A torque
/// would tell.
std::vector<double> with_signs_of_a_cut(const ChannelSearch& search,
                                        const std::vector<double>& p) {
  constexpr double as_little = 1.01;
  const ChannelProblem& problem = search.problem;
  const bool turned = has_turning_channels(problem) && !problem.request.sensor_free;
  if (problem.free_phases.empty() || !turned || !alike_but_for_runout(problem))
    return p;
  const ChannelPoint point = point_of(problem, p);
  const auto is_a_cut = [](const numerics::Combinations& at) {
    return at.x[0] > 0.0 && at.x[1] > 0.0;
  };
  const auto here = search.at(point);
  if (is_a_cut(here)) return p;
  for (int by = 1; by < static_cast<int>(problem.teeth()); ++by) {
    const auto q = parameters_of(problem, renumbered(problem, point, by));
    const auto there = search.at(point_of(problem, q));
    if (is_a_cut(there) && there.rss < as_little * here.rss) {
      return searched_from(search, q).p;
    }
  }
  return p;
}

}  // namespace

std::vector<double> best_unknowns(const ChannelSearch& search) {
  if (search.problem.unknowns() == 0) return {};
  constexpr double same = 1e-6;  // of what is left
  // Forces of edges that differ cost most of the time: from far away fewer will do.
  const bool roughly =
      !search.problem.request.near_given && searches_own_edges(search.problem);
  const ChannelProblem rough = roughly ? rougher(search.problem) : search.problem;
  const ChannelSearch quick{rough, values_of(rough), search.scale};
  std::optional<Tried> best;
  for (const Tried& start : starts_of(quick)) {
    Tried found = searched_from(quick, start.p);
    const bool again = best && std::abs(found.cost - best->cost) < same * best->cost;
    if (!best || found.cost < best->cost) best = std::move(found);
    if (again && !search.problem.request.sensor_free) break;  // found twice
  }
  if (roughly) best = searched_from(search, best->p);
  std::vector<double> p = with_signs_of_a_cut(search, best->p);
  if (rename_teeth(search.problem, p)) p = searched_from(search, p).p;
  return p;
}

}  // namespace trochoid::identification
