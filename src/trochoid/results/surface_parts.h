#pragma once

#include <trochoid/results/columns.h>
#include <trochoid/results/surface.h>

#include <string>
#include <vector>

/// What `surface` answers beside the wall of one cut.
namespace trochoid::results {

/// @brief Passes, loads and other forces, where they were asked for, in summary.json.
const Fields<SurfaceResult>& surface_part_fields();

/// @brief passes.csv and wall_loads.csv, where they were asked for.
void add_surface_tables(const SurfaceResult& r, std::vector<base::Table>& tables);
void add_texts_of_surface_parts(std::vector<ColumnText>& out);

/// The same for a person.
std::string surface_parts_text(const SurfaceResult& r);

}  // namespace trochoid::results
