#pragma once

#include <trochoid/files/csv.h>

#include <span>
#include <string_view>
#include <vector>

/// What a line below the row of names is.
namespace trochoid::files {

/// @brief Whether a field holds nothing, or what measuring programs write where they
/// found nothing: `NaN`, `-`, `---`, `*****`, `n/a`.
bool is_missing(std::string_view text);

/// @brief Whether a field is text, rather than a number or a sign that there is none.
bool is_text(const Field& field);

/// @brief Whether a line is a rule: `-----  -----`.
bool is_rule(std::string_view line);

/// @brief Of a row in columns that leaves some out, put each field below its name.
///
/// Nothing is done where there are as many fields as names, or two belong to one.
void put_below(std::span<const Field> names, std::vector<Field>& fields);

/// @brief The last decimal of a number as it is written, in its own unit: 0.01 of `2.50`.
double last_decimal_of(std::string_view text);

}  // namespace trochoid::files
