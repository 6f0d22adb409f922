#include <trochoid/files/number_run.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/surface_map.h>

#include <trochoid/files/csv.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace trochoid::files {

namespace {

constexpr std::uint64_t binary_head = 81;
constexpr std::uint64_t largest_text = std::uint64_t{1} << 28U;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// What a file says of its data.
struct SdfHead {
  double points = 0.0;            ///< along X
  double profiles = 0.0;          ///< along Y
  std::array<double, 3> scale{};  ///< metres of a step, and of a unit of the data
  double compression = 0.0;
  double type = -1.0;
};

/// A type of data, and its number that stands for a point without a value.
struct SdfType {
  NumberKind kind;
  std::optional<double> none;
};

/// In the order of their codes.
const std::array<SdfType, 8> types{
    SdfType{NumberKind::u8, std::nullopt},   SdfType{NumberKind::u16, 65535.0},
    SdfType{NumberKind::u32, 4294967295.0},  SdfType{NumberKind::f32, std::nullopt},
    SdfType{NumberKind::i8, std::nullopt},   SdfType{NumberKind::i16, -32768.0},
    SdfType{NumberKind::i32, -2147483648.0}, SdfType{NumberKind::f64, std::nullopt}};

const SdfType& checked_type(const SdfHead& head, const std::string& name) {
  if (const auto wrong = wrong_size(head.points, head.profiles); !wrong.empty()) {
    refuse(name, wrong);
  }
  constexpr std::array keys = {"Xscale", "Yscale", "Zscale"};
  for (std::size_t i = 0; i < 3; ++i) {
    if (!std::isfinite(head.scale[i]) || head.scale[i] == 0.0 ||
        (i < 2 && head.scale[i] < 0.0)) {
      refuse(name, fmt::format("{} = {:g} of this SDF file: a number of metres above 0 "
                               "is needed",
                               keys[i], head.scale[i]));
    }
  }
  if (head.compression != 0.0) {
    refuse(name,
           "this SDF file is compressed, which is not read here: export it "
           "without compression");
  }
  const auto code = head.type;
  if (!(code >= 0.0 && code < static_cast<double>(types.size()))) {
    refuse(name,
           fmt::format("DataType = {:g} of this SDF file: must be from 0 to 7", code));
  }
  return types[static_cast<std::size_t>(code)];
}

SurfaceMap map_of(const SdfHead& head) {
  return {.columns = static_cast<std::size_t>(head.points),
          .rows = static_cast<std::size_t>(head.profiles),
          .step = {head.scale[0], head.scale[1]},
          .offset = {},
          .z = {}};
}

SurfaceMap read_binary(std::istream& in, const std::string& name) {
  const auto begin = bytes_at(in, 0, binary_head);
  if (!begin) refuse(name, "this SDF file ends within its head: it is cut off");
  ByteCursor cursor{.left = *begin};
  cursor.text(42);
  SdfHead head;
  head.points = cursor.take<std::uint16_t>();
  head.profiles = cursor.take<std::uint16_t>();
  for (double& scale : head.scale) {
    scale = cursor.number(NumberKind::f64);
  }
  cursor.text(8);
  head.compression = cursor.take<std::uint8_t>();
  head.type = cursor.take<std::uint8_t>();
  const SdfType& type = checked_type(head, name);
  SurfaceMap map = map_of(head);
  const std::uint64_t count = std::uint64_t{map.columns} * map.rows;
  const auto bytes = bytes_at(in, binary_head, count * size_of(type.kind));
  if (!bytes) {
    refuse(name, fmt::format("the head of this SDF file says {} x {} points, but the "
                             "file ends before: it is cut off",
                             map.columns, map.rows));
  }
  map.z.resize(count);
  ByteCursor data{.left = *bytes};
  for (double& z : map.z) {
    const double number = data.number(type.kind);
    z = number == type.none ? nan : number * head.scale[2];
  }
  return map;
}

std::string_view next_word(std::string_view& text) {
  constexpr std::string_view blanks = " \t\r\n,;";
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const auto word = text.substr(0, text.find_first_of(blanks));
  text.remove_prefix(word.size());
  return word;
}

void take_key(std::string_view line, const std::string& name, SdfHead& head) {
  const auto equal = line.find('=');
  if (equal == std::string_view::npos) return;
  const auto key = trimmed(line.substr(0, equal), " \t\r");
  double* target = key == "NumPoints"     ? &head.points
                   : key == "NumProfiles" ? &head.profiles
                   : key == "Xscale"      ? &head.scale[0]
                   : key == "Yscale"      ? &head.scale[1]
                   : key == "Zscale"      ? &head.scale[2]
                   : key == "Compression" ? &head.compression
                   : key == "DataType"    ? &head.type
                                          : nullptr;
  if (target == nullptr) return;
  const auto value = trimmed(line.substr(equal + 1), " \t\r");
  const Number number = parse_number(value);
  if (number.fault != NumberFault::none) {
    refuse(name, fmt::format("{} = {} of this SDF file: a number is needed", key,
                             excerpt(value)));
  }
  *target = number.value;
}

SurfaceMap read_text(std::istream& in, const std::string& name) {
  const std::uint64_t size = size_of(in);
  if (size > largest_text) {
    refuse(name, "this SDF file has more than 256 MiB: export it in binary");
  }
  const auto bytes = bytes_at(in, 0, size);
  std::string_view text = bytes ? std::string_view(*bytes) : std::string_view();
  SdfHead head;
  while (!text.empty()) {
    const auto line = trimmed(text.substr(0, text.find('\n')), " \t\r");
    text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    if (line.starts_with('*')) break;
    take_key(line, name, head);
  }
  const SdfType& type = checked_type(head, name);
  SurfaceMap map = map_of(head);
  const std::uint64_t count = std::uint64_t{map.columns} * map.rows;
  if (text.size() + 1 < 2 * count) {  // a digit and a blank each
    refuse(name, fmt::format("the head of this SDF file says {} x {} points, but the "
                             "file ends before: it is cut off",
                             map.columns, map.rows));
  }
  map.z.reserve(count);
  while (map.z.size() < count) {
    const auto word = next_word(text);
    const Number number = parse_number(word);
    const bool none =
        word == "BAD" || word == "bad" || number.fault == NumberFault::not_finite;
    if (!none && number.fault != NumberFault::none) {
      refuse(name,
             fmt::format("point {} of {} of this SDF file is {}: a number, or BAD, "
                         "is needed",
                         map.z.size() + 1, count, excerpt(word)));
    }
    map.z.push_back(none || number.value == type.none ? nan
                                                      : number.value * head.scale[2]);
  }
  return map;
}

}  // namespace

bool is_sdf(std::string_view head) {
  return head.starts_with("aISO-1.0") || head.starts_with("bISO-1.0");
}

SurfaceMap read_sdf(std::istream& in, const std::string& name) {
  const auto first = bytes_at(in, 0, 1);
  return first && first->front() == 'b' ? read_binary(in, name) : read_text(in, name);
}

}  // namespace trochoid::files
