#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/results/answer.h>

namespace trochoid::run {

/// @brief What every answer to a case begins with: its title, what its reader noted, and
/// the case as it was understood.
inline results::Heading heading_of(const inputs::Case& given) {
  results::Heading heading;
  heading.title = given.title;
  heading.warnings = given.notes;
  heading.case_toml = given.as_understood;
  return heading;
}

}  // namespace trochoid::run
