#pragma once

#include <trochoid/base/table.h>
#include <trochoid/results/columns.h>
#include <trochoid/results/modes.h>

#include <vector>

namespace trochoid::results {

/// @brief CSV files of `modes`: fitted.csv or one for each response, response.csv,
/// stabilisation.csv.
std::vector<base::Table> modes_tables(const ModesResult& result);

/// Their columns, for the page of formats.
void add_modes_columns(std::vector<ColumnText>& to);

}  // namespace trochoid::results
