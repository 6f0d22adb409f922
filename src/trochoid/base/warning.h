#pragma once

#include <iterator>
#include <string>
#include <vector>

namespace trochoid::base {

/// Something the user should know about an answer that stands all the same.
struct Warning {
  std::string code;     ///< short and stable, for programs: `idle_tooth`
  std::string message;  ///< a sentence, for people
};

/// @brief More of them, behind those there are.
inline void add(std::vector<Warning>& all, std::vector<Warning> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()),
             std::make_move_iterator(more.end()));
}

}  // namespace trochoid::base
