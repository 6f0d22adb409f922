#include <trochoid/base/error.h>
#include <trochoid/files/csv.h>
#include <trochoid/files/uff58.h>

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

namespace trochoid::files {

namespace {

/// Lines of a text that may hold binary data in between.
struct Cursor {
  std::string_view text;
  std::size_t at = 0;
  std::size_t line = 0;  ///< of the line taken last, from 1
  Problems problems;

  [[nodiscard]] bool done() const { return at >= text.size(); }

  std::string_view next() {
    const auto end = std::min(text.find('\n', at), text.size());
    auto taken = text.substr(at, end - at);
    at = std::min(end + 1, text.size());
    ++line;
    if (!taken.empty() && taken.back() == '\r') taken.remove_suffix(1);
    return taken;
  }
};

bool is_delimiter(std::string_view line) {
  return trimmed(line, " \t\r") == "-1";
}

/// Columns [from, from + width) of a line, without blanks around.
std::string_view cell(std::string_view line, std::size_t from, std::size_t width) {
  return from < line.size() ? trimmed(line.substr(from, width), " \t\r")
                            : std::string_view();
}

std::optional<long long> whole(std::string_view text) {
  long long value = 0;
  const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || read.ec != std::errc{} || read.ptr != text.data() + text.size()) {
    return std::nullopt;
  }
  return value;
}

int small_whole(std::string_view text) {
  const auto value = whole(text);
  return value && std::abs(*value) < 1000000000 ? static_cast<int>(*value) : 0;
}

/// A number as Fortran writes it, D for the exponent too; the rest of the text remains.
std::optional<double> take_number(std::string_view& text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
    text.remove_prefix(1);
  }
  std::array<char, 40> buffer{};
  const std::size_t size = std::min(text.size(), buffer.size());
  std::transform(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(size),
                 buffer.begin(), [](char c) { return c == 'D' || c == 'd' ? 'E' : c; });
  const std::size_t sign = size > 0 && buffer[0] == '+' ? 1 : 0;
  double value = 0.0;
  const auto read = std::from_chars(buffer.data() + sign, buffer.data() + size, value);
  if (read.ec != std::errc{} || !std::isfinite(value)) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(read.ptr - buffer.data()));
  return value;
}

UffAxis axis_in(std::string_view line) {
  return {.type = small_whole(cell(line, 0, 10)),
          .label = std::string(cell(line, 26, 20)),
          .unit = std::string(cell(line, 47, 20))};
}

void read_record_6(std::string_view line, Uff58& set) {
  set.function_type = small_whole(cell(line, 0, 5));
  set.response_node = small_whole(cell(line, 41, 10));
  set.response_direction = small_whole(cell(line, 51, 4));
  set.reference_node = small_whole(cell(line, 66, 10));
  set.reference_direction = small_whole(cell(line, 76, 4));
}

void read_record_7(std::string_view line, Cursor& cursor, Uff58& set) {
  const auto type = whole(cell(line, 0, 10));
  const auto points = whole(cell(line, 10, 10));
  const auto even = whole(cell(line, 20, 10));
  std::string_view rest = line.size() > 30 ? line.substr(30) : std::string_view();
  const auto first = take_number(rest);
  const auto step = take_number(rest);
  if (!type || !points || !even || !first || !step || *points < 1) {
    cursor.problems.add(
        cursor.line, 1,
        fmt::format("{}: this line must contain the type of the data, the "
                    "number of points, 0 or 1 for the spacing, the "
                    "first abscissa and its increment",
                    excerpt(line)));
    return;
  }
  if (*type != 2 && *type != 4 && *type != 5 && *type != 6) {
    cursor.problems.add(cursor.line, 1,
                        fmt::format("{} is no type of data: must be 2 or 4 (real), 5 "
                                    "or 6 (complex)",
                                    *type));
    return;
  }
  set.ordinate_type = static_cast<int>(*type);
  set.promised = static_cast<std::size_t>(*points);
  set.even = *even != 0;
  set.abscissa_min = *first;
  set.abscissa_increment = *step;
}

/// The eleven lines that say what follows.
bool read_head(Cursor& cursor, Uff58& set) {
  std::array<std::string_view, 11> lines;
  for (auto& line : lines) {
    if (cursor.done()) {
      cursor.problems.add(cursor.line, 1,
                          "the file ends inside the head of a "
                          "data set 58: it is cut off");
      return false;
    }
    line = cursor.next();
    if (&line == &lines[6]) {
      const auto before = cursor.problems.lines.size();
      read_record_7(line, cursor, set);
      if (cursor.problems.lines.size() > before) return false;
    }
  }
  for (std::size_t i = 0; i < set.id.size(); ++i) {
    set.id[i] = std::string(trimmed(lines[i], " \t\r"));
  }
  read_record_6(lines[5], set);
  set.abscissa = axis_in(lines[7]);
  set.ordinate = axis_in(lines[8]);
  set.denominator = axis_in(lines[9]);
  return true;
}

std::size_t numbers_per_point(const Uff58& set) {
  return (set.even ? 0U : 1U) + (set.complex_valued() ? 2U : 1U);
}

/// Points from the numbers in their order; an incomplete last point is left out.
void take_points(const std::vector<double>& numbers, Uff58& set) {
  const std::size_t each = numbers_per_point(set);
  const std::size_t count = std::min(numbers.size() / each, set.promised);
  for (std::size_t i = 0; i < count; ++i) {
    const double* p = numbers.data() + i * each;
    set.x.push_back(set.even ? set.abscissa_min +
                                   static_cast<double>(i) * set.abscissa_increment
                             : *p++);
    set.y.emplace_back(p[0], set.complex_valued() ? p[1] : 0.0);
  }
}

void read_text_data(Cursor& cursor, Uff58& set) {
  std::vector<double> numbers;
  while (!cursor.done()) {
    const auto line = cursor.next();
    if (is_delimiter(line)) break;
    std::string_view rest = line;
    while (!trimmed(rest, " \t\r").empty()) {
      const auto number = take_number(rest);
      if (!number) {
        const auto column = static_cast<std::size_t>(rest.data() - line.data()) + 1;
        cursor.problems.add(
            cursor.line, column,
            fmt::format("{}: not a finite number; the data of a set 58 are numbers up "
                        "to a line with -1",
                        excerpt(rest.substr(0, 20))));
        if (cursor.problems.full()) return;
        break;
      }
      numbers.push_back(*number);
    }
  }
  take_points(numbers, set);
}

template <class Float, class Bits>
double number_at(const char* at, bool swap) {
  Bits bits = 0;
  std::memcpy(&bits, at, sizeof bits);
  if (swap) {
    Bits turned = 0;
    for (std::size_t i = 0; i < sizeof bits; ++i) {
      turned = static_cast<Bits>((turned << 8U) | ((bits >> (8U * i)) & 0xFFU));
    }
    bits = turned;
  }
  return static_cast<double>(std::bit_cast<Float>(bits));
}

/// How the data of a set 58b are written.
struct Layout {
  bool swap = false;
  std::size_t bytes = 0;  ///< as the head says; 0: it does not
};

void read_binary_data(Cursor& cursor, const Layout& layout, Uff58& set) {
  const std::size_t size = set.ordinate_type == 4 || set.ordinate_type == 6 ? 8 : 4;
  const std::size_t left = cursor.text.size() - cursor.at;
  const std::size_t each = size * numbers_per_point(set);
  const std::size_t wanted = set.promised > left / each ? left : set.promised * each;
  const std::size_t there = std::min(layout.bytes > 0 ? layout.bytes : wanted, left);
  std::vector<double> numbers;
  for (std::size_t at = 0; at + size <= std::min(wanted, there); at += size) {
    const char* p = cursor.text.data() + cursor.at + at;
    const double value = size == 8 ? number_at<double, std::uint64_t>(p, layout.swap)
                                   : number_at<float, std::uint32_t>(p, layout.swap);
    if (!std::isfinite(value)) {
      cursor.problems.add(set.line, 1,
                          fmt::format("byte {} of the file: not a finite number in the "
                                      "data of this set",
                                      cursor.at + at + 1));
      if (cursor.problems.full()) return;
    }
    numbers.push_back(value);
  }
  cursor.at += there;
  take_points(numbers, set);
  // What is left up to the next -1, mostly an end of line.
  while (!cursor.done() && !is_delimiter(cursor.next())) {
  }
}

/// The line `58b ...`: byte order, format of numbers, bytes of data.
std::optional<Layout> layout_of(std::string_view line, Cursor& cursor) {
  const auto order = whole(cell(line, 7, 6));
  const auto format = whole(cell(line, 13, 6));
  const auto bytes = whole(cell(line, 31, 12));
  if (!order || (*order != 1 && *order != 2) || !format || *format != 2) {
    cursor.problems.add(cursor.line, 1,
                        fmt::format("{}: must say byte order 1 or 2 and the format 2 "
                                    "(IEEE 754); others are not read",
                                    excerpt(line)));
    return std::nullopt;
  }
  constexpr bool little = std::endian::native == std::endian::little;
  return Layout{.swap = (*order == 1) != little,
                .bytes = bytes && *bytes > 0 ? static_cast<std::size_t>(*bytes) : 0};
}

void skip_set(Cursor& cursor) {
  while (!cursor.done() && !is_delimiter(cursor.next())) {
  }
}

void read_set(Cursor& cursor, std::string_view line, UffFile& file) {
  const auto kind = cell(line, 0, 7);
  if (kind != "58" && kind != "58b") {
    if (small_whole(cell(line, 0, 6)) <= 0) {
      cursor.problems.add(cursor.line, 1,
                          fmt::format("{}: must be the number of a data set, 58 or 58b "
                                      "for a function",
                                      excerpt(line)));
      return;
    }
    file.others.push_back(small_whole(cell(line, 0, 6)));
    skip_set(cursor);
    return;
  }
  Uff58 set;
  set.line = cursor.line;
  set.binary = kind == "58b";
  std::optional<Layout> layout;
  if (set.binary) {
    layout = layout_of(line, cursor);
    if (!layout) {
      skip_set(cursor);
      return;
    }
  }
  if (!read_head(cursor, set)) {
    skip_set(cursor);
    return;
  }
  if (set.binary) {
    read_binary_data(cursor, *layout, set);
  } else {
    read_text_data(cursor, set);
  }
  file.sets.push_back(std::move(set));
}

}  // namespace

bool is_uff(std::string_view begin) {
  return is_delimiter(begin.substr(0, begin.find('\n')));
}

UffFile read_uff(std::string_view text, const std::string& name) {
  Cursor cursor{.text = text, .problems = {name, {}}};
  UffFile file;
  while (!cursor.done() && !cursor.problems.full()) {
    const auto line = cursor.next();
    if (trimmed(line, " \t\r").empty()) continue;
    if (!is_delimiter(line)) {
      cursor.problems.add(
          cursor.line, 1,
          fmt::format("{}: a data set must begin with a line that contains "
                      "only -1",
                      excerpt(line)));
      break;
    }
    if (!cursor.done()) read_set(cursor, cursor.next(), file);
  }
  if (!cursor.problems.lines.empty()) {
    throw base::InputError(cursor.problems.lines);
  }
  return file;
}

}  // namespace trochoid::files
