#include "libcxx13.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

/// The fewest digits that are the number, as the shorter of 1234.5 and 1.2345e+03.
template <class Real>
std::string shortest(Real value) {
  const std::string fixed = fmt::format("{}", value);  // right but for its choice
  if (!std::isfinite(value)) return fixed;
  std::string digits;
  int exponent = 0;
  const std::size_t e = fixed.find('e');
  const std::string mantissa = fixed.substr(0, e);
  if (e != std::string::npos) exponent = std::atoi(fixed.c_str() + e + 1);
  const bool negative = mantissa.front() == '-';
  const std::string plain = mantissa.substr(negative ? 1 : 0);
  const std::size_t point = plain.find('.');
  exponent += static_cast<int>(point == std::string::npos ? plain.size() : point) - 1;
  for (const char c : plain) {
    if (c != '.') digits += c;
  }
  const std::size_t lead = digits.find_first_not_of('0');
  if (lead == std::string::npos) return negative ? "-0" : "0";
  digits.erase(0, lead);
  exponent -= static_cast<int>(lead);
  digits.erase(digits.find_last_not_of('0') + 1);
  const int n = static_cast<int>(digits.size());
  std::string scientific = digits.substr(0, 1);
  if (n > 1) scientific += "." + digits.substr(1);
  scientific += fmt::format("e{}{:02d}", exponent < 0 ? '-' : '+', std::abs(exponent));
  std::string point_form;
  if (exponent < 0) {
    point_form =
        "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  } else if (exponent >= n - 1) {
    // Exactly, as of a whole number of so many digits.
    point_form = fmt::format("{:.0f}", std::abs(value));
  } else {
    point_form = digits.substr(0, static_cast<std::size_t>(exponent) + 1) + "." +
                 digits.substr(static_cast<std::size_t>(exponent) + 1);
  }
  return (negative ? "-" : "") +
         (scientific.size() < point_form.size() ? scientific : point_form);
}

/// Whether the shortest form of a number has no exponent whatever its digits are.
bool has_no_power(double value) {
  const double size = std::abs(value);
  return size == 0.0 || (size >= 1e-3 && size < 1e5);
}

std::to_chars_result put(char* first, char* last, const std::string& text) {
  if (static_cast<std::size_t>(last - first) < text.size()) {
    return {last, std::errc::value_too_large};
  }
  std::memcpy(first, text.data(), text.size());
  return {first + text.size(), std::errc{}};
}

/// Tables are mostly numbers that need no choice: without a string for each.
template <class Real>
std::to_chars_result put_shortest(char* first, char* last, Real value) {
  if (!has_no_power(value)) return put(first, last, shortest(value));
  const auto room = static_cast<std::size_t>(last - first);
  const auto written = fmt::format_to_n(first, room, "{}", value);
  if (written.size > room) return {last, std::errc::value_too_large};
  return {written.out, std::errc{}};
}

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

const char* after_digits(const char* at, const char* last) {
  while (at != last && is_digit(*at)) ++at;
  return at;
}

/// Behind the longest number that a text begins with; its begin: there is none.
const char* end_of_number(const char* first, const char* last, bool may_have_power) {
  const char* at = first != last && *first == '-' ? first + 1 : first;
  for (const char* word : {"infinity", "inf", "nan"}) {
    const std::size_t n = std::strlen(word);
    if (static_cast<std::size_t>(last - at) >= n && strncasecmp(at, word, n) == 0) {
      return at + n;
    }
  }
  const char* whole = after_digits(at, last);
  const char* end = whole;
  auto digits = whole - at;
  if (end != last && *end == '.') {
    end = after_digits(end + 1, last);
    digits += end - whole - 1;
  }
  if (digits == 0) return first;
  if (may_have_power && end != last && (*end == 'e' || *end == 'E')) {
    const char* power = end + 1;
    if (power != last && (*power == '+' || *power == '-')) ++power;
    const char* behind = after_digits(power, last);
    if (behind != power) end = behind;
  }
  return end;
}

}  // namespace

namespace std {

to_chars_result to_chars(char* first, char* last, double value) {
  return put_shortest(first, last, value);
}

to_chars_result to_chars(char* first, char* last, float value) {
  return put_shortest(first, last, value);
}

to_chars_result to_chars(char* first, char* last, double value,
                         chars_format /*general*/, int precision) {
  return put(first, last, fmt::format("{:.{}g}", value, precision));
}

from_chars_result from_chars(const char* first, const char* last, double& value) {
  return from_chars(first, last, value, chars_format::general);
}

from_chars_result from_chars(const char* first, const char* last, double& value,
                             chars_format format) {
  const char* end = end_of_number(first, last, format != chars_format::fixed);
  if (end == first) return {first, errc::invalid_argument};
  errno = 0;
  const double read = strtod(string(first, end).c_str(), nullptr);
  if (errno == ERANGE) return {end, errc::result_out_of_range};
  value = read;
  return {end, errc{}};
}

}  // namespace std
