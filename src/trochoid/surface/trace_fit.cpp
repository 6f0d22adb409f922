#include <trochoid/surface/trace_fit.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/levenberg_marquardt.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/flat_trace.h>
#include <trochoid/surface/tooth_profiles.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <limits>
#include <numbers>

namespace trochoid::surface {
namespace {

/// Bins of a turn in which a trace is folded to look for its start, and places of it.
constexpr std::size_t folds = 512;
constexpr std::size_t shifts = 1024;
/// How much shorter a tooth is taken that writes nothing, in what is left of the trace.
constexpr double no_mark = 1e3;
/// A fit is clearly worse by this many squares of a standard error.
constexpr double clearly = 9.0;
/// Starts that are fitted.
constexpr std::size_t most_starts = 6;

/// W-7 as a problem of least squares. Unknowns: the depths [sigma], x_0 [feeds], the feed
/// [of the one before], level and slope [sigma over the trace].
class TraceProblem {
 public:
  TraceProblem(const ToothProfiles& profiles, const FlatTrace& flat, double feed)
      : profiles_(profiles),
        flat_(flat),
        feed_(feed),
        sigma_(std::max(average_roughness(flat.z), 1e-12)) {}

  [[nodiscard]] std::size_t teeth() const noexcept { return profiles_.teeth(); }
  [[nodiscard]] std::size_t unknowns() const noexcept { return teeth() + 4; }
  [[nodiscard]] double sigma() const noexcept { return sigma_; }
  [[nodiscard]] double feed(std::span<const double> p) const noexcept {
    return feed_ * p[teeth() + 1];
  }
  [[nodiscard]] std::vector<double> depths(std::span<const double> p) const {
    std::vector<double> d(p.begin(), p.begin() + static_cast<std::ptrdiff_t>(teeth()));
    for (double& value : d) value *= sigma_;
    return d;
  }

  bool operator()(std::span<const double> p, std::span<double> r,
                  std::span<double> jacobian) const {
    const std::size_t n = flat_.x.size();
    const std::size_t N = teeth();
    if (!(p[N + 1] > 0.5 && p[N + 1] < 2)) return false;
    const WrittenTurn turn = profiles_.written(depths(p), !jacobian.empty());
    const double half = 0.5 * flat_.length();
    for (std::size_t i = 0; i < n; ++i) {
      const double turns = flat_.x[i] / feed(p);
      const double u = turn_of(turns - p[N]);
      const double along = (flat_.x[i] - half) / half;
      const double S = turn.at(turn.height, u);
      r[i] = (S - flat_.z[i]) / sigma_ + p[N + 2] + along * p[N + 3];
      if (jacobian.empty()) continue;
      for (std::size_t j = 0; j < N; ++j) {
        jacobian[j * n + i] = -turn.at(turn.of_tooth[j], u);
      }
      const double dS = turn.at(turn.slope, u) / sigma_;
      jacobian[N * n + i] = -dS;
      jacobian[(N + 1) * n + i] = -dS * turns / p[N + 1];
      jacobian[(N + 2) * n + i] = 1.0;
      jacobian[(N + 3) * n + i] = along;
    }
    return true;
  }

 private:
  const ToothProfiles& profiles_;
  const FlatTrace& flat_;
  double feed_;
  double sigma_;
};

struct Start {
  double shift = 0.0;  ///< x_0 [feeds]
  std::vector<double> depth;
  double squares = 0.0;
};

/// @brief Starts by the folded trace: each tooth as deep as the trace is at its place.
std::vector<Start> starts(const ToothProfiles& profiles,
                          const std::vector<double>& trace) {
  const std::size_t n = trace.size();
  std::vector<Start> all;
  for (std::size_t i = 0; i < shifts; ++i) {
    Start one{.shift = static_cast<double>(i) / static_cast<double>(shifts)};
    const auto seen = [&](double u) {
      return trace[static_cast<std::size_t>(turn_of(u + one.shift) *
                                            static_cast<double>(n)) %
                   n];
    };
    for (std::size_t j = 0; j < profiles.teeth(); ++j) {
      one.depth.push_back(profiles.lowest(j).height - seen(profiles.lowest(j).u));
    }
    const WrittenTurn turn = profiles.written(one.depth, false);
    double mean = 0.0;
    std::vector<double> off;
    for (std::size_t k = 0; k < n; ++k) {
      const double u = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
      off.push_back(turn.at(turn.height, u) - seen(u));
      mean += off.back() / static_cast<double>(n);
    }
    for (const double e : off) one.squares += (e - mean) * (e - mean);
    all.push_back(std::move(one));
  }
  std::ranges::sort(all, {}, &Start::squares);
  std::vector<Start> apart;
  for (const Start& one : all) {
    const bool near = std::ranges::any_of(apart, [&](const Start& other) {
      return std::abs(std::remainder(one.shift - other.shift, 1.0)) <
             2.5 / static_cast<double>(shifts);
    });
    if (!near) apart.push_back(one);
    if (apart.size() == most_starts) break;
  }
  return apart;
}

std::vector<double> first_guess(const Start& start, double sigma) {
  std::vector<double> p;
  for (const double d : start.depth) p.push_back((d - start.depth.front()) / sigma);
  p.insert(p.end(), {start.shift, 1.0, -start.depth.front() / sigma, 0.0});
  return p;
}

/// What a fit knows, before it is put in words.
struct Solution {
  std::vector<double> p;
  double squares = std::numeric_limits<double>::infinity();
};

Solution solve(const TraceProblem& problem, std::size_t readings,
               std::vector<double> start) {
  const numerics::LevenbergMarquardtSummary found = numerics::levenberg_marquardt(
      [&](std::span<const double> p, std::span<double> r, std::span<double> J) {
        return problem(p, r, J);
      },
      static_cast<int>(readings), std::move(start),
      {.max_iterations = 80, .function_tolerance = 1e-14});
  return {found.p, 2 * found.final_cost};
}

/// The same marks, each by the tooth so many places on.
std::vector<double> turned(std::span<const double> p, const ToothProfiles& profiles,
                           std::size_t by) {
  const std::size_t N = profiles.teeth();
  std::vector<double> out(p.begin(), p.end());
  for (std::size_t j = 0; j < N; ++j) out[(j + by) % N] = p[j];
  out[N] += profiles.lowest(0).u - profiles.lowest(by).u;
  return out;
}

bool equally_spaced(const std::vector<double>& pitch) {
  const auto [least, most] = std::ranges::minmax(pitch);
  return most - least < 1e-9;
}

/// Covariance of the depths against one of them, and of the feed, by the teeth that write.
struct Errors {
  std::vector<double> of_depths;  ///< row-major, shape (teeth, teeth) [m^2]
  double of_feed = 0.0;           ///< variance [m^2]
  int freedom = 1;
  double correlated = 1.0;
  double rms = 0.0;  ///< [m]
  bool known = false;
};

Errors errors_at(const TraceProblem& problem, const Solution& found,
                 std::size_t readings, const std::vector<bool>& writes,
                 std::size_t deepest) {
  const std::size_t N = problem.teeth();
  std::vector<double> r(readings);
  std::vector<double> J(readings * problem.unknowns());
  problem(found.p, r, J);
  Errors out;
  out.correlated = readings_as_one(r);
  std::vector<std::size_t> kept;  // all but the depths that are against the deepest, or
  std::vector<double> columns;    // not seen
  for (std::size_t j = 0; j < problem.unknowns(); ++j) {
    if (j < N && (!writes[j] || j == deepest)) continue;
    kept.push_back(j);
    const auto from = J.begin() + static_cast<std::ptrdiff_t>(j * readings);
    columns.insert(columns.end(), from, from + static_cast<std::ptrdiff_t>(readings));
  }
  const numerics::LeastSquares fit =
      numerics::least_squares(numerics::Columns(columns, readings), r, 1e-10);
  const auto n = static_cast<double>(readings);
  const auto k = kept.size();
  out.freedom = std::max(1, static_cast<int>(n / out.correlated) - static_cast<int>(k));
  out.rms = problem.sigma() * std::sqrt(found.squares / n);
  out.of_depths.assign(N * N, 0.0);
  if (fit.inverse_gram.empty()) return out;
  out.known = true;
  const double s2 =
      found.squares / std::max(1.0, n - static_cast<double>(k)) * out.correlated;
  const auto covariance = [&](std::size_t a, std::size_t b) {
    return s2 * fit.inverse_gram[a * k + b];
  };
  for (std::size_t a = 0; a < k; ++a) {
    if (kept[a] == N + 1) {
      const double unit = problem.feed(found.p) / found.p[N + 1];
      out.of_feed = unit * unit * covariance(a, a);
    }
    for (std::size_t b = 0; b < k; ++b) {
      if (kept[a] >= N || kept[b] >= N) continue;
      out.of_depths[kept[a] * N + kept[b]] =
          problem.sigma() * problem.sigma() * covariance(a, b);
    }
  }
  return out;
}

/// @param order  of the teeth, the first one first
std::vector<OffsetWave> waves_of(const std::vector<double>& depth, const Errors& errors,
                                 const std::vector<std::size_t>& order) {
  const std::size_t N = depth.size();
  std::vector<OffsetWave> out;
  for (std::size_t k = 1; 2 * k <= N; ++k) {
    const double by = (2 * k == N ? 1.0 : 2.0) / static_cast<double>(N);
    std::vector<std::complex<double>> weight;
    std::complex<double> sum;
    for (std::size_t j = 0; j < N; ++j) {
      weight.push_back(by * std::polar(1.0, unit::turn * static_cast<double>(k * j) /
                                                static_cast<double>(N)));
      sum += weight.back() * depth[order[j]];
    }
    const double size = std::abs(sum);
    const std::complex<double> way = size > 0 ? std::conj(sum) / size : 1.0;
    double along = 0.0;
    double across = 0.0;
    for (std::size_t a = 0; a < N; ++a) {
      for (std::size_t b = 0; b < N; ++b) {
        const double c = errors.of_depths[order[a] * N + order[b]];
        along += c * (way * weight[a]).real() * (way * weight[b]).real();
        across += c * (way * weight[a]).imag() * (way * weight[b]).imag();
      }
    }
    const double phase = std::arg(sum) / static_cast<double>(k);
    const double arm = static_cast<double>(k) * std::max(size, 1e-150);
    out.push_back({static_cast<int>(k), estimate(size, along, errors.freedom),
                   estimate(phase, across / (arm * arm), errors.freedom)});
  }
  return out;
}

/// @brief Which teeth the trace shows: without their marks it would be fitted clearly worse.
///
/// The flanks of a straight edge are parallel: a tooth that is just too short to write can
/// stand in for a part of the mark of another.
std::vector<bool> that_write(const TraceProblem& problem, const Solution& found,
                             std::size_t readings, double correlated) {
  std::vector<double> r(readings);
  std::vector<bool> out;
  for (std::size_t j = 0; j < problem.teeth(); ++j) {
    std::vector<double> p = found.p;
    p[j] -= no_mark;
    problem(p, r, {});
    double squares = 0.0;
    for (const double e : r) squares += e * e;
    out.push_back((squares / found.squares - 1) * static_cast<double>(readings) >
                  clearly * correlated);
  }
  return out;
}

/// What a solution says of the teeth, in some order.
struct Teeth {
  const std::vector<double>& depth;  ///< [m]
  const std::vector<double>& share;  ///< of the turn
  const std::vector<bool>& writes;
  std::vector<std::size_t> order = {};
  std::size_t deepest = 0;
};

std::vector<ToothDepth> told_of(const Teeth& teeth, const ToothProfiles& profiles,
                                const Errors& errors) {
  const std::size_t N = teeth.depth.size();
  const double most = teeth.depth[teeth.deepest];
  std::vector<ToothDepth> out;
  double widest = 0.0;
  for (const std::size_t j : teeth.order) {
    ToothDepth& tooth = out.emplace_back();
    tooth.share = teeth.share[j];
    tooth.writes = teeth.writes[j];
    if (!tooth.writes) continue;
    tooth.offset =
        estimate(teeth.depth[j] - most, errors.of_depths[j * N + j], errors.freedom);
    widest = std::max(widest, tooth.offset.high - tooth.offset.value);
  }
  for (std::size_t i = 0; i < N; ++i) {
    const std::size_t j = teeth.order[i];
    if (out[i].writes) continue;
    out[i].at_most = teeth.depth[j] + profiles.missing(teeth.depth, j) - most + widest;
  }
  return out;
}

/// A trace and its fit, before they are put together.
struct Fitted {
  const ToothProfiles& profiles;
  const TraceProblem& problem;
  const FlatTrace& flat;
  const Solution& solution;
  std::vector<bool> writes;
  bool numbered = false;
};

/// Why a fit is none; empty: it is one.
std::string refused(const Fitted& fitted, const Errors& errors) {
  if (!errors.known) return "the trace does not tell the marks of its teeth apart";
  double power = 0.0;
  for (const double z : fitted.flat.z) power += z * z;
  const double flat_rms = std::sqrt(power / static_cast<double>(fitted.flat.z.size()));
  const bool none = std::ranges::none_of(fitted.writes, std::identity{});
  if (!none && errors.rms < flat_rms) return {};
  return fmt::format(
      "the marks that these teeth would leave are not on the trace: with them {:.2g} um "
      "rms are left, with a straight line {:.2g} um. Are the feed, dish_deg and "
      "corner_radius_mm right for this cut, and is x along the feed?",
      errors.rms / unit::um, flat_rms / unit::um);
}

TraceFit told(const Fitted& fitted, const Trace& trace) {
  const TraceProblem& problem = fitted.problem;
  const std::vector<double>& p = fitted.solution.p;
  const std::size_t N = problem.teeth();
  const std::vector<double> depth = problem.depths(p);
  const WrittenTurn turn = fitted.profiles.written(depth, false);
  Teeth teeth{depth, turn.share, fitted.writes};
  teeth.deepest =
      static_cast<std::size_t>(std::ranges::max_element(depth) - depth.begin());
  for (std::size_t i = 0; i < N; ++i) {
    teeth.order.push_back((i + (fitted.numbered ? 0 : teeth.deepest)) % N);
  }
  const Errors errors =
      errors_at(problem, fitted.solution, trace.x.size(), fitted.writes, teeth.deepest);
  TraceFit out{.numbered = fitted.numbered};
  out.rms = errors.rms;
  out.message = refused(fitted, errors);
  if (!out.message.empty()) return out;
  out.ok = true;
  out.teeth = told_of(teeth, fitted.profiles, errors);
  if (std::ranges::all_of(fitted.writes, std::identity{})) {
    out.waves = waves_of(depth, errors, teeth.order);
  }
  out.feed = estimate(problem.feed(p), errors.of_feed, errors.freedom);
  out.turns = fitted.flat.length() / out.feed.value;
  out.correlated = errors.correlated;
  out.Ra_measured = average_roughness(fitted.flat.z);
  out.waviness = fitted.flat.waviness;
  out.Ra = average_roughness(turn.height);
  out.Ra_alike = average_roughness(
      fitted.profiles.written(std::vector<double>(N, 0.0), false).height);
  std::vector<double> r(trace.x.size());
  problem(p, r, {});
  for (std::size_t i = 0; i < r.size(); ++i) {
    out.fitted.push_back(trace.z[i] + problem.sigma() * r[i]);
  }
  out.repeating = repeating_share(fitted.flat, r, out.feed.value);
  return out;
}

/// @brief Whether the pitch tells the teeth apart: with other numbers the fit is worse.
bool pitch_tells(const TraceProblem& problem, const ToothProfiles& profiles,
                 std::size_t readings, Solution& best) {
  std::vector<Solution> all{best};
  for (std::size_t by = 1; by < profiles.teeth(); ++by) {
    all.push_back(solve(problem, readings, turned(best.p, profiles, by)));
  }
  std::ranges::sort(all, {}, &Solution::squares);
  best = all.front();
  std::vector<double> r(readings);
  problem(best.p, r, {});
  const double worse = all[1].squares / best.squares - 1;
  return worse * static_cast<double>(readings) / readings_as_one(r) > clearly;
}

std::string why_not(const Trace& trace, double feed, std::size_t teeth) {
  if (teeth < 2) return "one tooth has no other to be compared with";
  const double turns =
      trace.x.empty() ? 0.0 : (trace.x.back() - trace.x.front()) / feed;
  if (!(turns >= fewest_turns)) {
    return fmt::format(
        "the trace is {:.3g} feeds of a turn long ({:.4g} mm each): at least {:g} are "
        "needed to see what repeats",
        turns, feed / unit::mm, fewest_turns);
  }
  const double each =
      static_cast<double>(trace.x.size()) / turns / static_cast<double>(teeth);
  if (!(each >= fewest_readings_a_tooth)) {
    return fmt::format(
        "the trace has {:.2g} readings on the mark of a tooth: at least {:g} are needed",
        each, fewest_readings_a_tooth);
  }
  return {};
}

}  // namespace

std::vector<PeriodicProfile> teeth_alone(force::Setup setup, const TraceLine& line) {
  constexpr double far_off = 0.05;  // of the diameter
  const std::size_t teeth = setup.cutter.pitch.size();
  const auto* const floor = std::get_if<FloorTrace>(&line);
  std::vector<PeriodicProfile> out;
  for (std::size_t j = 0; j < teeth; ++j) {
    std::vector<double> off(teeth, -far_off * setup.cutter.profile.D);
    off[j] = 0.0;
    setup.runout = {};
    (floor != nullptr ? setup.runout.axial_offsets : setup.runout.radial_offsets) = off;
    out.push_back(floor != nullptr
                      ? floor_profile(setup, floor->bottom, floor->y)
                      : wall_profile(setup, std::get<WallTrace>(line).height));
  }
  return out;
}

TraceFit fit_trace(const force::Setup& given, const Trace& trace) {
  TraceFit out;
  const std::size_t N = given.cutter.pitch.size();
  const double stated = static_cast<double>(N) * given.cut.f_z;
  out.message = why_not(trace, stated, N);
  if (!out.message.empty()) return out;
  const FlatTrace whole = without_line(trace);
  const double feed = feed_that_repeats(without_waviness(whole, stated), stated);
  const FlatTrace flat = without_waviness(whole, feed);
  force::Setup setup = given;
  setup.cut.f_z = feed / static_cast<double>(N);
  const ToothProfiles profiles(teeth_alone(setup, trace.line), trace.cutoff);
  if (!profiles.reach_everywhere()) {
    out.message =
        "a tooth alone would leave material standing between its marks: the "
        "feed is wider than the bottom of the tool";
    return out;
  }
  const TraceProblem problem(profiles, flat, feed);
  const std::size_t n = flat.x.size();
  Solution best;
  for (const Start& start : starts(profiles, flat.folded(feed, folds))) {
    Solution one = solve(problem, n, first_guess(start, problem.sigma()));
    if (one.squares < best.squares) best = std::move(one);
  }
  const bool numbered = N > 1 && !equally_spaced(given.cutter.pitch) &&
                        pitch_tells(problem, profiles, n, best);
  std::vector<double> r(n);
  problem(best.p, r, {});
  std::vector<bool> writes = that_write(problem, best, n, readings_as_one(r));
  for (std::size_t j = 0; j < N; ++j) {
    if (!writes[j]) best.p[j] -= no_mark;
  }
  best = solve(problem, n, best.p);
  return told({profiles, problem, flat, best, std::move(writes), numbered}, trace);
}

std::vector<FeedRoughness> roughness_at_feeds(const force::Setup& given,
                                              const Trace& trace, const TraceFit& fit) {
  const auto N = static_cast<double>(fit.teeth.size());
  const double no_depth = -no_mark * fit.Ra_measured;
  std::vector<double> depth;
  for (const ToothDepth& tooth : fit.teeth) {
    depth.push_back(tooth.writes ? tooth.offset.value : no_depth);
  }
  const std::vector<double> one_depth(depth.size(), 0.0);
  force::Setup setup = given;
  std::vector<FeedRoughness> out;
  for (int tenth = 5; tenth <= 15; ++tenth) {
    setup.cut.f_z = fit.feed.value / N * tenth / 10;
    const ToothProfiles profiles(teeth_alone(setup, trace.line), trace.cutoff);
    if (!profiles.reach_everywhere()) break;
    out.push_back({setup.cut.f_z,
                   average_roughness(profiles.written(depth, false).height),
                   average_roughness(profiles.written(one_depth, false).height)});
  }
  return out;
}

}  // namespace trochoid::surface
