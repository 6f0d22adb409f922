#pragma once

#include <trochoid/files/csv.h>
#include <trochoid/files/file_ref.h>

#include <istream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// A table of numbers in delimited text, while it is read. Separators are `,` `;` or a
/// tab, or blanks in a table that may do without names; decimals have a point or, where
/// nothing else can be meant, a comma; lines that begin with `#` are comments.
namespace trochoid::files {

/// How messages speak of a kind of table.
struct TableKind {
  std::string_view noun;            ///< `a record`
  std::string_view files;           ///< `a CSV file or a DynoWare text export`
  std::string_view row;             ///< `sample`
  std::string_view example;         ///< a row of names
  std::string_view comments = "#";  ///< marks that begin a comment
  std::string_view begins = {};     ///< of files with a head: their first words
};

struct TableText {
  TableText(std::istream& in, const std::string& name, const TableKind& kind_of_table)
      : lines(in), kind(kind_of_table) {
    problems.file = name;
  }

  LineReader lines;
  TableKind kind;
  Problems problems;
  DecimalStyle style;
  char separator = ',';
};

/// A column that is used: where it stands in every row.
struct TableColumn {
  std::size_t index = 0;
  double factor = 1.0;  ///< from the unit of the file to SI
  std::string name;
};

/// The head of a table: the row of names and, if there is one, the row of units.
struct TableHead {
  std::vector<Field> names;
  std::size_t names_line = 0;  ///< 0: the file has no lines
  std::vector<Field> units;    ///< empty: no such row
  std::size_t units_line = 0;
  bool paths = false;  ///< names may be paths: what follows a `/` need not be a unit
};

/// @brief Open a file that a case names.
/// @throws base::InputError when it is absent, no regular file, or empty
std::unique_ptr<std::istream> open_table(const FileRef& file, const TableKind& kind);

/// @brief All bytes of such a file.
std::string bytes_of(const FileRef& file, const TableKind& kind);

/// @brief The next line that holds something, comments too; none at the end or after a
/// problem.
std::optional<std::string_view> next_line(TableText& table);

/// Whether a line that holds something is a comment.
bool is_comment(const TableText& table, std::string_view line) noexcept;

/// @brief The next line that is no comment.
std::optional<std::string_view> next_content(TableText& table);

/// @brief Split a line; of a table separated by blanks, where there are any.
void split_row(const TableText& table, std::string_view line,
               std::vector<Field>& fields);

/// @brief Settle the separator, by `sep=;` or by the row of names.
/// @param line  the first line of the table
/// @return the row of names
std::string names_row(TableText& table, std::string_view line);

/// @brief Split the row of names, which has just been read.
TableHead head_of(const TableText& table, std::string_view names);

/// @brief Take the row of units, if the line after the names is one.
/// @param line    the first line after the names, or none
/// @param fields  of that line
void take_units(TableText& table, const std::vector<Field>& fields, TableHead& head);

/// @brief Whether a row has a field for each of `count` columns, or what it lacks.
bool complete_row(TableText& table, std::vector<Field>& fields, std::size_t count);

/// @brief A field as a number times a factor; a problem and 0 when it is none.
/// @param name  of its column, empty: it has none
double number_in_field(TableText& table, const Field& field, double factor,
                       std::string_view name);

/// @brief One number of a row, in SI; a problem and 0 when it is none.
double number_in_row(TableText& table, const std::vector<Field>& fields,
                     const TableColumn& column);

/// @throws base::InputError if there are problems
void throw_problems(const TableText& table);

}  // namespace trochoid::files
