#pragma once

#include <trochoid/engagement/steps.h>
#include <trochoid/program/move.h>
#include <trochoid/results/answer.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::results {

/// A limit of the case that lines go beyond.
struct BrokenLimit {
  std::string_view limit;  ///< its key under [limits]
  double allowed = 0.0;    ///< in the unit of the key
  double worst = 0.0;      ///< in the unit of the key
  std::vector<std::uint32_t> lines;
};

/// Forces along a program.
struct ProgramForces {
  std::size_t teeth = 0;                     ///< of the tool that has most
  std::vector<engagement::Step> steps;       ///< rows, in their order
  std::size_t rows = 0;                      ///< that there are; not all may be kept
  std::vector<engagement::Step> places;      ///< as asked for
  std::vector<std::array<double, 2>> asked;  ///< line and fraction of each place
  engagement::Summary summary;
  std::vector<BrokenLimit> broken;
  std::vector<std::string> texts;  ///< of the lines of the summary
};

/// @brief What `program` answers: the moves of a whole NC program, and its forces.
struct ProgramResult {
  Heading heading;
  program::Program program;
  bool all_moves = false;  ///< in moves.csv, even where they are more than a million
  std::optional<ProgramForces> forces;  ///< nothing: not computed for these tools
};

Answer answer_of(const ProgramResult& result);

}  // namespace trochoid::results
