#include <trochoid/identification/folded.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/columns.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace trochoid::identification {
namespace {

/// Angles closer than this are the same: far above the rounding of an angle after many
/// turns, far below what changes a force.
constexpr double same_angle = 1e-9;

/// More angles than this are averaged in bins: the curvature of a force over a bin
/// changes its mean by less than 1e-6.
constexpr std::size_t most_angles = 4000;
constexpr std::size_t bins_of_many = 3600;

/// So few different angles are looked at one by one.
constexpr std::size_t few_angles = 1000;

double within_turn(double angle) noexcept {
  const double a = angle - unit::turn * std::floor(angle / unit::turn);
  return a >= unit::turn - 0.5 * same_angle ? 0.0 : a;
}

struct Groups {
  std::vector<std::size_t> of_sample;
  bool binned = false;
};

/// Bins of equal width instead of angles, numbered as they come in the turn.
Groups in_bins(std::span<const double> in_turn) {
  const auto bin_of = [](double angle) {
    return std::min(bins_of_many - 1,
                    static_cast<std::size_t>(angle / unit::turn * bins_of_many));
  };
  std::vector<std::size_t> number(bins_of_many, 0);
  for (const double angle : in_turn) number[bin_of(angle)] = 1;
  std::size_t next = 0;
  for (std::size_t& one : number) one = one == 1 ? next++ : 0;
  Groups out{{}, true};
  out.of_sample.reserve(in_turn.size());
  for (const double angle : in_turn) out.of_sample.push_back(number[bin_of(angle)]);
  return out;
}

/// How many different angles there are.
std::size_t different(std::vector<double> in_turn) {
  std::ranges::sort(in_turn);
  std::size_t count = 1;
  for (std::size_t k = 1; k < in_turn.size(); ++k) {
    if (in_turn[k] - in_turn[k - 1] > same_angle) ++count;
  }
  return count;
}

/// Groups of samples at the same angle, or nearly so if there are very many angles.
Groups groups(std::span<const double> angle) {
  const std::size_t n = angle.size();
  std::vector<double> in_turn(n);
  std::ranges::transform(angle, in_turn.begin(), within_turn);
  // Some of a long record, from all of its length, tell without sorting it.
  constexpr std::size_t some = 5 * most_angles;
  if (n > 2 * some) {
    std::vector<double> here_and_there;
    for (std::size_t i = 0; i < some; ++i) {
      here_and_there.push_back(in_turn[i * (n / some)]);
    }
    if (different(std::move(here_and_there)) > most_angles) return in_bins(in_turn);
  }
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return in_turn[i]; });
  std::vector<std::size_t> group(n);
  std::size_t current = 0;
  for (std::size_t k = 1; k < n; ++k) {
    if (in_turn[order[k]] - in_turn[order[k - 1]] > same_angle) ++current;
    group[order[k]] = current;
  }
  if (current < most_angles) return {std::move(group), false};
  return in_bins(in_turn);
}

/// Means of the samples of each group.
void take_means(const Run& run, bool drift, FoldedRun& out) {
  const std::size_t n = run.angle.size();
  const std::size_t u = 1 + *std::ranges::max_element(out.group);
  out.angle.assign(u, 0.0);
  out.weight.assign(u, 0.0);
  out.force.assign(u, {});
  out.slope.assign(drift ? u : 0, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t g = out.group[i];
    out.angle[g] += within_turn(run.angle[i]);
    out.weight[g] += 1.0;
    for (std::size_t q = 0; q < 3; ++q) {
      if (run.measured[q]) out.force[g][q] += run.force[i][q];
    }
    if (drift) out.slope[g] += slope_at(i, n);
  }
  for (std::size_t g = 0; g < u; ++g) {
    for (double& f : out.force[g]) f /= out.weight[g];
    out.angle[g] /= out.weight[g];
    if (drift) out.slope[g] /= out.weight[g];
    out.weight[g] = std::sqrt(out.weight[g]);
  }
}

WeightedAngles angles_of(const FoldedRun& run) {
  return {run.angle, run.weight};
}

void make_band(FoldedRun& run) {
  run.basis = {};
  run.band = 0;
  // With fewer samples than harmonics the band holds everything.
  const std::size_t terms = 2 * base::index(run.harmonics) + 1;
  if (run.harmonics == 0 || terms > run.angle.size()) return;
  run.basis = wave_basis(angles_of(run), run.harmonics);
  run.band = static_cast<int>(run.basis.size);
}

/// b and drift from the means.
void make_rows(bool drift, FoldedRun& run) {
  const std::size_t u = run.angle.size();
  run.rows = 3 * (run.band > 0 ? run.band : static_cast<int>(u));
  std::vector<double> F(3 * u);
  for (std::size_t g = 0; g < u; ++g) std::ranges::copy(run.force[g], &F[3 * g]);
  run.b = rows_of(run, F, 1);
  run.drift.clear();
  if (!drift) return;
  std::vector<double> E(18 * u, 0.0);  // I-7
  for (std::size_t g = 0; g < u; ++g) {
    for (std::size_t q = 0; q < 3; ++q) {
      if (!run.measured[q]) continue;
      E[18 * g + 6 * q + 2 * q] = 1.0;
      E[18 * g + 6 * q + 2 * q + 1] = run.slope[g];
    }
  }
  run.drift = rows_of(run, E, 6);
}

/// What the rows of a run already hold of the slope column, at each angle.
std::vector<double> slope_in_rows(const FoldedRun& run) {
  if (run.band == 0) return run.slope;
  const std::vector<double> c =
      coordinates(run.basis, angles_of(run), {run.slope, run.slope.size()});
  return from_coordinates(run.basis, angles_of(run), c);
}

/// The row that a slope keeps beside the groups and outside the
/// band, one a channel. Without it a slope would be read off the
/// few harmonics of a band, where it hardly shows.
void add_slope_rows(const Run& source, FoldedRun& run) {
  const std::size_t n = source.angle.size();
  const std::vector<double> known = slope_in_rows(run);
  double norm2 = 0.0;
  std::array<double, 3> product{};
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t g = run.group[i];
    const double d = slope_at(i, n) - known[g];
    norm2 += d * d;
    for (std::size_t q = 0; q < 3; ++q) {
      if (source.measured[q]) product[q] += d * source.force[i][q];
    }
  }
  const double norm = std::sqrt(norm2);
  if (norm < 1e-9) return;
  for (std::size_t q = 0; q < 3; ++q) {
    run.b.push_back(product[q] / norm);
    std::array<double, 6> row{};
    row[2 * q + 1] = source.measured[q] ? norm : 0.0;
    run.drift.insert(run.drift.end(), row.begin(), row.end());
  }
  run.rows += 3;
}

/// The rows of the slopes, which no binning changes.
void copy_slope_rows(const FoldedRun& from, FoldedRun& to) {
  const std::size_t all = from.b.size();
  const std::size_t first =
      3 * (from.band > 0 ? static_cast<std::size_t>(from.band) : from.angle.size());
  for (std::size_t row = first; row < all; ++row) {
    to.b.push_back(from.b[row]);
    to.drift.insert(to.drift.end(),
                    from.drift.begin() + static_cast<std::ptrdiff_t>(6 * row),
                    from.drift.begin() + static_cast<std::ptrdiff_t>(6 * row + 6));
    ++to.rows;
  }
}

/// @brief A fit holds the speed and finds the phase in the middle of the record, which is as
/// good as independent of it: the phase at the first sample turns about that.
/// @eq I-23 se(phase)^2 + (se(Omega)/Omega (phi_last - phi_first)/2)^2
double lever_se(const Run& run) {
  const double span = run.angle.back() - run.angle.front();
  return run.cut.Omega > 0.0 ? run.Omega_se / run.cut.Omega * 0.5 * std::abs(span)
                             : 0.0;
}

}  // namespace

int measured_count(const FoldedRun& run) noexcept {
  return static_cast<int>(std::ranges::count(run.measured, true));
}

void leave_out_unmeasured(const FoldedRun& run, std::span<double> column) {
  for (std::size_t q = 0; q < 3; ++q) {
    if (run.measured[q]) continue;
    for (std::size_t i = q; i < column.size(); i += 3) column[i] = 0.0;
  }
}

double slope_at(std::size_t i, std::size_t n) noexcept {
  return n < 2 ? 0.0 : static_cast<double>(i) / static_cast<double>(n - 1) - 0.5;
}

FoldedRun fold(const Run& run, const Options& options, const Response& response) {
  if (run.angle.size() != run.force.size() || run.angle.empty()) {
    throw std::invalid_argument("a run of " + std::to_string(run.angle.size()) +
                                " angles and " + std::to_string(run.force.size()) +
                                " forces: it needs one force for each angle");
  }
  FoldedRun out;
  out.cut = run.cut;
  out.measured = run.measured;
  out.offset_se = run.offset_se;
  out.lever_se = lever_se(run);
  Groups same = groups(run.angle);
  out.group = std::move(same.of_sample);
  out.binned = same.binned;
  take_means(run, options.fit_channel_offsets, out);
  out.harmonics = options.band_harmonics;
  out.response = response;
  if (!response.rigid()) {
    const int all = response.highest();
    out.harmonics = out.harmonics == 0 ? all : std::min(out.harmonics, all);
  }
  make_band(out);
  map_turn(out, few_angles);
  make_rows(options.fit_channel_offsets, out);
  if (options.fit_channel_offsets) add_slope_rows(run, out);
  return out;
}

FoldedRun coarsen(const FoldedRun& run, int bins) {
  const bool drift = !run.slope.empty();
  const auto count = static_cast<std::size_t>(bins);
  if (run.angle.size() <= count || !run.turn_map.empty()) return run;
  FoldedRun out;
  out.cut = run.cut;
  out.measured = run.measured;
  out.offset_se = run.offset_se;
  out.harmonics = run.harmonics;
  std::vector<double> n(count, 0.0);
  std::vector<std::array<double, 5>> sums(count, std::array<double, 5>{});
  for (std::size_t g = 0; g < run.angle.size(); ++g) {
    const double angle = within_turn(run.angle[g]);
    const auto bin =
        std::min(count - 1, static_cast<std::size_t>(angle / unit::turn * bins));
    const double w = run.weight[g] * run.weight[g];
    n[bin] += w;
    for (std::size_t q = 0; q < 3; ++q) sums[bin][q] += w * run.force[g][q];
    sums[bin][3] += w * angle;
    if (drift) sums[bin][4] += w * run.slope[g];
  }
  for (std::size_t bin = 0; bin < count; ++bin) {
    if (n[bin] == 0.0) continue;
    for (double& s : sums[bin]) s /= n[bin];
    out.angle.push_back(sums[bin][3]);
    out.weight.push_back(std::sqrt(n[bin]));
    out.force.push_back({sums[bin][0], sums[bin][1], sums[bin][2]});
    if (drift) out.slope.push_back(sums[bin][4]);
  }
  make_band(out);
  make_rows(drift, out);
  if (drift && out.band > 0) copy_slope_rows(run, out);
  return out;
}

FoldedRun from_turn(const FoldedRun& run, int harmonics) {
  if (!run.turn_map.empty()) return run;
  const bool drift = !run.slope.empty();
  FoldedRun out = run;
  out.harmonics = run.band > 0 ? std::min(run.harmonics, harmonics) : harmonics;
  make_band(out);
  map_turn(out, 0);
  make_rows(drift, out);
  if (drift) copy_slope_rows(run, out);
  return out;
}

std::vector<double> rows_of(const FoldedRun& run, std::span<const double> X,
                            int columns) {
  const std::size_t u = run.angle.size();
  const std::size_t width = 3 * static_cast<std::size_t>(columns);
  std::vector<double> out;
  if (run.band == 0) {
    out.assign(std::max(u * width, static_cast<std::size_t>(run.rows * columns)), 0.0);
    for (std::size_t g = 0; g < u; ++g) {
      for (std::size_t c = 0; c < width; ++c) {
        out[g * width + c] = run.weight[g] * X[g * width + c];
      }
    }
    return out;
  }
  std::vector<double> by_columns(width * u);
  for (std::size_t g = 0; g < u; ++g) {
    for (std::size_t c = 0; c < width; ++c) by_columns[c * u + g] = X[g * width + c];
  }
  out = coordinates(run.basis, angles_of(run), {by_columns, u});
  out.resize(std::max(out.size(), static_cast<std::size_t>(run.rows * columns)), 0.0);
  return out;
}

namespace {

using base::index;

/// Beyond this band nearly every harmonic counts, and the angles serve as well.
constexpr int widest_mapped_band = 32;

/// Harmonics beyond the band that the samples still mistake for ones within it: they
/// fall like 1/m^2, and are mistaken by one part in the number of turns.
int highest_of(int harmonics) noexcept {
  return std::max(63, 4 * harmonics - 1);
}

}  // namespace

std::vector<double> band_by_waves(const FoldedRun& run, std::size_t terms) {
  return band_by_waves(run.basis, angles_of(run), terms);
}

FoldedRun in_fewer_harmonics(const FoldedRun& run, int harmonics) {
  if (run.turn_map.empty() || !run.basis.by_root() || run.harmonics <= harmonics) {
    return run;
  }
  FoldedRun out = run;
  const std::size_t before = index(run.band);
  const std::size_t terms = 2 * index(run.highest) + 1;
  const std::size_t band = 2 * index(harmonics) + 1;
  out.harmonics = harmonics;
  out.band = static_cast<int>(band);
  out.basis.size = band;
  for (std::size_t k = 0; k < band; ++k) {
    std::copy_n(&run.basis.root[k * before], band, &out.basis.root[k * band]);
  }
  out.basis.root.resize(band * band);
  out.turn_map.resize(band * terms);
  const auto leave_out = [&](std::vector<double>& values, std::size_t width) {
    if (values.empty()) return;
    values.erase(values.begin() + static_cast<std::ptrdiff_t>(3 * band * width),
                 values.begin() + static_cast<std::ptrdiff_t>(3 * before * width));
  };
  leave_out(out.b, 1);
  leave_out(out.drift, 6);
  out.rows = static_cast<int>(out.b.size());
  return out;
}

void map_turn(FoldedRun& run, std::size_t few_angles) {
  const bool angles_serve =
      run.harmonics > widest_mapped_band || run.angle.size() <= few_angles;
  if (run.band == 0 || (run.response.rigid() && angles_serve)) return;
  // A response reads nothing beyond its last harmonic.
  run.highest =
      run.response.rigid() ? highest_of(run.harmonics) : run.response.highest();
  const std::size_t terms = 2 * index(run.highest) + 1;
  run.turn_map = band_by_waves(run, terms);
}

std::vector<double> rows_of_turn(const FoldedRun& run,
                                 std::span<const double> coefficients, int columns) {
  const std::size_t width = 3 * index(columns);
  const std::size_t band = index(run.band);
  const std::size_t terms = 2 * index(run.highest) + 1;
  const std::size_t used = std::min(terms, coefficients.size() / width);
  std::vector<double> by_columns(width * used);
  for (std::size_t i = 0; i < used; ++i) {
    for (std::size_t c = 0; c < width; ++c) {
      by_columns[c * used + i] = coefficients[i * width + c];
    }
  }
  std::vector<double> out(band * width);  // I-11
  numerics::inner_products({run.turn_map, used, terms}, {by_columns, used}, out);
  out.resize(std::max(out.size(), index(run.rows) * index(columns)), 0.0);
  return out;
}

}  // namespace trochoid::identification
