#include <trochoid/base/error.h>

#include <map>
#include <string_view>
#include <utility>

namespace trochoid::base {

namespace {

constexpr std::size_t problems_shown = 50;
constexpr std::size_t longest_problem = 2000;
/// Of problems that differ in their place only.
constexpr std::size_t equals_shown = 5;

/// A problem without its place, `file:line:col: `.
std::string_view without_place(std::string_view problem) {
  const auto end = problem.find(": ");
  return end == std::string_view::npos ? problem : problem.substr(end + 2);
}

std::string joined(const std::vector<std::string>& problems) {
  std::string text;
  std::size_t shown = 0;
  std::map<std::string_view, std::size_t> alike;
  for (const std::string& problem : problems) {
    if (shown < problems_shown && alike[without_place(problem)]++ < equals_shown) {
      text += problem.substr(0, longest_problem);
      text += problem.size() > longest_problem ? "...\n" : "\n";
      ++shown;
    }
  }
  if (problems.size() > shown) {
    text += "and " + std::to_string(problems.size() - shown) + " more\n";
  }
  return text;
}

}  // namespace

InputError::InputError(std::vector<std::string> problems)
    : std::runtime_error(joined(problems)), problems_(std::move(problems)) {}

}  // namespace trochoid::base
