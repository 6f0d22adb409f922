#pragma once

#include <trochoid/results/answer.h>

#include <string>

namespace trochoid::results {

/// An answer, and what it is called beside another: its folder.
struct NamedAnswer {
  std::string name;
  Answer answer;
};

/// @brief Two answers of one command beside one another, as an answer `compare` for the
/// page: which numbers and which inputs differ, and the tables of both.
///
/// Numbers with a standard error are compared by it: how many standard errors of the
/// difference they are apart. Lists of more than 24 entries are left to the tables.
/// @throws base::InputError where they are of different commands
Answer compared(const NamedAnswer& a, const NamedAnswer& b);

}  // namespace trochoid::results
