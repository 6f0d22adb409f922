#include <trochoid/program/dialect.h>
#include <trochoid/program/words.h>

#include <array>
#include <utility>

namespace trochoid::program {

namespace {

using namespace std::string_view_literals;

constexpr char upper_case(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr bool letter(char c) noexcept {
  return upper_case(c) >= 'A' && upper_case(c) <= 'Z';
}
constexpr bool digit(char c) noexcept {
  return c >= '0' && c <= '9';
}

struct Signs {
  bool sinumerik = false;
  bool linuxcnc = false;
  bool changes_tool = false;
};

/// One line, from which nothing but the signs is wanted.
struct Sight {
  std::string_view line;

  [[nodiscard]] char at(std::size_t i) const noexcept {
    return i < line.size() ? upper_case(line[i]) : '\0';
  }
  [[nodiscard]] std::size_t behind_blanks(std::size_t i) const noexcept {
    while (at(i) == ' ' || at(i) == '\t') ++i;
    return i;
  }
  [[nodiscard]] bool has(std::size_t i, std::string_view word) const noexcept {
    return same_word(line.substr(i, word.size()), word);
  }
};

/// Digits at i, as an integer without leading zeros; and what follows them.
std::pair<int, std::size_t> integer_at(const Sight& s, std::size_t i) noexcept {
  constexpr int most = 100000;
  int value = digit(s.at(i)) ? 0 : -1;
  for (; digit(s.at(i)); ++i) {
    value = value < most ? value * 10 + (s.at(i) - '0') : value;
  }
  return {value, i};
}

void see_g(const Sight& s, std::size_t i, Signs& signs) noexcept {
  const auto [number, end] = integer_at(s, s.behind_blanks(i + 1));
  const bool point = s.at(end) == '.';
  signs.sinumerik |= (number == 500 || number == 710) && !point;
  signs.linuxcnc |= number >= 90 && number <= 99 && point && s.at(end + 1) == '1';
  signs.linuxcnc |= number == 64 && !point && s.at(s.behind_blanks(end)) == 'P';
}

void see_o(const Sight& s, std::size_t i, Signs& signs) noexcept {
  const std::size_t next = s.behind_blanks(i + 1);
  const std::size_t word = s.behind_blanks(integer_at(s, next).second);
  signs.linuxcnc |= s.at(next) == '<' || (digit(s.at(next)) && s.has(word, "sub"));
}

/// A letter that begins a word.
void see_letter(const Sight& s, std::size_t i, Signs& signs) noexcept {
  switch (s.at(i)) {
    case 'G':
      return see_g(s, i, signs);
    case 'M': {
      if (s.has(i, "MSG") && s.at(s.behind_blanks(i + 3)) == '(') {
        signs.sinumerik = true;
      }
      const auto [number, end] = integer_at(s, s.behind_blanks(i + 1));
      signs.changes_tool |= number == 6 && s.at(end) != '.';
      return;
    }
    case 'O':
      return see_o(s, i, signs);
    case 'C':
      signs.sinumerik |= s.at(i + 1) == 'R' && s.at(s.behind_blanks(i + 2)) == '=';
      return;
    case 'I':
    case 'A':
      signs.sinumerik |= s.at(i + 1) == 'C' && s.at(i + 2) == '(';
      return;
    case 'S':
      signs.sinumerik |= s.has(i, "SUPA") && !letter(s.at(i + 4));
      return;
    default:
      return;
  }
}

void see_line(const Sight& s, Signs& signs) noexcept {
  const std::size_t first = s.behind_blanks(0);
  signs.sinumerik |= s.has(first, "%_N_");
  for (std::size_t i = first; i < s.line.size(); ++i) {
    const char now = s.line[i];
    if (now == ';') return;
    if (now == '(') {
      const std::size_t close = s.line.find(')', i);
      if (close == std::string_view::npos) return;
      i = close;
    } else if (now == '#') {
      signs.linuxcnc |= s.at(i + 1) == '<';
    } else if (letter(now) && (i == 0 || !letter(s.line[i - 1]))) {
      see_letter(s, i, signs);
    }
  }
}

std::optional<std::size_t> begin_of_heidenhain(std::string_view text) noexcept {
  constexpr std::size_t far = 2000;
  for (std::size_t i = 0; i < text.size() && i < far; ++i) {
    if (!same_word(text.substr(i, 5), "BEGIN")) continue;
    std::size_t next = i + 5;
    while (next < text.size() && text[next] == ' ') ++next;
    if (next > i + 5 && same_word(text.substr(next, 3), "PGM")) return i;
  }
  return std::nullopt;
}

bool ends_with(std::string_view name, std::string_view end) noexcept {
  return name.size() >= end.size() &&
         same_word(name.substr(name.size() - end.size()), end);
}

}  // namespace

std::pair<std::string_view, std::size_t> line_at(std::string_view text,
                                                 std::size_t at) {
  std::size_t end = at;
  while (end < text.size() && text[end] != '\n' && text[end] != '\r') ++end;
  std::size_t next = end + 1;
  if (end >= text.size()) {
    next = std::string_view::npos;
  } else if (text[end] == '\r' && next < text.size() && text[next] == '\n') {
    ++next;
  }
  return {text.substr(at, end - at), next};
}

Outline outline_of(std::string_view text, std::optional<Dialect> given,
                   std::string_view name) {
  Signs signs;
  for (std::size_t at = 0; at < text.size();) {
    const auto [line, next] = line_at(text, at);
    see_line(Sight{line}, signs);
    at = next;
  }
  Outline out;
  out.changes_tool = signs.changes_tool;
  out.heidenhain = begin_of_heidenhain(text);
  const bool sinumerik =
      signs.sinumerik || ends_with(name, ".mpf") || ends_with(name, ".spf");
  const bool linuxcnc = signs.linuxcnc || ends_with(name, ".ngc");
  out.dialect = given.value_or(sinumerik  ? Dialect::sinumerik
                               : linuxcnc ? Dialect::linuxcnc
                                          : Dialect::iso);
  return out;
}

}  // namespace trochoid::program
