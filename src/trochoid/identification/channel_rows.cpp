#include <trochoid/base/units.h>
#include <trochoid/identification/channel_rows.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace trochoid::identification {

namespace {

/// Error of forces, relative to the largest, where edges are alike.
constexpr double channel_tolerance = 1e-9;
/// Records of more angles are folded onto one turn.
constexpr std::size_t most_channel_angles = 3000;
constexpr std::size_t bins_of_turn = 1440;
/// The same where each tooth has an edge of its own, whose forces cost more.
constexpr std::size_t most_own_angles = 480;
constexpr std::size_t own_bins_of_turn = 240;
constexpr std::size_t straight_bins_of_turn = 720;
/// Columns below this part of the largest of their class are zero: rounding must not be
/// scaled up.
constexpr double no_column = 1e-11;

std::size_t offset_count(const ChannelProblem& problem, bool found) {
  return found ? problem.teeth() - 1 : 0;
}

/// First of the unknowns of each kind.
struct Layout {
  std::size_t offsets, eccentricity, axial, tilt, phases, sensor, end;

  explicit Layout(const ChannelProblem& problem) {
    const ChannelRequest& q = problem.request;
    offsets = 0;
    eccentricity = offset_count(problem, finds_offsets(q.runout));
    axial = eccentricity + (finds_eccentricity(q.runout) ? 2 : 0);
    tilt = axial + offset_count(problem, q.axial_offsets);
    phases = tilt + (q.tilt ? 2 : 0);
    sensor = phases + problem.free_phases.size();
    end = sensor + (q.sensor_free ? 1 : 0);
  }
};

/// Whether edges run straight up, so that a whole edge enters at once.
bool enters_at_once(const geometry::Cutter& cutter) {
  return cutter.helix == 0.0;
}

/// Parts of a turn onto which a record of so many angles is folded; 0: it stays as it is.
std::size_t bins_for(const ChannelProblem& problem, std::size_t angles) {
  const ChannelRequest& q = problem.request;
  const bool straight = enters_at_once(problem.setup.cutter);
  if (q.axial_offsets || q.tilt || !force::edges_alike(problem.setup)) {
    if (angles <= most_own_angles) return 0;
    return straight ? straight_bins_of_turn : own_bins_of_turn;
  }
  return straight || angles <= most_channel_angles ? 0 : bins_of_turn;
}

void check_shapes(const ChannelData& data, std::size_t channels) {
  const std::size_t rows = data.angle.empty() ? 1 : data.angle.size();
  if (data.value.size() != rows * channels || data.sd.size() != channels ||
      (!data.offset_se.empty() && data.offset_se.size() != channels)) {
    throw std::invalid_argument(
        "channels: one value, sd and offset_se of each channel needed");
  }
}

/// Constant and slope over samples, orthonormal over weighted rows.
std::vector<std::vector<double>> drift_of(std::span<const double> root, bool slope) {
  const std::size_t n = root.size();
  std::vector<std::vector<double>> out;
  for (int power = 0; power < (slope ? 2 : 1); ++power) {
    std::vector<double> q(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / static_cast<double>(n) - 0.5;
      q[i] = root[i] * (power == 0 ? 1.0 : t);
    }
    for (const auto& other : out) {
      const double part = std::inner_product(q.begin(), q.end(), other.begin(), 0.0);
      for (std::size_t i = 0; i < n; ++i) q[i] -= part * other[i];
    }
    const double length =
        std::sqrt(std::inner_product(q.begin(), q.end(), q.begin(), 0.0));
    if (!(length > 0.0)) break;
    for (double& x : q) x /= length;
    out.push_back(std::move(q));
  }
  return out;
}

/// @brief Take the drift out of some columns that stand side by side.
/// @param width  numbers in a row of an angle
void take_drift_out(const ChannelBlock& block, std::size_t width,
                    std::span<double> rows) {
  for (const auto& course : block.drift) {
    for (std::size_t k = 0; k < width; ++k) {
      double part = 0.0;
      for (std::size_t i = 0; i < course.size(); ++i)
        part += course[i] * rows[i * width + k];
      for (std::size_t i = 0; i < course.size(); ++i)
        rows[i * width + k] -= part * course[i];
    }
  }
}

/// Take a straight line out of each channel of a record, its mean left in.
void take_slope_out(std::size_t channels, std::vector<double>& value) {
  const std::size_t n = value.size() / channels;
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (std::size_t k = 0; k < channels; ++k) {
    double xy = 0.0;
    double xx = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      const double x = static_cast<double>(i) - middle;
      xy += x * value[i * channels + k];
      xx += x * x;
    }
    for (std::size_t i = 0; i < n; ++i) {
      value[i * channels + k] -= (static_cast<double>(i) - middle) * xy / xx;
    }
  }
}

/// @brief Lay the turns of a long record over one another: of all samples in a bin their
/// mean stands for them, at their mean angle.
/// @param bins  of a turn
void fold_turns(std::size_t channels, std::size_t bins, ChannelBlock& block,
                std::vector<double>& value) {
  std::vector<double> count(bins, 0.0);
  std::vector<double> beside(bins, 0.0);
  std::vector<double> sum(bins * channels, 0.0);
  std::vector<double> squares(bins * channels, 0.0);
  const double width = unit::turn / static_cast<double>(bins);
  for (std::size_t i = 0; i < block.angle.size(); ++i) {
    const double turns = block.angle[i] / unit::turn;
    const double place = (turns - std::floor(turns)) * static_cast<double>(bins);
    const std::size_t bin = std::min(static_cast<std::size_t>(place), bins - 1);
    count[bin] += 1.0;
    beside[bin] += place - static_cast<double>(bin);
    for (std::size_t k = 0; k < channels; ++k) {
      const double y = value[i * channels + k];
      sum[bin * channels + k] += y;
      squares[bin * channels + k] += y * y;
    }
  }
  block.angle.clear();
  value.clear();
  for (std::size_t b = 0; b < bins; ++b) {
    if (count[b] == 0.0) continue;
    block.angle.push_back((static_cast<double>(b) + beside[b] / count[b]) * width);
    block.root.push_back(std::sqrt(count[b]));
    for (std::size_t k = 0; k < channels; ++k) {
      const double total = sum[b * channels + k];
      value.push_back(total / count[b]);
      const double w = block.weight[k];
      block.inner_rss +=
          w * w * std::max(0.0, squares[b * channels + k] - total * total / count[b]);
    }
  }
}

ChannelBlock block_of(const ChannelData& data, const ChannelProblem& problem) {
  const std::size_t channels = problem.channels();
  check_shapes(data, channels);
  ChannelBlock block{.cut = data.cut, .angle = data.angle};
  if (!problem.request.fit_channel_offsets) block.offset_se = data.offset_se;
  for (const double sd : data.sd) block.weight.push_back(1.0 / sd);
  std::vector<double> value = data.value;
  block.equations = static_cast<double>(value.size());
  const bool drifts = problem.request.fit_channel_offsets && !block.is_mean();
  const std::size_t bins = bins_for(problem, block.angle.size());
  const bool folded = bins > 0;
  if (folded) {
    if (drifts) take_slope_out(channels, value);
    fold_turns(channels, bins, block, value);
  } else {
    block.root.assign(std::max<std::size_t>(block.angle.size(), 1), 1.0);
  }
  if (drifts) {
    block.drift = drift_of(block.root, !folded);
    block.equations -= 2.0 * static_cast<double>(channels);
  }
  block.y = std::move(value);
  for (std::size_t i = 0; i < block.y.size(); ++i) {
    block.y[i] *= block.root[i / channels] * block.weight[i % channels];
  }
  take_drift_out(block, channels, block.y);
  return block;
}

/// Columns of which nothing is told are zero to the last bit.
void clear_rounding(std::size_t columns, std::vector<double>& rows) {
  std::vector<double> norm(columns, 0.0);
  for (std::size_t i = 0; i < rows.size(); ++i) norm[i % columns] += rows[i] * rows[i];
  for (std::size_t first = 0; first < columns; first += 3) {
    const double largest = *std::max_element(&norm[first], &norm[first] + 3);
    for (std::size_t q = first; q < first + 3; ++q) {
      if (norm[q] > no_column * no_column * largest) continue;
      for (std::size_t i = q; i < rows.size(); i += columns) rows[i] = 0.0;
    }
  }
}

}  // namespace

std::size_t ChannelProblem::unknowns() const noexcept {
  return Layout(*this).end;
}

ChannelProblem channel_problem(const force::Setup& setup, const force::Law& law,
                               const force::Sensor& sensor,
                               std::span<const ChannelData> data,
                               const ChannelRequest& request) {
  ChannelProblem problem{.setup = setup,
                         .law = law,
                         .sensor = sensor,
                         .request = request,
                         .blocks = {},
                         .columns = force::form(law).columns()};
  problem.setup.chip.model = request.chip_model;
  if (!chip::feels_runout(request.chip_model)) {
    problem.request.runout = RunoutUnknowns::none;
    problem.request.axial_offsets = false;
    problem.request.tilt = false;
  }
  if (problem.request.runout == RunoutUnknowns::none) problem.setup.runout = {};
  for (const ChannelData& one : data) {
    if (!one.angle.empty() && !request.phase) {
      problem.free_phases.push_back(problem.blocks.size());
    }
    problem.blocks.push_back(block_of(one, problem));
    problem.length = std::max(problem.length, one.cut.f_z);
  }
  return problem;
}

ChannelPoint point_of(const ChannelProblem& problem, std::span<const double> p) {
  const Layout at(problem);
  const std::size_t N = problem.teeth();
  ChannelPoint out{.runout = problem.setup.runout,
                   .phase = std::vector<double>(problem.blocks.size(),
                                                problem.request.phase.value_or(0.0)),
                   .sensor = problem.sensor.angle};
  if (at.eccentricity > at.offsets) {
    out.runout.radial_offsets.assign(N, 0.0);
    for (std::size_t j = 1; j < N; ++j) {
      out.runout.radial_offsets[j] = problem.length * p[at.offsets + j - 1];
    }
  }
  if (at.axial > at.eccentricity) {
    const double x = problem.length * p[at.eccentricity];
    const double y = problem.length * p[at.eccentricity + 1];
    out.runout.eccentricity = std::hypot(x, y);
    out.runout.angle = std::atan2(y, x);
  }
  if (at.tilt > at.axial) {
    out.runout.axial_offsets.assign(N, 0.0);
    for (std::size_t j = 1; j < N; ++j) {
      out.runout.axial_offsets[j] = problem.length * p[at.axial + j - 1];
    }
  }
  if (at.phases > at.tilt) {
    const double x = tilt_scale * p[at.tilt];
    const double y = tilt_scale * p[at.tilt + 1];
    out.runout.tilt = std::atan(std::hypot(x, y));
    out.runout.tilt_angle = std::atan2(y, x);
  }
  for (std::size_t i = 0; i < problem.free_phases.size(); ++i) {
    out.phase[problem.free_phases[i]] = p[at.phases + i];
  }
  if (at.end > at.sensor) out.sensor = p[at.sensor];
  return out;
}

std::vector<double> parameters_of(const ChannelProblem& problem,
                                  const ChannelPoint& point) {
  const Layout at(problem);
  std::vector<double> p(at.end, 0.0);
  const auto fill_offsets = [&](const std::vector<double>& offsets, std::size_t from,
                                std::size_t to) {
    for (std::size_t i = from; i < to && !offsets.empty(); ++i) {
      p[i] = (offsets[i - from + 1] - offsets[0]) / problem.length;
    }
  };
  const geometry::Runout& runout = point.runout;
  fill_offsets(runout.radial_offsets, at.offsets, at.eccentricity);
  fill_offsets(runout.axial_offsets, at.axial, at.tilt);
  if (at.axial > at.eccentricity) {
    const double rho = runout.eccentricity / problem.length;
    p[at.eccentricity] = rho * std::cos(runout.angle);
    p[at.eccentricity + 1] = rho * std::sin(runout.angle);
  }
  if (at.phases > at.tilt) {
    const double t = std::tan(runout.tilt) / tilt_scale;
    p[at.tilt] = t * std::cos(runout.tilt_angle);
    p[at.tilt + 1] = t * std::sin(runout.tilt_angle);
  }
  for (std::size_t i = 0; i < problem.free_phases.size(); ++i) {
    p[at.phases + i] = point.phase[problem.free_phases[i]];
  }
  if (at.end > at.sensor) p[at.sensor] = point.sensor;
  return p;
}

std::optional<Found> runout_unknown(const ChannelProblem& problem, std::size_t i) {
  const Layout at(problem);
  if (i < at.eccentricity) return Found{.kind = FoundKind::offset, .at = i + 1};
  if (i < at.axial) {
    return Found{.kind = i == at.eccentricity ? FoundKind::eccentricity_x
                                              : FoundKind::eccentricity_y};
  }
  if (i < at.tilt)
    return Found{.kind = FoundKind::axial_offset, .at = i - at.axial + 1};
  if (i >= at.phases) return std::nullopt;
  return Found{.kind = i == at.tilt ? FoundKind::tilt_x : FoundKind::tilt_y};
}

double step_of(const ChannelProblem& problem, std::size_t i) {
  constexpr double usual = 1e-4;
  constexpr double of_corner = 5e-3;
  constexpr double of_tilt = 0.1;
  const auto unknown = runout_unknown(problem, i);
  if (!unknown) return usual;
  const FoundKind kind = unknown->kind;
  if (kind == FoundKind::tilt_x || kind == FoundKind::tilt_y) return of_tilt;
  const bool with_axial = problem.request.axial_offsets && kind == FoundKind::offset;
  return with_axial || kind == FoundKind::axial_offset ? of_corner : usual;
}

std::vector<double> block_rows(const ChannelProblem& problem, const ChannelPoint& point,
                               std::size_t b) {
  const ChannelBlock& block = problem.blocks[b];
  force::Setup setup = problem.setup;
  setup.cut = block.cut;
  setup.runout = point.runout;
  force::Sensor sensor = problem.sensor;
  sensor.angle = point.sensor;
  const std::size_t columns = problem.columns;
  const std::size_t width = problem.channels() * columns;
  const double tolerance =
      force::edges_alike(setup) ? channel_tolerance : problem.own_tolerance;
  std::vector<double> rows;
  if (block.is_mean()) {
    rows = force::channel_means(setup, problem.law, sensor, channel_tolerance);
  } else {
    std::vector<double> phi = block.angle;
    for (double& angle : phi) angle += point.phase[b];
    rows = force::channel_columns(setup, problem.law, sensor, phi, tolerance);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i] *= block.root[i / width] * block.weight[i % width / columns];
  }
  take_drift_out(block, width, rows);
  return rows;
}

std::vector<double> rows_at(const ChannelProblem& problem, const ChannelPoint& point) {
  std::vector<double> out;
  for (std::size_t b = 0; b < problem.blocks.size(); ++b) {
    const auto rows = block_rows(problem, point, b);
    out.insert(out.end(), rows.begin(), rows.end());
  }
  clear_rounding(problem.columns, out);
  return out;
}

ChannelBlock every(const ChannelBlock& block, std::size_t channels, std::size_t step) {
  ChannelBlock few = block;
  few.angle.clear();
  few.root.clear();
  few.y.clear();
  few.drift.clear();
  for (std::size_t i = 0; i < block.angles(); i += step) {
    few.angle.push_back(block.angle[i]);
    few.root.push_back(block.root[i]);
    for (std::size_t k = 0; k < channels; ++k) {
      few.y.push_back(block.y[i * channels + k]);
    }
  }
  return few;
}

ChannelProblem rougher(const ChannelProblem& problem) {
  constexpr std::size_t enough = 80;
  constexpr double far_away = 1e-5;
  ChannelProblem out = problem;
  out.own_tolerance = far_away;
  const std::size_t channels = problem.channels();
  for (ChannelBlock& block : out.blocks) {
    const std::size_t step = block.angle.size() / enough;
    if (step < 2) continue;
    ChannelBlock few = every(block, channels, step);
    if (!block.drift.empty()) few.drift = drift_of(few.root, block.drift.size() > 1);
    take_drift_out(few, channels, few.y);
    block = std::move(few);
  }
  return out;
}

std::vector<double> values_of(const ChannelProblem& problem) {
  std::vector<double> out;
  for (const ChannelBlock& block : problem.blocks) {
    out.insert(out.end(), block.y.begin(), block.y.end());
  }
  return out;
}

}  // namespace trochoid::identification
