#pragma once

#include <trochoid/results/columns.h>
#include <trochoid/results/fields.h>
#include <trochoid/results/program.h>

#include <optional>
#include <string>
#include <vector>

/// Parts of the answer of a program.
namespace trochoid::results {

/// @brief Tables of the forces along a program: steps, arcs, lines and places.
/// @pre result.forces is there
std::vector<base::Table> tables_of_forces(const ProgramResult& result);

/// The columns of these tables.
void add_texts_of_forces(std::vector<ColumnText>& out);

/// @brief A record over its program.
const Fields<ProgramRecord>& record_fields();

/// What the table says of the record.
std::string record_text(const ProgramRecord& record);

/// material.toml of what the forces in steady cuts tell; nothing: they tell nothing.
std::optional<std::string> material_of(const ProgramRecord& record);

/// @brief measured_steps.csv: steps beside their record.
base::Table table_of_record(const std::vector<engagement::Step>& steps,
                            const ProgramRecord& record);
void add_texts_of_record(std::vector<ColumnText>& out);

}  // namespace trochoid::results
