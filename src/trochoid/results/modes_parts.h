#pragma once

#include <trochoid/base/table.h>
#include <trochoid/base/units.h>
#include <trochoid/results/columns.h>
#include <trochoid/results/modes.h>

#include <string>
#include <string_view>
#include <vector>

/// What the answer of `modes` is put together from.
namespace trochoid::results {

inline double hertz(double omega) {
  return unit::in(omega, unit::Hz);
}

/// The axis of a case nearest to a direction, and the angle from it.
struct NearAxis {
  std::string_view axis;
  double angle = 0.0;  ///< [deg]
};

NearAxis near_axis(const ModesResult& r, const structure::FittedMode& mode);

/// @brief The modes as a file that other cases include.
std::string modes_toml(const ModesResult& r);

/// @brief The modes and their fit for a person at a terminal.
std::string short_table(const ModesResult& r);

/// @brief CSV files: fitted.csv or one for each response, response.csv, stabilisation.csv.
std::vector<base::Table> modes_tables(const ModesResult& r);

/// Their columns, for the page of formats.
void add_modes_columns(std::vector<ColumnText>& to);

}  // namespace trochoid::results
