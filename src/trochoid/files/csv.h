#pragma once

#include <cstddef>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Lines, fields and numbers of delimited text, each with the place where it stands.
namespace trochoid::files {

/// What is wrong with one file, as finished lines `file:line:col: ...`.
struct Problems {
  std::string file;
  std::vector<std::string> lines;

  /// @param line  from 1; 0: the file has no lines
  void add(std::size_t line, std::size_t column, const std::string& text);
  /// So many that reading on is of no use.
  [[nodiscard]] bool full() const noexcept { return lines.size() >= 1000; }
};

/// @brief A text without the blanks around it.
std::string_view trimmed(std::string_view text, std::string_view blanks = " \t");

/// @brief The same text in small letters, those of ASCII.
std::string small_letters(std::string_view text);

/// @return the first bytes of a file, which then stands at its beginning again
std::string first_bytes(std::istream& in, std::size_t count);

/// @brief Text of a file for a message: at most 40 bytes, all of them printable ASCII.
std::string excerpt(std::string_view text);

/// @brief Reads lines (LF or CR LF) with memory for one line only.
class LineReader {
 public:
  /// Longer lines are no table of numbers; they are refused before they are stored.
  static constexpr std::size_t longest = std::size_t{1} << 16;

  explicit LineReader(std::istream& in);
  /// @return the next line without its end; valid until the next call. None: no more
  /// lines, or (see `too_long`) the line is too long.
  std::optional<std::string_view> next();
  /// Number of the line returned last, from 1.
  [[nodiscard]] std::size_t number() const noexcept { return number_; }
  [[nodiscard]] bool too_long() const noexcept { return too_long_; }
  /// Whether the line returned last had an end.
  [[nodiscard]] bool terminated() const noexcept { return terminated_; }

 private:
  bool fill();

  std::istream& in_;
  std::vector<char> buffer_;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  std::size_t number_ = 0;
  bool too_long_ = false;
  bool terminated_ = true;
};

struct Field {
  std::string_view text;   ///< without blanks and quotes around it
  std::size_t column = 1;  ///< place of the text in its line, from 1
};

/// @brief Split a line at a separator; one inside double quotes does not count.
void split(std::string_view line, char separator, std::vector<Field>& fields);

/// @brief Column of the first control character of a line, from 1; none: it is text.
std::optional<std::size_t> control_character(std::string_view line);

enum class NumberFault { none, missing, not_a_number, not_finite, out_of_range };

struct Number {
  double value = 0.0;
  NumberFault fault = NumberFault::none;
};

/// @brief Read a whole field as a number, with a decimal point or a decimal comma.
Number parse_number(std::string_view text);

/// @brief Whether all numbers of a file write their decimals in one way.
///
/// A comma can mean decimals or thousands. Commas are taken for decimals only if no
/// point occurs in the file and at least one comma cannot separate thousands: `0,125`,
/// `1,5`, `1234,567`.
struct DecimalStyle {
  std::size_t comma_line = 0;  ///< of the first comma; 0: none
  std::size_t comma_column = 0;
  std::string comma_text;
  std::size_t point_line = 0;  ///< of the first point; 0: none
  bool proven = false;

  /// @param text  a field that parse_number accepts
  void see(std::string_view text, std::size_t line, std::size_t column);
  void check(Problems& problems) const;
};

}  // namespace trochoid::files
