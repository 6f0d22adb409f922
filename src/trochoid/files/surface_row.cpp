#include <trochoid/files/surface_row.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::files {

namespace {

bool equal_letters(std::string_view text, std::string_view small) {
  return std::equal(
      text.begin(), text.end(), small.begin(), small.end(),
      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
}

}  // namespace

bool is_missing(std::string_view text) {
  if (text.empty()) return true;
  const char c = text.front();
  if (c >= '0' && c <= '9') return false;
  if (c == '-' || c == '*' || c == '?') {
    if (text.find_first_not_of(c) == std::string_view::npos) return true;
    if (c != '-') return false;
    text.remove_prefix(1);
  }
  return std::ranges::any_of(
      std::array<std::string_view, 8>{"nan", "n/a", "na", "#n/a", "null", "none", "bad",
                                      "1.#qnan"},
      [&](std::string_view mark) { return equal_letters(text, mark); });
}

bool is_text(const Field& field) {
  return !is_missing(field.text) &&
         parse_number(field.text).fault == NumberFault::not_a_number;
}

bool is_rule(std::string_view line) {
  const auto has = [&](std::string_view part) {
    return line.find(part) != std::string_view::npos;
  };
  return line.find_first_not_of("-=_+| \t") == std::string_view::npos &&
         (has("---") || has("===") || has("___"));
}

void put_below(std::span<const Field> names, std::vector<Field>& fields) {
  if (fields.size() >= names.size()) return;
  const auto middle = [](const Field& field) {
    return static_cast<double>(field.column) +
           0.5 * static_cast<double>(field.text.size());
  };
  std::vector<Field> row(names.size());
  for (const Field& field : fields) {
    const auto nearest = std::min_element(names.begin(), names.end(),
                                          [&](const Field& a, const Field& b) {
                                            return std::abs(middle(a) - middle(field)) <
                                                   std::abs(middle(b) - middle(field));
                                          });
    Field& place = row[static_cast<std::size_t>(nearest - names.begin())];
    if (!place.text.empty()) return;
    place = field;
  }
  fields = std::move(row);
}

double last_decimal_of(std::string_view text) {
  const auto point = text.find_first_of(".,");
  if (point == std::string_view::npos) return 1.0;
  const auto end = std::min(text.find_first_of("eE", point), text.size());
  return std::pow(10.0, -static_cast<double>(end - point - 1));
}

}  // namespace trochoid::files
