#pragma once

#include <trochoid/results/answer.h>
#include <trochoid/results/sweep_rows.h>

#include <string>
#include <vector>

namespace trochoid::results {

/// @brief What `sweep` answers: a table, one row a case.
struct SweepResult {
  Heading heading;
  std::string command;             ///< that answered every row
  std::string method;              ///< how rows were laid out
  bool complete = true;            ///< false: the time was up before the last row
  bool by_chance = false;          ///< then the spread of the rows is an interval
  std::size_t draws = 0;           ///< of each point; 0: nothing is drawn
  std::vector<std::string> keys;   ///< that were swept
  std::vector<std::string> drawn;  ///< keys that were drawn
  std::vector<std::string> take;   ///< paths in the answers
  SweepRows rows;
  bool hdf5 = false;  ///< the table as HDF5 too
};

Answer answer_of(const SweepResult& result);

/// @brief Within what the first quantities lie, as a sentence: of rows by chance their
/// 95 %, of others all. Begins with a blank; empty where there are no numbers.
std::string ranges_of(const SweepResult& result);

}  // namespace trochoid::results
