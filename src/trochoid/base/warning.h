#pragma once

#include <string>

namespace trochoid::base {

/// Something the user should know about an answer that stands all the same.
struct Warning {
  std::string code;     ///< short and stable, for programs: `idle_tooth`
  std::string message;  ///< a sentence, for people
};

}  // namespace trochoid::base
