#include <trochoid/identification/channel_fit.h>

#include <trochoid/identification/channel_rows.h>
#include <trochoid/identification/channel_search.h>
#include <trochoid/numerics/student.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace trochoid::identification {

namespace {

/// As channel_rank_tolerance, where slopes by differences are among the columns.
constexpr double slope_rank_tolerance = 1e-6;
constexpr double hardly_apart = 1e-2;

/// Equations at the answer, of coefficients and of what is not linear, the prior apart.
std::vector<double> full_rows(const ChannelProblem& problem, std::span<const double> p,
                              const std::vector<double>& D, std::span<const double> K) {
  const std::size_t n = problem.columns;
  const std::size_t m = D.size() / n;
  const std::size_t width = n + p.size();
  std::vector<double> J(m * width, 0.0);
  for (std::size_t i = 0; i < m; ++i) std::copy_n(&D[i * n], n, &J[i * width]);
  const auto force_at = [&](std::span<const double> q) {
    const auto rows = rows_at(problem, point_of(problem, q));
    std::vector<double> F(m, 0.0);
    for (std::size_t i = 0; i < rows.size(); ++i) F[i / n] += rows[i] * K[i % n];
    return F;
  };
  std::vector<double> q(p.begin(), p.end());
  for (std::size_t j = 0; j < p.size(); ++j) {
    const double step = step_of(problem, j);
    q[j] = p[j] + step;
    const auto up = force_at(q);
    q[j] = p[j] - step;
    const auto down = force_at(q);
    q[j] = p[j];
    for (std::size_t i = 0; i < m; ++i) {
      J[i * width + n + j] = (up[i] - down[i]) / (2.0 * step);
    }
  }
  return J;
}

/// What is known at the answer.
struct ChannelAnswer {
  std::vector<double> p;
  std::vector<double> K;  ///< where the data and the prior leave it open: one of many
  numerics::Combinations data;   ///< coefficients by the data alone, runout as found
  numerics::Combinations known;  ///< coefficients and p, with the prior
  numerics::Combinations alone;  ///< the same without
  int rank_with_prior = 0;
  double equations = 0.0;
  double rss = 0.0;     ///< of the data alone, weighted
  double factor = 1.0;  ///< of variances
};

double inner_rss_of(const ChannelProblem& problem) {
  double sum = 0.0;
  for (const ChannelBlock& block : problem.blocks) sum += block.inner_rss;
  return sum;
}

/// Let the covariance grow by the errors of the offsets that were taken out (I-24).
/// @param A  equations of `known`, data weighted by `scale`
void count_offsets(const ChannelProblem& problem, const std::vector<double>& A,
                   double scale, double tolerance, numerics::Combinations& known) {
  const std::size_t channels = problem.channels();
  std::size_t first = 0;  // row of the block
  for (const ChannelBlock& block : problem.blocks) {
    for (std::size_t k = 0; k < block.offset_se.size(); ++k) {
      if (!(block.offset_se[k] > 0.0)) continue;
      std::vector<double> b(A.size() / known.x.size(), 0.0);
      for (std::size_t i = 0; i < block.angles(); ++i) {
        b[first + i * channels + k] =
            scale * block.root[i] * block.weight[k] * block.offset_se[k];
      }
      const auto moved = solved({A, b}, tolerance).value;
      for (std::size_t i = 0; i < known.covariance.size(); ++i) {
        known.covariance[i] += moved[i / moved.size()] * moved[i % moved.size()];
      }
    }
    first += block.angles() * channels;
  }
}

/// @param search  its scale becomes what the data tell, where standard deviations are relative
ChannelAnswer answer_at(ChannelSearch& search, std::vector<double> p) {
  const ChannelProblem& problem = search.problem;
  ChannelAnswer out{.p = std::move(p)};
  const auto D = rows_at(problem, point_of(problem, out.p));
  out.data = solved({D, search.y}, channel_rank_tolerance);
  for (const ChannelBlock& block : problem.blocks) out.equations += block.equations;
  out.rss = out.data.rss + inner_rss_of(problem);
  if (!problem.request.absolute) {
    constexpr double exact = 1e-200;  // a fit that leaves nothing
    const double freedom = out.equations - static_cast<double>(out.data.rank()) -
                           static_cast<double>(out.p.size());
    out.factor = freedom > 0.0 ? std::max(out.rss / freedom, exact)
                               : problem.request.untold_variance;
    out.factor *= problem.request.widening * problem.request.widening;
    search.scale = 1.0 / std::sqrt(out.factor);
  }
  const auto with =
      solved(with_prior(problem, D, search.y, search.scale), channel_rank_tolerance);
  out.K = with.x;
  out.rank_with_prior = static_cast<int>(with.rank());
  const auto J = full_rows(problem, out.p, D, out.K);
  // Coefficients that are hardly told apart must not be lost to the error of slopes.
  const double tolerance =
      out.p.empty() ? channel_rank_tolerance
                    : std::clamp(hardly_apart / out.data.condition,
                                 channel_rank_tolerance, slope_rank_tolerance);
  const Equations all = with_prior(problem, J, search.y, search.scale);
  out.known = solved(all, tolerance);
  count_offsets(problem, all.A, search.scale, tolerance, out.known);
  std::vector<double> scaled = J;
  for (double& a : scaled) a *= search.scale;
  out.alone = solved({scaled, search.y}, tolerance);
  count_offsets(problem, scaled, search.scale, tolerance, out.alone);
  return out;
}

/// Standard error of the unknown i, where it is known alone.
std::optional<double> error_of(const numerics::Combinations& known, std::size_t i) {
  const auto at = std::ranges::find(known.pivots, i);
  if (at == known.pivots.end()) return std::nullopt;
  const auto place = static_cast<std::size_t>(at - known.pivots.begin());
  if (!known.alone(place)) return std::nullopt;
  return std::sqrt(std::max(0.0, known.covariance[place * known.rank() + place]));
}

double covariance_of(const numerics::Combinations& known, std::size_t i,
                     std::size_t j) {
  const auto place = [&](std::size_t k) {
    return static_cast<std::size_t>(std::ranges::find(known.pivots, k) -
                                    known.pivots.begin());
  };
  return known.covariance[place(i) * known.rank() + place(j)];
}

Estimate estimate_of(double value, double se, double factor) {
  return {value, se, value - factor * se, value + factor * se};
}

std::vector<std::optional<Estimate>> estimates(const numerics::Combinations& known,
                                               std::span<const double> K,
                                               double factor) {
  std::vector<std::optional<Estimate>> out(K.size());
  for (std::size_t c = 0; c < K.size(); ++c) {
    if (const auto se = error_of(known, c)) out[c] = estimate_of(K[c], *se, factor);
  }
  return out;
}

/// Sums of coefficients that are known where they are not known alone.
std::vector<KnownSum> sums_of(const ChannelProblem& problem, const ChannelAnswer& a) {
  std::vector<KnownSum> out;
  const std::size_t n = problem.columns;
  const std::size_t width = a.known.x.size();
  for (std::size_t i = 0; i < a.known.rank() && a.known.pivots[i] < n; ++i) {
    const double* w = &a.known.weights[i * width];
    const bool of_coefficients =
        std::all_of(w + n, w + width, [](double x) { return x == 0.0; });
    if (a.known.alone(i) || !of_coefficients) continue;
    out.push_back({.weights = {w, w + n},
                   .value = std::inner_product(w, w + n, a.K.begin(), 0.0),
                   .se = std::sqrt(a.known.covariance[i * a.known.rank() + i])});
  }
  return out;
}

/// Errors of an amount and an angle by those of their components.
struct PolarErrors {
  std::optional<double> amount;
  std::optional<double> angle;
  std::array<double, 3> covariance{};
};

/// @param at    amount and angle
/// @param unit  of the components
PolarErrors polar_errors(const ChannelAnswer& a, std::size_t first,
                         std::array<double, 2> at, double unit) {
  PolarErrors out;
  const double x = at[0] * std::cos(at[1]);
  const double y = at[0] * std::sin(at[1]);
  const auto sx = error_of(a.known, first);
  const auto sy = error_of(a.known, first + 1);
  const double size2 = x * x + y * y;
  if (!sx || !sy || !(size2 > 0.0)) return out;
  const double u2 = unit * unit;
  const double xx = u2 * *sx * *sx;
  const double yy = u2 * *sy * *sy;
  const double xy = u2 * covariance_of(a.known, first, first + 1);
  out.covariance = {xx, xy, yy};
  out.amount =
      std::sqrt(std::max(0.0, (x * x * xx + 2 * x * y * xy + y * y * yy) / size2));
  out.angle = std::sqrt(
      std::max(0.0, (y * y * xx - 2 * x * y * xy + x * x * yy) / (size2 * size2)));
  return out;
}

/// Scale of an unknown of the runout.
double unit_of_unknown(const ChannelProblem& problem, FoundKind kind) {
  const bool tilt = kind == FoundKind::tilt_x || kind == FoundKind::tilt_y;
  return tilt ? tilt_scale : problem.length;
}

constexpr const char* not_told = "the channels do not tell it";

/// Errors of radial or axial offsets.
void put_offset_error(const ChannelProblem& problem, const ChannelAnswer& a,
                      std::size_t i, ChannelReport& report, Fit& fit) {
  const Found unknown = *runout_unknown(problem, i);
  const bool axial = unknown.kind == FoundKind::axial_offset;
  auto& errors = axial ? report.axial_offsets_se : fit.radial_offsets_se;
  if (const auto se = error_of(a.known, problem.columns + i)) {
    errors[unknown.at] = problem.length * *se;
    return;
  }
  fit.unidentifiable.emplace_back(
      fmt::format("{}_offsets_mm[{}]", axial ? "axial" : "radial", unknown.at + 1),
      not_told);
}

/// Runout with its errors.
void put_runout(const ChannelProblem& problem, const ChannelAnswer& a,
                ChannelReport& report, Fit& fit) {
  const std::size_t N = problem.teeth();
  geometry::Runout& r = fit.runout;
  if (r.radial_offsets.empty()) r.radial_offsets.assign(N, 0.0);
  fit.radial_offsets_se.assign(N, std::nullopt);
  report.axial_offsets_se.assign(r.axial_offsets.size(), std::nullopt);
  for (std::size_t i = 0; i < a.p.size() && runout_unknown(problem, i); ++i) {
    const FoundKind kind = runout_unknown(problem, i)->kind;
    if (kind == FoundKind::axial_offset || kind == FoundKind::offset) {
      put_offset_error(problem, a, i, report, fit);
    } else if (kind == FoundKind::eccentricity_x) {
      const auto errors = polar_errors(a, problem.columns + i,
                                       {r.eccentricity, r.angle}, problem.length);
      fit.eccentricity_se = errors.amount;
      fit.angle_se = errors.angle;
      fit.eccentricity_covariance = errors.covariance;
      if (!errors.amount) fit.unidentifiable.emplace_back("eccentricity_mm", not_told);
    } else if (kind == FoundKind::tilt_x) {
      const auto errors = polar_errors(a, problem.columns + i,
                                       {std::tan(r.tilt), r.tilt_angle}, tilt_scale);
      report.tilt_se = errors.amount;
      report.tilt_angle_se = errors.angle;
      if (!errors.amount) fit.unidentifiable.emplace_back("tilt_deg", not_told);
    }
  }
}

/// Phases and the angle of the sensor, with their errors.
void put_angles(const ChannelProblem& problem, const ChannelAnswer& a,
                ChannelReport& report, Fit& fit) {
  const ChannelPoint point = point_of(problem, a.p);
  fit.phase = point.phase;
  for (const ChannelBlock& block : problem.blocks) {
    report.has_phase.push_back(!block.is_mean());
  }
  fit.phase_se.assign(fit.phase.size(), std::nullopt);
  report.sensor_angle = point.sensor;
  const std::size_t after = problem.columns + a.p.size();
  const std::size_t sensor = problem.request.sensor_free ? 1 : 0;
  const std::size_t first = after - sensor - problem.free_phases.size();
  for (std::size_t i = 0; i < problem.free_phases.size(); ++i) {
    const std::size_t b = problem.free_phases[i];
    fit.phase_se[b] = error_of(a.known, first + i);
    if (!fit.phase_se[b]) {
      fit.unidentifiable.emplace_back(fmt::format("phase_deg[{}]", b + 1), not_told);
    }
  }
  if (sensor == 1) report.sensor_se = error_of(a.known, after - 1);
}

/// Everything that is known alone, with its covariance.
FoundTogether found_together(const ChannelProblem& problem, const ChannelAnswer& a) {
  FoundTogether out;
  std::vector<std::size_t> at;
  std::vector<double> units;
  for (std::size_t i = 0; i < problem.columns + a.p.size(); ++i) {
    const bool coefficient = i < problem.columns;
    auto unknown = coefficient
                       ? std::optional(Found{.kind = FoundKind::coefficient, .at = i})
                       : runout_unknown(problem, i - problem.columns);
    if (!unknown || !error_of(a.known, i)) continue;
    const double unit = coefficient ? 1.0 : unit_of_unknown(problem, unknown->kind);
    unknown->value = coefficient ? a.K[i] : unit * a.p[i - problem.columns];
    out.unknowns.push_back(*unknown);
    at.push_back(i);
    units.push_back(unit);
  }
  for (std::size_t i = 0; i < at.size(); ++i) {
    for (std::size_t j = 0; j < at.size(); ++j) {
      out.covariance.push_back(units[i] * units[j] *
                               covariance_of(a.known, at[i], at[j]));
    }
  }
  return out;
}

/// What the model makes of one measurement, without offsets of its channels.
std::vector<double> model_of(const ChannelProblem& problem, const ChannelAnswer& a,
                             const ChannelData& data, std::size_t b) {
  ChannelProblem one = problem;
  one.blocks = {ChannelBlock{
      .cut = data.cut,
      .angle = data.angle,
      .root = std::vector<double>(std::max<std::size_t>(data.angle.size(), 1), 1.0),
      .weight = std::vector<double>(problem.channels(), 1.0)}};
  ChannelPoint point = point_of(problem, a.p);
  point.phase = {point.phase[b]};
  const auto rows = block_rows(one, point, 0);
  std::vector<double> out(data.value.size(), 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    out[i / problem.columns] += rows[i] * a.K[i % problem.columns];
  }
  return out;
}

/// Add the straight line that brings each channel nearest to what was measured.
void add_lines(const ChannelData& data, std::size_t channels,
               std::vector<double>& fitted) {
  const std::size_t n = fitted.size() / channels;
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (std::size_t k = 0; k < channels; ++k) {
    double mean = 0.0;
    double xy = 0.0;
    double xx = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(i) - middle;
      const double d = data.value[i * channels + k] - fitted[i * channels + k];
      mean += d / static_cast<double>(n);
      xy += x * d;
      xx += x * x;
    }
    for (std::size_t i = 0; i < n && xx > 0.0; ++i) {
      fitted[i * channels + k] += mean + (static_cast<double>(i) - middle) * xy / xx;
    }
  }
}

/// Forces in x, y and z have a difference as a vector.
void put_rms_of_forces(const ChannelProblem& problem, const ChannelReport& report,
                       Fit& fit) {
  const auto& channels = problem.sensor.channels;
  fit.measured = {};
  if (channels.size() != 3) return;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(channels[k].axis);
    if (axis >= 3 || fit.measured[axis]) {
      fit.measured = {};
      return;
    }
    fit.measured[axis] = true;
    fit.rms_axis[axis] = report.rms[k];
  }
  fit.rms = std::hypot(report.rms[0], report.rms[1], report.rms[2]);
}

/// Fitted values and what they leave, channel by channel.
void put_fitted(const ChannelProblem& problem, const ChannelAnswer& a,
                std::span<const ChannelData> data, ChannelReport& report, Fit& fit) {
  const std::size_t channels = problem.channels();
  std::vector<double> squares(channels, 0.0);
  std::vector<double> variance(channels, 0.0);
  double count = 0.0;
  double left = 0.0;
  double all = 0.0;
  for (std::size_t b = 0; b < data.size(); ++b) {
    std::vector<double> fitted = model_of(problem, a, data[b], b);
    if (!problem.blocks[b].drift.empty()) add_lines(data[b], channels, fitted);
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      const std::size_t k = i % channels;
      const double d = data[b].value[i] - fitted[i];
      const double v = data[b].sd[k] * data[b].sd[k];
      squares[k] += d * d;
      variance[k] += v;
      left += d * d / v;
      all += data[b].value[i] * data[b].value[i] / v;
    }
    count += static_cast<double>(fitted.size() / channels);
    report.fitted.push_back(std::move(fitted));
  }
  for (std::size_t k = 0; k < channels; ++k) {
    report.rms.push_back(std::sqrt(squares[k] / count));
    report.sd.push_back(std::sqrt(variance[k] / count));
  }
  fit.unexplained.all = all > 0.0 ? std::sqrt(left / all) : 0.0;
  fit.unexplained.in_band = fit.unexplained.all;
  put_rms_of_forces(problem, report, fit);
}

}  // namespace

Fit fit_channels(const force::Setup& setup, const force::Law& law,
                 const force::Sensor& sensor, std::span<const ChannelData> data,
                 const ChannelRequest& request) {
  const ChannelProblem problem = channel_problem(setup, law, sensor, data, request);
  ChannelSearch search{.problem = problem, .y = values_of(problem)};
  std::vector<double> p = best_unknowns(search);
  ChannelAnswer a = answer_at(search, std::move(p));
  if (!request.absolute && !request.prior.empty()) {  // the scale is known only now
    a = answer_at(search, best_unknowns(search));
  }
  Fit fit{.options = {.chip_model = request.chip_model,
                      .runout = problem.request.runout,
                      .phase = request.phase},
          .chip = problem.setup.chip,
          .law = law,
          .runout = point_of(problem, a.p).runout};
  fit.widening = request.widening;
  ChannelReport report;
  fit.freedom = a.equations - static_cast<double>(a.data.rank() + a.p.size());
  fit.interval_factor = request.absolute || !(fit.freedom > 0.0)
                            ? base::normal_interval
                            : numerics::student_t(0.975, fit.freedom);
  fit.coefficients = estimates(a.known, a.K, fit.interval_factor);
  fit.law = force::with_coefficients(law, a.K);
  fit.ok = std::ranges::any_of(fit.coefficients,
                               [](const auto& K) { return K.has_value(); });
  report.combinations = sums_of(problem, a);
  report.prior = request.prior;
  if (!request.prior.empty()) {
    report.data_alone = estimates(a.alone, a.data.x, fit.interval_factor);
  }
  report.rank_with_prior = a.rank_with_prior;
  report.weighted_rss = a.rss;
  report.variance_factor = a.factor;
  fit.rank = static_cast<int>(a.data.rank());
  fit.condition = a.alone.condition;
  put_runout(problem, a, report, fit);
  put_angles(problem, a, report, fit);
  fit.found = found_together(problem, a);
  put_fitted(problem, a, data, report, fit);
  fit.channels = std::move(report);
  return fit;
}

std::vector<FurtherUnknown> further_unknowns(const force::Setup& setup,
                                             const force::Law& law,
                                             const force::Sensor& sensor,
                                             std::span<const ChannelData> data,
                                             const ChannelRequest& request) {
  const ChannelProblem problem = channel_problem(setup, law, sensor, data, request);
  ChannelSearch search{.problem = problem, .y = values_of(problem)};
  const ChannelPoint here{
      .runout = setup.runout,
      .phase = std::vector<double>(problem.blocks.size(), request.phase.value_or(0.0)),
      .sensor = sensor.angle};
  const ChannelAnswer a = answer_at(search, parameters_of(problem, here));
  const auto D = rows_at(problem, here);
  const auto J = full_rows(problem, a.p, D, a.K);
  const std::size_t width = problem.columns + a.p.size();
  std::vector<FurtherUnknown> out;
  for (std::size_t i = 0; i < a.p.size() && runout_unknown(problem, i); ++i) {
    FurtherUnknown& one = out.emplace_back(FurtherUnknown{*runout_unknown(problem, i)});
    const double unit = unit_of_unknown(problem, one.unknown.kind);
    one.unknown.value = unit * a.p[i];
    const std::size_t column = problem.columns + i;
    const auto se = error_of(a.known, column);
    if (!se) continue;
    double size2 = 0.0;
    for (std::size_t k = column; k < J.size(); k += width) size2 += J[k] * J[k];
    const double norm = search.scale * std::sqrt(size2);
    one.angle = std::asin(std::min(1.0, 1.0 / (norm * *se)));  // I-29
    one.se = unit * *se;
  }
  return out;
}

}  // namespace trochoid::identification
