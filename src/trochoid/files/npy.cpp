#include <trochoid/files/npy.h>

#include <trochoid/files/npy_head.h>
#include <trochoid/files/numeric_matrix.h>

#include <fmt/core.h>

#include <utility>

namespace trochoid::files {

namespace {

constexpr std::string_view magic = "\x93NUMPY";
constexpr std::uint64_t longest_npy_head = 1U << 20U;

/// The array of a file: what it says of itself, and where its items begin.
struct NpyArray {
  NpyHead head;
  std::uint64_t data = 0;
  std::size_t rows = 0;
  std::size_t columns = 1;
};

NpyHead read_head(std::istream& in, const std::string& name, std::uint64_t& data) {
  const auto begin = bytes_at(in, 0, 12);
  ByteCursor cursor{.left = begin ? std::string_view(*begin) : std::string_view()};
  cursor.text(magic.size());
  const auto major = cursor.take<std::uint8_t>();
  cursor.take<std::uint8_t>();
  const std::uint64_t length =
      major == 1 ? cursor.take<std::uint16_t>() : cursor.take<std::uint32_t>();
  const std::uint64_t at = major == 1 ? 10 : 12;
  const auto text = cursor.short_of || length > longest_npy_head
                        ? std::optional<std::string>()
                        : bytes_at(in, at, length);
  if (!text || major < 1 || major > 3) {
    refuse(name,
           "the description of this NumPy array ends before its end: the file is "
           "cut off or damaged");
  }
  data = at + length;
  return npy_head(*text, name);
}

NpyArray array_of(std::istream& in, const std::string& name) {
  NpyArray array;
  array.head = read_head(in, name, array.data);
  const auto& shape = array.head.shape;
  const bool structured = !array.head.fields.front().name.empty();
  if (shape.empty() || shape.size() > 2 || (structured && shape.size() == 2)) {
    refuse(name, fmt::format("this NumPy array has {} dimensions: samples of {} are "
                             "needed",
                             shape.size(),
                             structured ? "fields, one dimension,"
                                        : "3 or 4 columns, two dimensions,"));
  }
  const std::uint64_t there = size_of(in) - array.data;
  const std::uint64_t rows = shape[0];
  const std::uint64_t columns = shape.size() == 2 ? shape[1] : 1;
  const std::uint64_t items = there / array.head.item_bytes;
  // Neither product nor quotient of what may be anything overflows.
  const bool fits = columns == 0 || rows <= items / columns;
  if (!fits || rows * columns * array.head.item_bytes != there) {
    refuse(name, fmt::format(
                     "this NumPy array is to have {} x {} items of {} bytes, {} bytes "
                     "follow: the file is cut off or damaged, or has several arrays",
                     rows, columns, array.head.item_bytes, there));
  }
  array.rows = static_cast<std::size_t>(rows);
  array.columns = static_cast<std::size_t>(columns);
  return array;
}

/// Where the numbers of a field lie, in a part of the matrix.
NumberRun run_of(const NpyArray& array, const NpyField& field, const MatrixPart& part) {
  const std::uint64_t item = array.head.item_bytes;
  std::uint64_t down = item * array.columns;
  std::uint64_t across = item;
  if (array.head.fortran_order) {
    down = item;
    across = item * array.rows;
  }
  return {.kind = *field.kind,
          .order = field.order,
          .offset = array.data + field.offset + part.column.value_or(0) * across +
                    part.row.value_or(0) * down,
          .count = part.count(),
          .stride = part.row ? across : down};
}

}  // namespace

bool is_npy(std::string_view head) {
  return head.starts_with(magic);
}

signal::Record read_npy_record(std::istream& in, const std::string& name,
                               const RecordSource& source) {
  const NpyArray array = array_of(in, name);
  NumericTable table;
  std::vector<NumberRun> runs;
  for (const NpyField& field : array.head.fields) {
    if (!field.kind) continue;
    const std::string leaf = field.name.empty() ? "array" : field.name;
    for (auto& [column, part] :
         matrix_columns({.name = leaf, .path = leaf}, array.rows, array.columns)) {
      table.columns.push_back(std::move(column));
      runs.push_back(run_of(array, field, part));
    }
  }
  name_only_matrix(table, name, source);
  table.values = [&](std::size_t i) {
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(runs[i].count));
    if (!read_run(in, runs[i], values))
      refuse(name, "the file cannot be read to its end");
    return values;
  };
  return record_of(table, name, source);
}

}  // namespace trochoid::files
