#include <trochoid/base/nesting.h>

#include <algorithm>
#include <cstddef>

namespace trochoid::base {

namespace {

/// How long the string or comment is that begins at `at`; 0 where none does.
std::size_t skipped(std::string_view text, std::size_t at) noexcept {
  const std::string_view rest = text.substr(at);
  const auto until = [&](std::string_view end, std::size_t from, bool escapes) {
    for (std::size_t i = from; i < rest.size(); ++i) {
      if (escapes && rest[i] == '\\') {
        ++i;
      } else if (rest.substr(i, end.size()) == end) {
        return i + end.size();
      } else if (end.size() == 1 && rest[i] == '\n') {
        return i;  // never closed: the parser will say so
      }
    }
    return rest.size();
  };
  if (rest.starts_with(R"(""")")) return until(R"(""")", 3, true);
  if (rest.starts_with("'''")) return until("'''", 3, false);
  if (rest.front() == '"') return until("\"", 1, true);
  if (rest.front() == '\'') return until("'", 1, false);
  if (rest.front() == '#') return std::min(rest.find('\n'), rest.size());
  return 0;
}

/// May it stand in a dotted key, or between its parts?
bool in_key(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
         c == '_' || c == '-' || c == '.' || c == ' ' || c == '\t';
}

TooDeep place_of(std::string_view text, std::size_t at, std::string_view why) noexcept {
  const std::string_view before = text.substr(0, at);
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 = 0
  return {static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1,
          static_cast<int>(at - start) + 1, why};
}

}  // namespace

std::optional<TooDeep> too_deep(std::string_view text) noexcept {
  int depth = 0;
  int parts = 1;
  std::size_t at = 0;
  while (at < text.size()) {
    if (const std::size_t length = skipped(text, at); length > 0) {
      parts = text[at] == '#' ? 1 : parts;
      at += length;
      continue;
    }
    const char c = text[at];
    parts = !in_key(c) ? 1 : c == '.' ? parts + 1 : parts;
    if (c == '[' || c == '{') {
      ++depth;
    } else if (c == ']' || c == '}') {
      depth = std::max(0, depth - 1);
    }
    if (depth > deepest_brackets) {
      return place_of(text, at, "nested deeper than 64 brackets");
    }
    if (parts > most_key_parts) {
      return place_of(text, at, "a key of more than 32 parts");
    }
    ++at;
  }
  return std::nullopt;
}

}  // namespace trochoid::base
