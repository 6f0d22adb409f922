#include <fmt/core.h>
#include <trochoid/base/error.h>
#include <trochoid/files/csv.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace trochoid::files {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Whether commas of this text might separate groups of three digits.
bool may_be_thousands(std::string_view text) {
  const auto comma = text.find(',');
  std::size_t before = 0;
  while (before < comma && is_digit(text[comma - 1 - before])) ++before;
  std::size_t after = 0;
  while (comma + 1 + after < text.size() && is_digit(text[comma + 1 + after])) ++after;
  const bool leading_zero = before > 0 && text[comma - before] == '0';
  return after == 3 && before >= 1 && before <= 3 && !leading_zero &&
         comma + 1 + after == text.size();
}

}  // namespace

std::string_view trimmed(std::string_view text, std::string_view blanks) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::string small_letters(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::string first_bytes(std::istream& in, std::size_t count) {
  std::string head(count, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  in.clear();
  if (!in.seekg(0)) throw std::invalid_argument("the stream cannot be set back");
  return head;
}

void Problems::add(std::size_t line, std::size_t column, const std::string& text) {
  if (full()) return;
  lines.push_back(line == 0 ? fmt::format("{}: {}", file, text)
                            : fmt::format("{}:{}:{}: {}", file, line, column, text));
}

std::string excerpt(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string out = "\"";
  for (const char c : text.substr(0, most)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte >= 0x7f) {
      out += fmt::format("\\x{:02X}", byte);
    } else {
      out += c;
    }
  }
  return out + (text.size() > most ? "...\"" : "\"");
}

LineReader::LineReader(std::istream& in) : in_(in), buffer_(4 * longest) {}

bool LineReader::fill() {
  std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
  end_ -= begin_;
  begin_ = 0;
  in_.read(buffer_.data() + end_, static_cast<std::streamsize>(buffer_.size() - end_));
  if (in_.bad()) {
    throw base::InputError({"the disk does not give a file that is read to its end"});
  }
  const auto got = static_cast<std::size_t>(in_.gcount());
  end_ += got;
  return got > 0;
}

std::optional<std::string_view> LineReader::next() {
  if (too_long_) return std::nullopt;
  const auto find_end = [&] {
    return static_cast<const char*>(
        std::memchr(buffer_.data() + begin_, '\n', end_ - begin_));
  };
  const char* end = find_end();
  while (end == nullptr && end_ - begin_ <= longest && fill()) end = find_end();
  const char* start = buffer_.data() + begin_;
  const bool found = end != nullptr;
  auto length = found ? static_cast<std::size_t>(end - start) : end_ - begin_;
  if (!found && length == 0) return std::nullopt;
  terminated_ = found;
  ++number_;
  begin_ += length + (found ? 1 : 0);
  if (length > longest) {
    too_long_ = true;
    return std::nullopt;
  }
  if (length > 0 && start[length - 1] == '\r') --length;
  return std::string_view(start, length);
}

void split(std::string_view line, char separator, std::vector<Field>& fields) {
  fields.clear();
  std::size_t begin = 0;
  bool quoted = false;  // a mark within a field, `z / "`, is a part of it
  bool inside = false;
  bool blank = true;  // so far
  for (std::size_t i = 0; i <= line.size(); ++i) {
    if (i < line.size() && line[i] == '"') {
      quoted = quoted || blank;
      inside = quoted && !inside;
    }
    if (i < line.size() && (inside || line[i] != separator)) {
      blank = blank && (line[i] == ' ' || line[i] == '\t');
      continue;
    }
    auto text = trimmed(line.substr(begin, i - begin));
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
      text = trimmed(text.substr(1, text.size() - 2));
    }
    const auto column = text.empty()
                            ? begin + 1
                            : static_cast<std::size_t>(text.data() - line.data()) + 1;
    fields.push_back({text, column});
    begin = i + 1;
    quoted = false;
    blank = true;
  }
}

std::optional<std::size_t> control_character(std::string_view line) {
  const auto at = std::find_if(line.begin(), line.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (byte < 0x20 && c != '\t') || byte == 0x7f;
  });
  if (at == line.end()) return std::nullopt;
  return static_cast<std::size_t>(at - line.begin()) + 1;
}

Number parse_number(std::string_view text) {
  if (text.empty()) return {.value = 0.0, .fault = NumberFault::missing};
  std::array<char, 64> copy{};
  const auto comma = text.find(',');
  if (comma != std::string_view::npos) {
    if (text.size() > copy.size() || text.find('.') != std::string_view::npos) {
      return {.value = 0.0, .fault = NumberFault::not_a_number};
    }
    std::copy(text.begin(), text.end(), copy.begin());
    copy[comma] = '.';
    text = {copy.data(), text.size()};
  }
  // from_chars takes no plus sign.
  if (text.size() > 1 && text[0] == '+' && (is_digit(text[1]) || text[1] == '.')) {
    text.remove_prefix(1);
  }
  Number number;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, number.value);
  if (error == std::errc::invalid_argument || stop != end) {
    number.fault = NumberFault::not_a_number;
  } else if (error == std::errc::result_out_of_range) {
    number.fault = NumberFault::out_of_range;
  } else if (!std::isfinite(number.value)) {
    number.fault = NumberFault::not_finite;
  }
  return number;
}

void DecimalStyle::see(std::string_view text, std::size_t line, std::size_t column) {
  if (text.find(',') != std::string_view::npos) {
    if (comma_line == 0) {
      comma_line = line;
      comma_column = column;
      comma_text = std::string(text);
    }
    proven = proven || !may_be_thousands(text);
  } else if (point_line == 0 && text.find('.') != std::string_view::npos) {
    point_line = line;
  }
}

void DecimalStyle::check(Problems& problems) const {
  if (comma_line == 0) return;
  if (point_line != 0) {
    problems.add(comma_line, comma_column,
                 fmt::format("{} has a comma, but line {} has a decimal point: write "
                             "all numbers with decimal points",
                             excerpt(comma_text), point_line));
  } else if (!proven) {
    problems.add(comma_line, comma_column,
                 fmt::format("{} can be read with thousands or with decimals: write "
                             "all numbers with decimal points",
                             excerpt(comma_text)));
  }
}

}  // namespace trochoid::files
