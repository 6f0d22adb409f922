#pragma once

#include <trochoid/results/answer.h>

#include <string>
#include <variant>
#include <vector>

namespace trochoid::results {

/// A number or a text; a number that is none where there is no value.
using Cell = std::variant<double, std::string>;

/// One row of a sweep.
struct SweepRow {
  std::vector<Cell> cells;  ///< values of the swept keys, drawn ones, what was taken
  std::string status;       ///< `ok`, `failed`, `wrong_input`
  std::string message;      ///< why, where it is not ok
};

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
  std::vector<SweepRow> rows;
  bool hdf5 = false;  ///< the table as HDF5 too
};

Answer answer_of(const SweepResult& result);

/// @brief Within what the first quantities lie, as a sentence: of rows by chance their
/// 95 %, of others all. Begins with a blank; empty where there are no numbers.
std::string ranges_of(const SweepResult& result);

}  // namespace trochoid::results
