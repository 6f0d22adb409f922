#pragma once

#include <trochoid/inputs/tables.h>

#include <string>

namespace trochoid::inputs {

/// @brief The tables as a case file; reading it gives the same tables.
std::string write_case(CaseTables& tables);

}  // namespace trochoid::inputs
