#include <trochoid/files/csv.h>
#include <trochoid/files/inflate.h>
#include <trochoid/files/mat.h>
#include <trochoid/files/number_run.h>
#include <trochoid/files/numeric_matrix.h>

#include <fmt/core.h>

#include <algorithm>
#include <memory>

namespace trochoid::files {

namespace {

constexpr std::uint64_t head_bytes = 128;
constexpr std::uint32_t matrix_type = 14;
constexpr std::uint32_t compressed_type = 15;
constexpr std::uint32_t complex_flag = 0x0800;
constexpr int deepest_struct = 4;
/// Deflate packs at most 1032 to 1.
constexpr std::uint64_t densest = 1100;

/// Classes of arrays.
constexpr std::uint32_t struct_class = 2;
constexpr std::uint32_t object_class = 3;
constexpr std::uint32_t double_class = 6;
constexpr std::uint32_t uint64_class = 15;
constexpr std::uint32_t opaque_class = 17;

/// A variable of the file: a matrix, packed or not.
struct Variable {
  std::uint64_t offset = 0;  ///< of its data behind the tag
  std::uint64_t bytes = 0;
  bool packed = false;
};

/// An array of numbers within a variable.
struct MatArray {
  std::vector<std::string> path;  ///< the variable, then fields
  std::size_t rows = 0;
  std::size_t columns = 0;
  NumberKind kind = NumberKind::f64;
  std::string_view numbers;
};

struct MatReading {
  std::istream& in;
  std::string name;
  std::endian order = std::endian::little;
  std::vector<MatArray> arrays;  ///< of the variable that is read
  bool objects = false;          ///< there are tables perhaps
};

struct Element {
  std::uint32_t type = 0;
  std::string_view data;
};

/// What a column is taken from.
struct MatSource {
  Variable variable;
  std::vector<std::string> path;
  MatrixPart part;
};

/// A tag and its data; a few bytes may stand in the tag itself.
Element next_element(ByteCursor& cursor) {
  Element element;
  const auto first = cursor.take<std::uint32_t>();
  if (const std::uint32_t small = first >> 16U; small != 0) {
    element.type = first & 0xFFFFU;
    const auto field = cursor.text(4);
    if (small > field.size()) cursor.short_of = true;
    element.data = field.substr(0, small);
    return element;
  }
  element.type = first;
  const auto bytes = cursor.take<std::uint32_t>();
  element.data = cursor.text(bytes);
  const std::uint32_t over = bytes % 8U;
  // The last one of all may lack its padding.
  cursor.text(std::min<std::uint64_t>(over == 0 ? 0 : 8 - over, cursor.left.size()));
  return element;
}

std::optional<NumberKind> kind_of_number(std::uint32_t type) {
  switch (type) {
    case 1:
      return NumberKind::i8;
    case 2:
      return NumberKind::u8;
    case 3:
      return NumberKind::i16;
    case 4:
      return NumberKind::u16;
    case 5:
      return NumberKind::i32;
    case 6:
      return NumberKind::u32;
    case 7:
      return NumberKind::f32;
    case 9:
      return NumberKind::f64;
    case 12:
      return NumberKind::i64;
    case 13:
      return NumberKind::u64;
    default:
      return std::nullopt;
  }
}

[[noreturn]] void refuse_damaged(const MatReading& reading, const std::string& what) {
  refuse(reading.name, fmt::format("{}: the file is cut off or damaged", what));
}

bool read_matrix(MatReading& reading, std::string_view body,
                 std::vector<std::string> path, bool is_field);

/// The fields of a struct that stands alone.
bool read_fields(MatReading& reading, ByteCursor& cursor,
                 const std::vector<std::string>& path) {
  ByteCursor length{.left = next_element(cursor).data, .order = reading.order};
  const auto each = length.take<std::uint32_t>();
  const auto names = next_element(cursor).data;
  if (length.short_of || cursor.short_of || each == 0) return false;
  if (path.size() > deepest_struct) return true;
  for (std::size_t at = 0; at + each <= names.size(); at += each) {
    const auto field = names.substr(at, each);
    auto inner = path;
    inner.emplace_back(field.substr(0, std::min(field.find('\0'), field.size())));
    const Element element = next_element(cursor);
    if (cursor.short_of || element.type != matrix_type) return false;
    if (!element.data.empty() && !read_matrix(reading, element.data, inner, true)) {
      return false;
    }
  }
  return true;
}

bool read_numbers(MatReading& reading, ByteCursor& cursor, MatArray array) {
  const Element element = next_element(cursor);
  const auto kind = kind_of_number(element.type);
  if (cursor.short_of || !kind) return false;
  const std::uint64_t count = element.data.size() / size_of(*kind);
  // Neither product nor division of what may be anything overflows.
  if (array.rows != 0 && array.columns != 0 &&
      (count / array.rows != array.columns || count % array.rows != 0)) {
    return false;
  }
  array.kind = *kind;
  array.numbers = element.data;
  reading.arrays.push_back(std::move(array));
  return true;
}

/// @return false: sizes contradict one another
bool read_matrix(MatReading& reading, std::string_view body,
                 std::vector<std::string> path, bool is_field) {
  ByteCursor cursor{.left = body, .order = reading.order};
  ByteCursor flags{.left = next_element(cursor).data, .order = reading.order};
  const auto word = flags.take<std::uint32_t>();
  const std::uint32_t array_class = word & 0xFFU;
  if (flags.short_of || cursor.short_of) return false;
  if (array_class == opaque_class || array_class == object_class) {
    reading.objects = true;
    return true;
  }
  ByteCursor size{.left = next_element(cursor).data, .order = reading.order};
  const bool flat = size.left.size() == 8;
  const std::size_t rows = size.take<std::uint32_t>();
  const std::size_t columns = size.take<std::uint32_t>();
  const auto own_name = next_element(cursor).data;
  if (size.short_of || cursor.short_of) return false;
  if (!is_field) path.emplace_back(own_name);
  if (!flat) return true;
  if (array_class == struct_class && rows == 1 && columns == 1) {
    return read_fields(reading, cursor, path);
  }
  if (array_class < double_class || array_class > uint64_class ||
      (word & complex_flag) != 0) {
    return true;
  }
  return read_numbers(reading, cursor,
                      {.path = std::move(path), .rows = rows, .columns = columns});
}

/// The bytes of a variable, unpacked; a view of its matrix begins behind the tag.
std::string bytes_of(const MatReading& reading, const Variable& variable) {
  auto bytes = bytes_at(reading.in, variable.offset, variable.bytes);
  if (!bytes) refuse_damaged(reading, "the file ends within a variable");
  if (!variable.packed) return std::move(*bytes);
  if (!can_inflate()) {
    refuse(reading.name,
           "its variables are packed, and this program was built without "
           "zlib: save them with -v6, or as CSV");
  }
  const auto tag = inflated(*bytes, 8);
  ByteCursor cursor{.left = tag ? std::string_view(*tag) : std::string_view(),
                    .order = reading.order};
  const auto type = cursor.take<std::uint32_t>();
  const std::uint64_t size = cursor.take<std::uint32_t>();
  if (cursor.short_of || type != matrix_type) {
    refuse_damaged(reading, fmt::format("what is packed at byte {} is no variable",
                                        variable.offset + 1));
  }
  if (static_cast<double>(size) > largest_record || size > densest * variable.bytes) {
    refuse(reading.name,
           fmt::format("the variable at byte {} says that {} bytes come out of {}: at "
                       "most {:.2g} are read, and no packing is so dense; the file is "
                       "damaged, or save a part of the record",
                       variable.offset + 1, size, variable.bytes, largest_record));
  }
  auto whole = inflated(*bytes, size + 8);
  if (!whole) {
    refuse_damaged(reading, fmt::format("the variable packed at byte {} cannot be "
                                        "unpacked",
                                        variable.offset + 1));
  }
  return whole->substr(8);
}

/// The variables of the file, their sizes compared with its bytes.
std::vector<Variable> variables_of(MatReading& reading) {
  const std::uint64_t size = size_of(reading.in);
  const auto head = bytes_at(reading.in, 0, head_bytes);
  const bool big = head && head->ends_with("MI");
  if (!big && !(head && head->ends_with("IM"))) {
    refuse_damaged(reading, "the head of this MATLAB file says no byte order");
  }
  reading.order = big ? std::endian::big : std::endian::little;
  if (size == head_bytes) refuse_damaged(reading, "this MATLAB file has no variable");
  std::vector<Variable> variables;
  for (std::uint64_t at = head_bytes; at < size;) {
    const auto tag = bytes_at(reading.in, at, 8);
    ByteCursor cursor{.left = tag ? std::string_view(*tag) : std::string_view(),
                      .order = reading.order};
    const auto type = cursor.take<std::uint32_t>();
    const std::uint64_t bytes = cursor.take<std::uint32_t>();
    if (cursor.short_of || (type != matrix_type && type != compressed_type)) {
      refuse_damaged(reading, fmt::format("at byte {} no variable begins", at + 1));
    }
    if (bytes > size - at - 8) {
      refuse_damaged(reading, fmt::format("the variable at byte {} needs {} bytes, {} "
                                          "follow",
                                          at + 1, bytes, size - at - 8));
    }
    if (static_cast<double>(bytes) > largest_record) {
      refuse(reading.name, fmt::format("the variable at byte {} has {} bytes: at most "
                                       "{:.2g} are read; save a part of the record",
                                       at + 1, bytes, largest_record));
    }
    variables.push_back({at + 8, bytes, type == compressed_type});
    at += 8 + bytes;
  }
  return variables;
}

void read_arrays(MatReading& reading, const Variable& variable,
                 std::string_view bytes) {
  reading.arrays.clear();
  if (!read_matrix(reading, bytes, {}, false)) {
    refuse_damaged(reading,
                   fmt::format("the sizes of the variable at byte {} do not fit "
                               "its bytes",
                               variable.offset + 1));
  }
}

std::string joined(const std::vector<std::string>& path) {
  std::string text;
  for (const auto& part : path) text += (text.empty() ? "" : ".") + part;
  return text;
}

std::vector<double> values_of(MatReading& reading, const MatSource& source) {
  const auto bytes = bytes_of(reading, source.variable);
  read_arrays(reading, source.variable, bytes);
  const auto array =
      std::find_if(reading.arrays.begin(), reading.arrays.end(),
                   [&](const MatArray& other) { return other.path == source.path; });
  const auto& part = source.part;
  const std::size_t first =
      part.column ? *part.column * part.rows : part.row.value_or(0);
  const std::size_t step = part.row ? part.rows : 1;
  const std::size_t each = size_of(array->kind);
  std::vector<double> values(part.count());
  for (std::size_t i = 0; i < values.size(); ++i) {
    ByteCursor cursor{.left = array->numbers.substr((first + i * step) * each, each),
                      .order = reading.order};
    values[i] = cursor.number(array->kind);
  }
  return values;
}

}  // namespace

NumericTable mat5_table(std::istream& in, const std::string& name) {
  const auto reading = std::make_shared<MatReading>(MatReading{.in = in, .name = name});
  NumericTable table;
  std::vector<MatSource> sources;
  for (const Variable& variable : variables_of(*reading)) {
    const auto bytes = bytes_of(*reading, variable);
    read_arrays(*reading, variable, bytes);
    for (const MatArray& array : reading->arrays) {
      const NumericColumn like{.name = array.path.back(), .path = joined(array.path)};
      const auto taken = [&](const MatSource& other) {
        return other.path == array.path;
      };
      if (std::any_of(sources.begin(), sources.end(), taken)) continue;  // named twice
      for (auto& [column, part] : matrix_columns(like, array.rows, array.columns)) {
        table.columns.push_back(std::move(column));
        sources.push_back({variable, array.path, part});
      }
    }
  }
  if (reading->objects && table.columns.size() < 3) refuse_matlab_object(name);
  table.values = [reading, sources](std::size_t i) {
    return values_of(*reading, sources[i]);
  };
  return table;
}

}  // namespace trochoid::files
