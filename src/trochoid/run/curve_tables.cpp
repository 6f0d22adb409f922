#include <trochoid/run/curve_tables.h>

#include <trochoid/base/units.h>
#include <trochoid/signal/revolutions.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

constexpr std::array<const char*, 3> axis = {"Fx", "Fy", "Fz"};

void add_force_columns(base::Table& table, const std::string& name) {
  for (const char* q : axis) {
    table.columns.push_back({fmt::format("{}_{}_N", q, name), {}});
  }
}

}  // namespace

std::vector<base::Table> curve_tables(std::span<const identification::Run> runs,
                                      std::span<const ComputedForces> computed) {
  base::Table fitted{"fitted.csv", {{"run", {}}, {"angle_deg", {}}}};
  base::Table residual{"residual.csv", {{"run", {}}, {"angle_deg", {}}}};
  add_force_columns(fitted, "measured");
  for (const ComputedForces& c : computed) {
    add_force_columns(fitted, c.name);
    add_force_columns(residual, c.name);
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    for (std::size_t i = 0; i < runs[r].angle.size(); ++i) {
      for (base::Table* table : {&fitted, &residual}) {
        table->columns[0].values.push_back(static_cast<double>(r + 1));
        table->columns[1].values.push_back(unit::in(runs[r].angle[i], unit::deg));
      }
      for (std::size_t q = 0; q < 3; ++q) {
        const double measured = runs[r].force[i][q];
        fitted.columns[2 + q].values.push_back(measured);
        for (std::size_t c = 0; c < computed.size(); ++c) {
          const double value = computed[c].of_run[r][i][q];
          fitted.columns[5 + 3 * c + q].values.push_back(value);
          residual.columns[2 + 3 * c + q].values.push_back(measured - value);
        }
      }
    }
  }
  return {std::move(fitted), std::move(residual)};
}

std::vector<base::Table> folded_tables(std::span<const identification::Run> runs) {
  base::Table table{"folded.csv", {{"run", {}}, {"angle_deg", {}}}};
  for (const char* q : axis) {
    table.columns.push_back({fmt::format("{}_mean_N", q), {}});
    table.columns.push_back({fmt::format("{}_sd_N", q), {}});
  }
  for (std::size_t r = 0; r < runs.size(); ++r) {
    std::array<std::vector<double>, 3> channels;
    for (const auto& F : runs[r].force) {
      for (std::size_t q = 0; q < 3; ++q) {
        channels[q].push_back(F[q]);
      }
    }
    const double turns =
        std::abs(runs[r].angle.back() - runs[r].angle.front()) / (360 * unit::deg);
    const double per_turn =
        static_cast<double>(runs[r].angle.size()) / std::max(turns, 1.0);
    const int bins = static_cast<int>(std::clamp(per_turn, 36.0, 360.0));
    if (runs[r].angle.back() <= runs[r].angle.front()) {
      continue;
    }
    const signal::OneRevolution turn = signal::fold(channels, runs[r].angle, bins);
    if (turn.revolutions < 2) {
      continue;
    }
    for (std::size_t b = 0; b < turn.angle.size(); ++b) {
      if (turn.count[b] < 2) {
        continue;
      }
      table.columns[0].values.push_back(static_cast<double>(r + 1));
      table.columns[1].values.push_back(turn.angle[b] / unit::deg);
      for (std::size_t q = 0; q < 3; ++q) {
        table.columns[2 + 2 * q].values.push_back(turn.mean[q][b]);
        table.columns[3 + 2 * q].values.push_back(turn.scatter[q][b]);
      }
    }
  }
  if (table.columns[0].values.empty()) {
    return {};
  }
  return {std::move(table)};
}

}  // namespace trochoid::run
