#pragma once

#include <trochoid/program/move.h>
#include <trochoid/results/answer.h>

namespace trochoid::results {

/// @brief What `program` answers: the moves of a whole NC program.
struct ProgramResult {
  Heading heading;
  program::Program program;
  bool all_moves = false;  ///< in moves.csv, even where they are more than a million
};

Answer answer_of(const ProgramResult& result);

}  // namespace trochoid::results
