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

/// What fitted.csv and residual.csv show.
struct Curves {
  std::span<const identification::Run> runs;
  std::span<const ComputedForces> computed;
  std::vector<Place> places = places_of(runs);
  std::vector<std::size_t> axes = {};  ///< of the forces that any run has

  Curves(std::span<const identification::Run> of,
         std::span<const ComputedForces> beside)
      : runs(of), computed(beside) {
    for (std::size_t q = 0; q < 3; ++q) {
      if (is_measured(runs, q)) axes.push_back(q);
    }
  }

  [[nodiscard]] double value(std::size_t i, std::size_t q,
                             const std::vector<std::array<double, 3>>& of_run) const {
    return runs[places[i].run].measured[q] ? of_run[places[i].sample][q]
                                           : std::numeric_limits<double>::quiet_NaN();
  }
  [[nodiscard]] double measured(std::size_t i, std::size_t which) const {
    return value(i, axes[which], runs[places[i].run].force);
  }
  /// Of all computed forces one after the other, axis by axis.
  [[nodiscard]] double by_computation(std::size_t i, std::size_t which) const {
    const ComputedForces& one = computed[which / axes.size()];
    return value(i, axes[which % axes.size()], one.of_run[places[i].run]);
  }
  [[nodiscard]] double left(std::size_t i, std::size_t which) const {
    return measured(i, which % axes.size()) - by_computation(i, which);
  }
};

std::vector<std::string> measured_names(const Curves& c) {
  std::vector<std::string> names;
  for (const std::size_t q : c.axes) names.emplace_back(axis[q]);
  return names;
}

std::vector<std::string> computed_names(const Curves& c) {
  std::vector<std::string> names;
  for (const ComputedForces& one : c.computed) {
    for (const std::size_t q : c.axes) {
      names.push_back(fmt::format("{}_{}", axis[q], one.name));
    }
  }
  return names;
}

Column<Curves> run_column() {
  return {"run", "number of the measurement, from 1",
          [](const Curves& c, std::size_t i) { return c.places[i].run + 1; }};
}

Column<Curves> angle_column() {
  return {"angle_deg", "recorded angle", [](const Curves& c, std::size_t i) {
            return given(c.runs[c.places[i].run].angle[c.places[i].sample]);
          }};
}

std::size_t samples_of(const Curves& c) {
  return c.places.size();
}

const Columns<Curves>& fitted_columns() {
  static const Columns<Curves> all{
      "fitted.csv",
      samples_of,
      {run_column(),
       angle_column(),
       {"*_measured_N",
        "measured force on the tool, `Fx`, `Fy`, `Fz` of those measured",
        measured_names,
        [](const Curves& c, std::size_t i, std::size_t k) { return c.measured(i, k); }},
       {"*_N",
        "the same as computed: `Fx_trochoidal_N` by the chip model of that name, of "
        "`simulate` `Fx_computed_N`",
        computed_names, [](const Curves& c, std::size_t i, std::size_t k) {
          return c.by_computation(i, k);
        }}}};
  return all;
}

const Columns<Curves>& residual_columns() {
  static const Columns<Curves> all{
      "residual.csv",
      samples_of,
      {run_column(),
       angle_column(),
       {"*_N", "measured less computed, names as in fitted.csv", computed_names,
        [](const Curves& c, std::size_t i, std::size_t k) { return c.left(i, k); }}}};
  return all;
}

const Columns<force::ChipCurve>& chip_curve_columns() {
  using Of = const force::ChipCurve&;
  static const Columns<force::ChipCurve> all{
      "chip_curve.csv",
      [](Of curve) { return curve.theta.size(); },
      {{"theta_deg", "nominal",
        [](Of curve, std::size_t i) { return given(curve.theta[i]); }},
       {"h_tooth*_mm", "chip thickness of each tooth, at the tip",
        [](Of curve) {
          std::vector<std::string> names;
          for (std::size_t j = 0; j < curve.h.size(); ++j) {
            names.push_back(std::to_string(j + 1));
          }
          return names;
        },
        [](Of curve, std::size_t i, std::size_t j) { return curve.h[j][i]; }}}};
  return all;
}

}  // namespace

std::vector<base::Table> curve_tables(std::span<const identification::Run> runs,
                                      std::span<const ComputedForces> computed) {
  const Curves curves(runs, computed);
  std::vector<base::Table> tables;
  tables.push_back(fitted_columns().table(curves));
  tables.push_back(residual_columns().table(curves));
  return tables;
}

void add_texts_of_curves(std::vector<ColumnText>& out) {
  fitted_columns().add_texts(out);
  residual_columns().add_texts(out);
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
  return chip_curve_columns().table(curve);
}

void add_texts_of_chip_curve(std::vector<ColumnText>& out) {
  chip_curve_columns().add_texts(out);
}

}  // namespace trochoid::results
