#include <trochoid/cases/number_text.h>

#include <fmt/core.h>

#include <array>
#include <charconv>

namespace trochoid::cases {

namespace {

/// The number of a file that times `unit` is `si`, with as few digits as possible.
double file_number(double si, double unit) {
  for (int digits = 1; digits <= 17; ++digits) {
    const std::string text = fmt::format("{:.{}g}", si / unit, digits);
    double number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    if (number * unit == si) {
      return number;
    }
  }
  return si / unit;
}

}  // namespace

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

std::string number_text(double si, double unit) {
  return number_text(file_number(si, unit));
}

std::string mm(double length) {
  return number_text(length, unit::mm);
}

double as_written(double si, double unit) {
  return file_number(si, unit) * unit;
}

std::string toml_string(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (code < 0x20 || code == 0x7F) {
      out += fmt::format("\\u{:04X}", code);
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace trochoid::cases
