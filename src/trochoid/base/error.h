#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace trochoid::base {

/// @brief The user's input is wrong: all problems at once (exit code 2).
///
/// Each problem is one finished line, `file:line:col: key = value: why, what is right`.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> problems);
  [[nodiscard]] const std::vector<std::string>& problems() const noexcept {
    return problems_;
  }

 private:
  std::vector<std::string> problems_;
};

}  // namespace trochoid::base
