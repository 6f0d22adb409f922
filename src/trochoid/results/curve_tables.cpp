#include <trochoid/results/curve_tables.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

namespace trochoid::results {

namespace {

constexpr std::array<const char*, 3> axis = {"Fx", "Fy", "Fz"};

/// Sample i of all runs, one after the other.
struct Place {
  std::size_t run = 0;
  std::size_t sample = 0;
};

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
    return runs[places[i].run].force[places[i].sample][q];
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
    add_column(fitted, fmt::format("{}_measured_N", axis[q]), n,
               [&](std::size_t i) { return measured(i, q); });
  }
  for (const ComputedForces& c : computed) {
    for (std::size_t q = 0; q < 3; ++q) {
      const std::string name = fmt::format("{}_{}_N", axis[q], c.name);
      const auto value = [&](std::size_t i) {
        return c.of_run[places[i].run][places[i].sample][q];
      };
      add_column(fitted, name, n, value);
      add_column(residual, name, n,
                 [&](std::size_t i) { return measured(i, q) - value(i); });
    }
  }
  return {std::move(fitted), std::move(residual)};
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
