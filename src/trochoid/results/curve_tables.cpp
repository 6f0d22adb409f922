#include <trochoid/results/curve_tables.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

constexpr std::array<const char*, 3> axis = {"Fx", "Fy", "Fz"};

/// Sample i of all runs, one after the other.
struct Place {
  std::size_t run = 0;
  std::size_t sample = 0;
};

/// Whether any run has a force.
bool is_measured(std::span<const identification::Run> runs, std::size_t q) {
  return std::ranges::any_of(
      runs, [q](const identification::Run& run) { return run.measured[q]; });
}

std::vector<Place> places_of(std::span<const identification::Run> runs) {
  std::vector<Place> places;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t i = 0; i < runs[r].angle.size(); ++i) {
      places.push_back({r, i});
    }
  }
  return places;
}

}  // namespace

std::vector<base::Table> curve_tables(std::span<const identification::Run> runs,
                                      std::span<const ComputedForces> computed) {
  using base::add_column;
  const std::vector<Place> places = places_of(runs);
  const std::size_t n = places.size();
  const auto measured = [&](std::size_t i, std::size_t q) {
    const identification::Run& run = runs[places[i].run];
    return run.measured[q] ? run.force[places[i].sample][q]
                           : std::numeric_limits<double>::quiet_NaN();
  };
  base::Table fitted{"fitted.csv", {}};
  base::Table residual{"residual.csv", {}};
  for (base::Table* table : {&fitted, &residual}) {
    add_column(*table, "run", n, [&](std::size_t i) { return places[i].run + 1; });
    add_column(*table, "angle_deg", n, [&](std::size_t i) {
      return unit::in(runs[places[i].run].angle[places[i].sample], unit::deg);
    });
  }
  for (std::size_t q = 0; q < 3; ++q) {
    if (!is_measured(runs, q)) continue;
    add_column(fitted, fmt::format("{}_measured_N", axis[q]), n,
               [&](std::size_t i) { return measured(i, q); });
  }
  for (const ComputedForces& c : computed) {
    for (std::size_t q = 0; q < 3; ++q) {
      if (!is_measured(runs, q)) continue;
      const std::string name = fmt::format("{}_{}_N", axis[q], c.name);
      const auto value = [&](std::size_t i) {
        return runs[places[i].run].measured[q]
                   ? c.of_run[places[i].run][places[i].sample][q]
                   : std::numeric_limits<double>::quiet_NaN();
      };
      add_column(fitted, name, n, value);
      add_column(residual, name, n,
                 [&](std::size_t i) { return measured(i, q) - value(i); });
    }
  }
  return {std::move(fitted), std::move(residual)};
}

namespace {

using Forces = std::vector<std::array<double, 3>>;

/// Bins of a turn, and which of them each sample lies in.
struct TurnBins {
  std::vector<std::size_t> of_sample;
  std::vector<double> count;  ///< samples of a bin
  std::vector<double> angle;  ///< mean [rad]

  explicit TurnBins(std::span<const double> phi) {
    const double span = std::abs(phi.back() - phi.front());
    const double per_turn =
        span > 0 ? static_cast<double>(phi.size() - 1) * unit::turn / span : 1.0;
    const auto bins =
        static_cast<std::size_t>(std::clamp(std::round(per_turn), 1.0, 720.0));
    count.assign(bins, 0.0);
    angle.assign(bins, 0.0);
    for (const double a : phi) {
      const double turns = a / unit::turn;
      const double part = turns - std::floor(turns);
      const auto bin =
          std::min(bins - 1, static_cast<std::size_t>(part * double(bins) + 1e-9));
      of_sample.push_back(bin);
      count[bin] += 1.0;
      angle[bin] += part * unit::turn;
    }
    for (std::size_t b = 0; b < bins; ++b) angle[b] /= std::max(1.0, count[b]);
  }

  /// Mean of each bin that holds samples.
  [[nodiscard]] Forces means(const Forces& values) const {
    Forces sums(count.size(), std::array<double, 3>{});
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t q = 0; q < 3; ++q) sums[of_sample[i]][q] += values[i][q];
    }
    Forces out;
    for (std::size_t b = 0; b < sums.size(); ++b) {
      if (count[b] == 0.0) continue;
      for (double& f : sums[b]) f /= count[b];
      out.push_back(sums[b]);
    }
    return out;
  }
};

}  // namespace

std::vector<identification::Run> mean_turns(std::span<const identification::Run> runs,
                                            std::vector<ComputedForces>& computed) {
  std::vector<identification::Run> out;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const TurnBins bins(runs[r].angle);
    identification::Run& mean = out.emplace_back();
    mean.cut = runs[r].cut;
    mean.measured = runs[r].measured;
    mean.force = bins.means(runs[r].force);
    for (std::size_t b = 0; b < bins.count.size(); ++b) {
      if (bins.count[b] > 0.0) mean.angle.push_back(bins.angle[b]);
    }
    for (ComputedForces& one : computed) one.of_run[r] = bins.means(one.of_run[r]);
  }
  return out;
}

base::Table chip_curve_table(const force::ChipCurve& curve) {
  using base::add_column;
  base::Table table{"chip_curve.csv", {}};
  const std::size_t n = curve.theta.size();
  add_column(table, "theta_deg", n,
             [&](std::size_t i) { return unit::in(curve.theta[i], unit::deg); });
  for (std::size_t j = 0; j < curve.h.size(); ++j) {
    add_column(table, fmt::format("h_tooth{}_mm", j + 1), n,
               [&](std::size_t i) { return curve.h[j][i] / unit::mm; });
  }
  return table;
}

}  // namespace trochoid::results
