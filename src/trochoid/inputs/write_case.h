#pragma once

#include <trochoid/inputs/tables.h>

#include <string>

namespace trochoid::inputs {

/// @brief The tables as a case file; reading it gives the same tables.
std::string write_case(CaseTables& tables);

/// @brief The same without the tables of a cut, for a case that has none.
std::string write_machine_case(CaseTables& tables);

}  // namespace trochoid::inputs
