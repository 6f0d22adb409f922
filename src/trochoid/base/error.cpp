#include <trochoid/base/error.h>

#include <utility>

namespace trochoid::base {

namespace {

constexpr std::size_t problems_shown = 50;

std::string joined(const std::vector<std::string>& problems) {
  std::string text;
  for (std::size_t i = 0; i < problems.size() && i < problems_shown; ++i) {
    text += problems[i] + '\n';
  }
  if (problems.size() > problems_shown) {
    text += "and " + std::to_string(problems.size() - problems_shown) + " more\n";
  }
  return text;
}

}  // namespace

InputError::InputError(std::vector<std::string> problems)
    : std::runtime_error(joined(problems)), problems_(std::move(problems)) {}

}  // namespace trochoid::base
