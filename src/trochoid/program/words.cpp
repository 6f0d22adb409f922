#include <trochoid/base/printable.h>
#include <trochoid/program/names.h>
#include <trochoid/program/words.h>

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace trochoid::program {

namespace {

constexpr bool is_blank(char c) noexcept {
  return c == ' ' || c == '\t';
}
constexpr bool is_digit(char c) noexcept {
  return c >= '0' && c <= '9';
}
constexpr char upper(char c) noexcept {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr bool is_letter(char c) noexcept {
  return upper(c) >= 'A' && upper(c) <= 'Z';
}

/// Where in a block we are.
struct Cursor {
  Block& block;
  Complaints& complaints;
  Dialect dialect;
  std::size_t at = 0;

  [[nodiscard]] bool done() const noexcept { return at >= block.text.size(); }
  [[nodiscard]] char now() const noexcept { return done() ? '\0' : block.text[at]; }
  [[nodiscard]] char ahead(std::size_t n) const noexcept {
    return at + n < block.text.size() ? block.text[at + n] : '\0';
  }
  void skip_blanks() noexcept {
    while (is_blank(now())) ++at;
  }
  /// The rest is not read.
  void stop() noexcept { at = block.text.size(); }
  void complain(std::size_t where, Fault fault, std::string what) {
    program::complain(complaints, block, where, fault, std::move(what));
  }
};

bool letter_with_number(std::string_view text) noexcept {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!is_letter(text[i])) continue;
    std::size_t next = i + 1;
    while (next < text.size() && is_blank(text[next])) ++next;
    while (next < text.size() && (text[next] == '+' || text[next] == '-')) ++next;
    if (next < text.size() && text[next] == '.') ++next;
    if (next < text.size() && is_digit(text[next])) return true;
  }
  return false;
}

void skip_comment(Cursor& c) {
  const std::string_view text = c.block.text;
  const std::size_t open = c.at;
  const std::size_t close = text.find(')', open);
  if (close == std::string_view::npos) {
    c.complain(open, Fault::comment, "a comment without its closing bracket");
    return c.stop();
  }
  c.at = close + 1;
  const bool nested =
      text.substr(open + 1, close - open - 1).find('(') != std::string_view::npos;
  if (nested && !letter_with_number(text.substr(close + 1))) {
    remark(c.complaints, "nested_comment", {c.block.line, column_of(text, open)},
           "a comment with brackets in it is taken to the end of its line");
    c.stop();
  }
}

/// Sign, digits and point at the cursor. Nothing, and the cursor behind what stands there,
/// where they are no number.
std::optional<Word> number_at(Cursor& c) {
  const std::string_view text = c.block.text;
  const bool negative = c.now() == '-';
  if (negative || c.now() == '+') {
    ++c.at;
    c.skip_blanks();
  }
  const std::size_t first = c.at;
  while (is_digit(c.now()) || c.now() == '.') ++c.at;
  const std::string_view digits = text.substr(first, c.at - first);
  Word word;
  word.has_value = true;
  word.point = digits.find('.') != std::string_view::npos;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(),
                                    word.value, std::chars_format::fixed);
  if (read.ec != std::errc{} || read.ptr != digits.data() + digits.size() ||
      !std::isfinite(word.value)) {
    return std::nullopt;
  }
  if (negative) word.value = -word.value;
  return word;
}

bool begins_variable(const Cursor& c) noexcept {
  if (c.now() == '#' || c.now() == '[') return true;
  return c.dialect == Dialect::sinumerik && (c.now() == '$' || c.now() == '(');
}

/// Up to the blank or letter where the next word may begin.
void skip_expression(Cursor& c) noexcept {
  int depth = 0;
  for (; !c.done(); ++c.at) {
    const char now = c.now();
    if (now == '[' || now == '(' || now == '<') ++depth;
    if (now == ']' || now == ')' || now == '>') --depth;
    if (depth <= 0 && is_blank(now)) return;
  }
}

void add_letter(Cursor& c, std::size_t start, Word word) {
  word.letter = upper(c.block.text[start]);
  word.at = static_cast<std::uint32_t>(start);
  word.size = static_cast<std::uint32_t>(c.at - start);
  c.block.words.push_back(word);
}

/// What stands between the bracket or quote at the cursor and the one that closes it.
std::optional<std::string_view> enclosed(Cursor& c) {
  const std::size_t open = c.at;
  if (c.now() == '"') {
    const std::size_t close = c.block.text.find('"', open + 1);
    if (close == std::string_view::npos) return std::nullopt;
    c.at = close + 1;
    return c.block.text.substr(open + 1, close - open - 1);
  }
  int depth = 0;
  bool quoted = false;
  for (; !c.done(); ++c.at) {
    if (c.now() == '"') quoted = !quoted;
    if (quoted) continue;
    if (c.now() == '(') ++depth;
    if (c.now() == ')' && --depth == 0) {
      ++c.at;
      return c.block.text.substr(open + 1, c.at - open - 2);
    }
  }
  return std::nullopt;
}

/// `IC(5)` or `AC(5)` at the cursor.
std::optional<Word> sensed_value(Cursor& c) {
  const bool incremental = upper(c.now()) == 'I';
  c.at += 2;
  c.skip_blanks();
  if (c.now() != '(') return std::nullopt;
  ++c.at;
  c.skip_blanks();
  std::optional<Word> word = number_at(c);
  c.skip_blanks();
  if (!word || c.now() != ')') return std::nullopt;
  ++c.at;
  word->sense = incremental ? Sense::incremental : Sense::absolute;
  return word;
}

bool begins_sensed(const Cursor& c) noexcept {
  const char first = upper(c.now());
  if ((first != 'I' && first != 'A') || upper(c.ahead(1)) != 'C') return false;
  std::size_t next = 2;
  while (is_blank(c.ahead(next))) ++next;
  return c.ahead(next) == '(';
}

/// What follows `=`: a number, IC( ) or AC( ), a text.
void assigned_value(Cursor& c, std::size_t start, Word word) {
  c.skip_blanks();
  std::optional<Word> value;
  if (c.now() == '"') {
    const auto text = enclosed(c);
    if (text) {
      value = Word{};
      value->inside = *text;
    }
  } else if (begins_sensed(c)) {
    value = sensed_value(c);
  } else if (is_letter(c.now()) || begins_variable(c)) {
    skip_expression(c);
    return c.complain(
        start, Fault::variable,
        fmt::format("{} is given by an expression",
                    base::one_line(c.block.text.substr(start, c.at - start))));
  } else {
    value = number_at(c);
  }
  // What may stand behind a number but belongs to it: X=5+R1, X=2*3.
  const bool goes_on =
      c.now() == '+' || c.now() == '-' || c.now() == '*' || c.now() == '/';
  if (!value || goes_on) {
    skip_expression(c);
    return c.complain(
        start, Fault::number,
        fmt::format("{}: not a number",
                    base::one_line(c.block.text.substr(start, c.at - start))));
  }
  value->letter = word.letter;
  value->name = word.name;
  value->at = static_cast<std::uint32_t>(start);
  value->size = static_cast<std::uint32_t>(c.at - start);
  c.block.words.push_back(*value);
}

/// A name: two letters or more, or a letter with digits in front of `=`.
void read_name(Cursor& c) {
  const std::size_t start = c.at;
  const auto of_name = [](char ch) {
    return is_letter(ch) || is_digit(ch) || ch == '_';
  };
  while (of_name(c.now())) ++c.at;
  Word word;
  word.name = c.block.text.substr(start, c.at - start);
  word.at = static_cast<std::uint32_t>(start);
  if (c.now() == ':' && c.dialect == Dialect::sinumerik && c.block.words.empty()) {
    ++c.at;  // a label: nothing jumps to it
    return;
  }
  std::size_t next = c.at;
  while (next < c.block.text.size() && is_blank(c.block.text[next])) ++next;
  const char after = next < c.block.text.size() ? c.block.text[next] : '\0';
  word.assigned = after == '=';
  if (refused_name(word.name, word.assigned, c.dialect)) {
    c.block.words.push_back(word);
    c.block.words.back().size = static_cast<std::uint32_t>(c.at - start);
    return c.stop();  // the rest belongs to it
  }
  if (after == '=') {
    c.at = next + 1;
    return assigned_value(c, start, word);
  }
  if (after == '(') {
    c.at = next;
    const auto inside = enclosed(c);
    if (!inside) {
      c.complain(next, Fault::comment, "a bracket that is not closed");
      return c.stop();
    }
    word.inside = *inside;
    word.brackets = true;
  }
  word.size = static_cast<std::uint32_t>(c.at - start);
  c.block.words.push_back(word);
}

constexpr std::size_t fewest_of_text = 3;

/// How many letters follow one another.
std::size_t letters_at(const Cursor& c, std::size_t start) noexcept {
  std::size_t end = start;
  while (end < c.block.text.size() && is_letter(c.block.text[end])) ++end;
  return end - start;
}

/// A letter and what follows it.
void read_letter(Cursor& c) {
  const std::size_t start = c.at;
  ++c.at;
  c.skip_blanks();
  if (c.now() == '=' && c.dialect == Dialect::sinumerik) {
    ++c.at;
    Word word;
    word.letter = upper(c.block.text[start]);
    return assigned_value(c, start, word);
  }
  if (begins_variable(c)) {
    skip_expression(c);
    return c.complain(
        start, Fault::variable,
        fmt::format("{} is given by an expression",
                    base::one_line(c.block.text.substr(start, c.at - start))));
  }
  if (const std::size_t letters = letters_at(c, start); letters >= fewest_of_text) {
    c.complain(start, Fault::number,
               fmt::format("{}: text that is in no comment",
                           base::one_line(c.block.text.substr(start, letters))));
    return c.stop();
  }
  const std::optional<Word> word = number_at(c);
  if (!word) {
    const std::string shown = base::one_line(c.block.text.substr(start, c.at - start));
    return c.complain(start, Fault::number,
                      c.at - start > 1 && c.block.text[c.at - 1] != ' '
                          ? fmt::format("{}: not a number", shown)
                          : fmt::format("{} without a number", c.block.text[start]));
  }
  add_letter(c, start, *word);
}

/// A name begins here, and not a letter with its number.
bool begins_name(const Cursor& c) noexcept {
  if (!is_letter(c.now())) return false;
  const char second = c.ahead(1);
  const auto length = [&c] {
    std::size_t n = 0;
    while (is_letter(c.ahead(n)) || c.ahead(n) == '_') ++n;
    return n;
  };
  if (c.dialect != Dialect::sinumerik) {
    return is_letter(second) &&
           refused_name(c.block.text.substr(c.at, length()), false, c.dialect)
               .has_value();
  }
  if (is_letter(second) || second == '_') return true;
  if (!is_digit(second)) return false;
  std::size_t next = 1;  // S1=3000, R1=5
  while (is_digit(c.ahead(next))) ++next;
  while (is_blank(c.ahead(next))) ++next;
  return c.ahead(next) == '=';
}

/// `O100 sub`, `o<name> call`, `O123`: LinuxCNC and program numbers.
/// @return  whether it was one
bool read_o_word(Cursor& c) {
  if (upper(c.now()) != 'O' || c.dialect == Dialect::sinumerik) return false;
  const std::size_t start = c.at;
  std::size_t next = 1;
  while (is_blank(c.ahead(next))) ++next;
  if (c.ahead(next) == '<') {
    while (c.ahead(next) != '>' && c.ahead(next) != '\0') ++next;
    ++next;
  } else {
    while (is_digit(c.ahead(next))) ++next;
  }
  while (is_blank(c.ahead(next))) ++next;
  std::size_t end = next;
  while (is_letter(c.ahead(end))) ++end;
  if (end == next || end - next < 2) return false;
  const std::string_view keyword = c.block.text.substr(c.at + next, end - next);
  const auto is = [keyword](std::string_view word) { return same_word(keyword, word); };
  const bool sub = is("sub") || is("endsub") || is("call") || is("return");
  const bool loop = is("if") || is("else") || is("elseif") || is("endif") ||
                    is("while") || is("endwhile") || is("do") || is("repeat") ||
                    is("endrepeat") || is("break") || is("continue");
  if (!sub && !loop) return false;
  c.complain(start, sub ? Fault::subprogram : Fault::loop,
             fmt::format("O word with {}", keyword));
  c.stop();
  return true;
}

/// What stands at the cursor and begins no word.
void read_other(Cursor& c) {
  const std::size_t start = c.at;
  const char now = c.now();
  const bool system = c.dialect == Dialect::sinumerik && now == '$';
  if (now == '#' || (system && is_letter(c.ahead(1)))) {
    c.complain(start, Fault::variable, "a variable");
    return c.stop();
  }
  if (now == '[') {
    skip_expression(c);
    return c.complain(start, Fault::variable, "an expression");
  }
  if (now == ',') {
    c.complain(start, Fault::order,
               "a corner that the control rounds or chamfers (,R ,C ,A); post the arc "
               "or line itself");
    return c.stop();
  }
  if (now == '*' && c.at + 1 == c.block.text.size()) {
    c.complain(start, Fault::dialect, "* at the end of a block, as Heidenhain's ISO");
    return c.stop();
  }
  std::size_t next = start + 1;
  while (next < c.block.text.size() &&
         (static_cast<unsigned char>(c.block.text[next]) & 0xC0U) == 0x80U) {
    ++next;
  }
  c.at = next;
  c.complain(start, Fault::unknown,
             fmt::format("{} is no word",
                         base::one_line(c.block.text.substr(start, next - start))));
}

/// / and % at the beginning of a line.
/// @return  whether there is more to read
bool read_front(Cursor& c) {
  c.skip_blanks();
  if (c.now() == '%') {
    c.block.mark = true;
    return false;
  }
  if (c.now() == '/') {
    c.block.deleted = true;
    ++c.at;
    if (is_digit(c.now())) ++c.at;
  }
  return true;
}

}  // namespace

void complain(Complaints& all, Block& block, std::size_t at, Fault fault,
              std::string what) {
  block.wrong = true;
  const std::string_view advice = advice_on(fault);
  if (!advice.empty()) {
    what += "; ";
    what += advice;
  }
  all.problems.push_back(
      {fault, {block.line, column_of(block.text, at)}, std::move(what)});
}

std::string_view text_of(const Block& block, const Word& word) noexcept {
  return block.text.substr(word.at, word.size);
}

bool same_word(std::string_view a, std::string_view b) noexcept {
  return std::ranges::equal(a, b, [](char x, char y) { return upper(x) == upper(y); });
}

void split(Block& block, Dialect dialect, Complaints& complaints) {
  block.words.clear();
  block.deleted = false;
  block.optional_from = Block::all;
  block.mark = false;
  block.wrong = false;
  Cursor c{block, complaints, dialect};
  if (!read_front(c)) return;
  while (true) {
    c.skip_blanks();
    if (c.done() || c.now() == ';') return;
    if (c.now() == '(' && dialect != Dialect::sinumerik) {
      skip_comment(c);
    } else if (c.now() == '/' && block.words.size() == 1 &&
               block.words.front().letter == 'N') {
      block.deleted = true;
      ++c.at;
    } else if (c.now() == '/' && dialect == Dialect::iso) {
      block.optional_from = std::min(block.optional_from, block.words.size());
      ++c.at;
      if (is_digit(c.now())) ++c.at;
    } else if (c.now() == ':' && is_digit(c.ahead(1))) {
      read_letter(c);
      if (!block.words.empty()) {
        block.words.back().letter = dialect == Dialect::sinumerik ? 'N' : 'O';
      }
    } else if (read_o_word(c)) {
      return;
    } else if (begins_name(c)) {
      read_name(c);
    } else if (is_letter(c.now())) {
      read_letter(c);
    } else {
      read_other(c);
    }
  }
}

}  // namespace trochoid::program
