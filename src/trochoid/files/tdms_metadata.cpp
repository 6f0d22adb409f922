#include <trochoid/files/csv.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/tdms_segments.h>

#include <fmt/core.h>

#include <array>

namespace trochoid::files {

namespace {

constexpr std::uint32_t no_data = 0xFFFFFFFF;
constexpr std::uint32_t as_before = 0;
constexpr std::uint32_t daqmx_scaler = 0x00001269;
constexpr std::uint32_t daqmx_line = 0x0000126A;
constexpr std::uint32_t text_type = 0x20;
constexpr std::uint32_t bool_type = 0x21;
constexpr std::uint32_t time_type = 0x44;
constexpr std::size_t most_tdms_objects = 10000;

/// Numbers by their codes; `with unit` is the same number.
std::optional<NumberKind> kind_of_type(std::uint32_t type) {
  switch (type) {
    case 1:
      return NumberKind::i8;
    case 2:
      return NumberKind::i16;
    case 3:
      return NumberKind::i32;
    case 4:
      return NumberKind::i64;
    case 5:
    case bool_type:
      return NumberKind::u8;
    case 6:
      return NumberKind::u16;
    case 7:
      return NumberKind::u32;
    case 8:
      return NumberKind::u64;
    case 9:
    case 0x19:
      return NumberKind::f32;
    case 10:
    case 0x1A:
      return NumberKind::f64;
    case time_type:
      return NumberKind::timestamp;
    default:
      return std::nullopt;
  }
}

/// Codes that DAQmx has for its raw numbers.
std::optional<NumberKind> daqmx_kind(std::uint32_t type) {
  constexpr std::array kinds = {NumberKind::u8,  NumberKind::i8,  NumberKind::u16,
                                NumberKind::i16, NumberKind::u32, NumberKind::i32};
  if (type >= kinds.size()) return std::nullopt;
  return kinds[type];
}

/// Bytes of a number that is passed over; 0: unknown.
std::uint64_t bytes_of_foreign(std::uint32_t type) {
  constexpr std::uint32_t complex_single = 0x08000C;
  constexpr std::uint32_t complex_double = 0x10000D;
  if (type == complex_single) return 8;
  return type == complex_double ? 16 : 0;
}

std::string_view text_of(ByteCursor& cursor) {
  return cursor.text(cursor.take<std::uint32_t>());
}

/// `/'group'/'channel'`, quotes inside doubled.
void split_path(std::string_view path, TdmsObject& object) {
  std::array<std::string, 2> parts;
  std::size_t part = 0;
  bool inside = false;
  for (std::size_t i = 0; i < path.size() && part < parts.size(); ++i) {
    if (path[i] != '\'') {
      if (inside) parts[part] += path[i];
    } else if (inside && i + 1 < path.size() && path[i + 1] == '\'') {
      parts[part] += path[i++];
    } else {
      inside = !inside;
      if (!inside) ++part;
    }
  }
  object.group = parts[0];
  object.channel = parts[1];
}

TdmsProperty property_of(ByteCursor& cursor, const std::string& name) {
  const auto type = cursor.take<std::uint32_t>();
  if (type == text_type) return std::string(text_of(cursor));
  if (const auto kind = kind_of_type(type)) return cursor.number(*kind);
  const std::uint64_t bytes = bytes_of_foreign(type);
  if (bytes == 0 && !cursor.short_of) {
    refuse(name, fmt::format("a property has the type 0x{:X}, which is not read: the "
                             "file is damaged, or save it again without it",
                             type));
  }
  cursor.text(bytes);
  return 0.0;
}

TdmsLayout daqmx_layout(ByteCursor& cursor, bool line, const TdmsObject& object,
                        const std::string& name) {
  TdmsLayout layout;
  cursor.take<std::uint32_t>();  // the type: DAQmx
  cursor.take<std::uint32_t>();  // dimensions: 1
  layout.values = cursor.take<std::uint64_t>();
  const auto scalers = cursor.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < scalers && !cursor.short_of; ++i) {
    DaqmxScaler scaler;
    const auto type = cursor.take<std::uint32_t>();
    scaler.buffer = cursor.take<std::uint32_t>();
    scaler.offset = cursor.take<std::uint32_t>();
    if (line) {
      scaler.bit = scaler.offset % 8U;
      scaler.offset /= 8U;
      cursor.take<std::uint8_t>();
    } else {
      cursor.take<std::uint32_t>();
    }
    scaler.scale = cursor.take<std::uint32_t>();
    const auto kind = daqmx_kind(type);
    if (!kind && !cursor.short_of) {
      refuse(name,
             fmt::format("channel {} has raw numbers of the type {}, which are not "
                         "read: save it as scaled numbers",
                         excerpt(object.channel), type));
    }
    if (!kind) break;
    scaler.kind = *kind;
    if (!layout.daqmx) layout.daqmx = scaler;
  }
  const auto buffers = cursor.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < buffers && !cursor.short_of; ++i) {
    layout.widths.push_back(cursor.take<std::uint32_t>());
  }
  if (cursor.short_of) return layout;
  const auto& scaler = layout.daqmx;
  if (!scaler || scaler->buffer >= layout.widths.size() ||
      scaler->offset + std::uint64_t{size_of(scaler->kind)} >
          layout.widths[scaler->buffer]) {
    refuse(name,
           fmt::format("channel {} has no place among the raw numbers of its scan: "
                       "the file is damaged",
                       excerpt(object.channel)));
  }
  layout.kind = scaler->kind;
  return layout;
}

TdmsLayout plain_layout(ByteCursor& cursor, const TdmsObject& object,
                        const std::string& name) {
  TdmsLayout layout;
  const auto type = cursor.take<std::uint32_t>();
  cursor.take<std::uint32_t>();  // dimensions: 1
  layout.values = cursor.take<std::uint64_t>();
  if (type == text_type) {
    layout.bytes = cursor.take<std::uint64_t>();
    return layout;
  }
  layout.kind = kind_of_type(type);
  if (layout.kind || cursor.short_of) return layout;
  const std::uint64_t each = bytes_of_foreign(type);
  if (each == 0 || layout.values > std::uint64_t{1} << 56U) {
    refuse(name, fmt::format("channel {} has numbers of the type 0x{:X}, which are not "
                             "read: save it as double numbers",
                             excerpt(object.channel), type));
  }
  layout.bytes = layout.values * each;
  return layout;
}

void read_layout(ByteCursor& cursor, TdmsObject& object, const std::string& name) {
  const auto index = cursor.take<std::uint32_t>();
  object.has_data = index != no_data;
  if (index == no_data) return;
  if (index == daqmx_scaler || index == daqmx_line) {
    object.layout = daqmx_layout(cursor, index == daqmx_line, object, name);
  } else if (index != as_before) {
    object.layout = plain_layout(cursor, object, name);
  } else if (!object.layout && !cursor.short_of) {
    refuse(name, fmt::format("channel {} has its data as in an earlier segment, but "
                             "there is none: the file is damaged",
                             excerpt(object.channel)));
  }
}

}  // namespace

std::vector<std::size_t> read_tdms_metadata(
    ByteCursor& metadata, const std::string& name, std::vector<TdmsObject>& known,
    std::map<std::string, std::size_t>& places) {
  std::vector<std::size_t> named;
  const auto count = metadata.take<std::uint32_t>();
  for (std::uint32_t i = 0; i < count && !metadata.short_of; ++i) {
    const auto path = std::string(text_of(metadata));
    const auto [at, is_new] = places.try_emplace(path, known.size());
    if (is_new) split_path(path, known.emplace_back());
    if (known.size() > most_tdms_objects) {
      refuse(name,
             fmt::format("the file has more than {} channels and groups: save the "
                         "forces alone",
                         most_tdms_objects));
    }
    TdmsObject& object = known[at->second];
    read_layout(metadata, object, name);
    const auto properties = metadata.take<std::uint32_t>();
    for (std::uint32_t p = 0; p < properties && !metadata.short_of; ++p) {
      auto key = std::string(text_of(metadata));
      object.properties[std::move(key)] = property_of(metadata, name);
    }
    named.push_back(at->second);
  }
  if (metadata.short_of) {
    refuse(name,
           "the description of a segment is longer than its place: the file is "
           "damaged");
  }
  return named;
}

}  // namespace trochoid::files
