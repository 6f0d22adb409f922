#pragma once

#include <trochoid/results/columns.h>
#include <trochoid/results/program.h>

#include <vector>

namespace trochoid::results {

/// @brief Tables of the forces along a program: steps, arcs, lines and places.
/// @pre result.forces is there
std::vector<base::Table> tables_of_forces(const ProgramResult& result);

/// The columns of these tables.
void add_texts_of_forces(std::vector<ColumnText>& out);

}  // namespace trochoid::results
