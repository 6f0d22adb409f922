#pragma once

#include <trochoid/cases/tables.h>

#include <string>

namespace trochoid::cases {

/// @brief The tables as a case file; reading it gives the same tables.
std::string write_case(CaseTables& tables);

/// @brief The same without the tables of a cut, for a case that has none.
std::string write_machine_case(CaseTables& tables);

/// @brief The same of a case about a whole program: [cut] and [sampling] say nothing there.
std::string write_program_case(CaseTables& tables);

/// @brief A value of one line, tables in braces; nothing where it is absent.
std::optional<std::string> value_text(const Key& key, const Field& field);

}  // namespace trochoid::cases
