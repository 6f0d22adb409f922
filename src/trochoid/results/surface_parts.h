#pragma once

#include <trochoid/results/surface.h>

#include <string>
#include <vector>

/// What `surface` answers beside the wall of one cut.
namespace trochoid::results {

/// @brief Passes, loads and other forces, where they were asked for, in summary.json.
void add_surface_parts(const SurfaceResult& r, Object& result);

/// @brief passes.csv and wall_loads.csv, where they were asked for.
void add_surface_tables(const SurfaceResult& r, std::vector<base::Table>& tables);

/// The same for a person.
std::string surface_parts_text(const SurfaceResult& r);

}  // namespace trochoid::results
