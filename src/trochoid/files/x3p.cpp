#include <trochoid/files/number_run.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/surface_map.h>
#include <trochoid/files/zip.h>

#include <trochoid/files/csv.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace trochoid::files {

namespace {

constexpr std::uint64_t largest_description = 1U << 20U;

/// A tag: `Axes`, `/Axes` or `Axes/`, its prefix and attributes apart.
struct Tag {
  std::string_view name;
  bool opens = false;
  bool closes = false;
  std::size_t begin = 0;
  std::size_t end = 0;  ///< behind it
};

std::optional<Tag> next_tag(std::string_view xml, std::size_t from) {
  while (true) {
    const auto open = xml.find('<', from);
    if (open == std::string_view::npos) return std::nullopt;
    const bool comment = xml.substr(open).starts_with("<!--");
    const auto close = comment ? xml.find("-->", open + 4) : xml.find('>', open);
    if (close == std::string_view::npos) return std::nullopt;
    from = close + 1;
    if (comment || xml[open + 1] == '?' || xml[open + 1] == '!') continue;
    auto inner = xml.substr(open + 1, close - open - 1);
    const bool ends = inner.starts_with('/');
    const bool alone = inner.ends_with('/');
    if (ends) inner.remove_prefix(1);
    auto name = inner.substr(0, inner.find_first_of(" \t\r\n/"));
    if (const auto colon = name.find(':'); colon != std::string_view::npos) {
      name.remove_prefix(colon + 1);
    }
    return Tag{name, !ends, ends || alone, open, close + 1};
  }
}

/// What stands in the first element of a name; none: it is not there, or has no end.
std::optional<std::string_view> element(std::string_view xml, std::string_view name) {
  std::size_t depth = 0;
  std::size_t begin = 0;
  std::size_t at = 0;
  while (const auto tag = next_tag(xml, at)) {
    at = tag->end;
    if (tag->name != name) continue;
    if (tag->opens && tag->closes && depth == 0) return std::string_view();
    if (tag->opens && !tag->closes && depth++ == 0) begin = tag->end;
    if (tag->closes && !tag->opens) {
      if (depth == 0) return std::nullopt;
      if (--depth == 0) return xml.substr(begin, tag->begin - begin);
    }
  }
  return std::nullopt;
}

/// The description of a map, main.xml.
struct Description {
  std::string_view xml;
  const std::string& name;

  /// An element by the names from the outside on.
  [[nodiscard]] std::optional<std::string_view> text(
      std::initializer_list<std::string_view> path) const {
    std::optional<std::string_view> inner = xml;
    for (const auto part : path) {
      if (inner) inner = element(*inner, part);
    }
    return inner ? std::optional(trimmed(*inner, " \t\r\n")) : std::nullopt;
  }
  [[nodiscard]] double number(std::initializer_list<std::string_view> path,
                              std::optional<double> otherwise) const {
    const auto found = text(path);
    if (!found && otherwise) return *otherwise;
    const Number value = parse_number(found.value_or(""));
    if (value.fault != NumberFault::none) {
      refuse(name,
             fmt::format("{} in main.xml of this X3P file is {}: a number is needed",
                         *(path.end() - 1), found ? excerpt(*found) : "missing"));
    }
    return value.value;
  }
};

NumberKind kind_of_points(const Description& main) {
  const auto type = main.text({"Record1", "Axes", "CZ", "DataType"}).value_or("");
  if (type == "I") return NumberKind::i16;
  if (type == "L") return NumberKind::i32;
  if (type == "F") return NumberKind::f32;
  if (type == "D") return NumberKind::f64;
  refuse(main.name,
         fmt::format("DataType of CZ in main.xml of this X3P file is {}: must "
                     "be I, L, F or D",
                     excerpt(type)));
}

SurfaceMap described_map(const Description& main) {
  const auto feature = main.text({"Record1", "FeatureType"}).value_or("");
  if (feature != "SUR" && feature != "PRF") {
    refuse(main.name,
           fmt::format("this X3P file has {} instead of a map (SUR): export it as text "
                       "with columns X, Y, Z",
                       feature == "PCL" ? "a cloud of points" : excerpt(feature)));
  }
  SurfaceMap map;
  const double columns = main.number({"Record3", "MatrixDimension", "SizeX"}, {});
  const double rows = main.number({"Record3", "MatrixDimension", "SizeY"}, {});
  if (const auto wrong = wrong_size(columns, rows); !wrong.empty()) {
    refuse(main.name, wrong);
  }
  map.columns = static_cast<std::size_t>(columns);
  map.rows = static_cast<std::size_t>(rows);
  if (main.number({"Record3", "MatrixDimension", "SizeZ"}, 1.0) != 1.0) {
    refuse(main.name, "this X3P file has several layers: export the one that is meant");
  }
  constexpr std::array<std::string_view, 2> axes = {"CX", "CY"};
  const std::array sizes = {map.columns, map.rows};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::optional<double> free =
        sizes[i] == 1 ? std::optional(1.0) : std::nullopt;
    const auto type = main.text({"Record1", "Axes", axes[i], "AxisType"});
    if (sizes[i] > 1 && type != "I") {
      refuse(main.name,
             fmt::format("the points of this X3P file do not lie at equal "
                         "distances along {}: export it as text with columns "
                         "X, Y, Z",
                         axes[i]));
    }
    map.step[i] = main.number({"Record1", "Axes", axes[i], "Increment"}, free);
    map.offset[i] = main.number({"Record1", "Axes", axes[i], "Offset"}, 0.0);
    if (!(map.step[i] > 0.0)) {
      refuse(main.name, fmt::format("Increment of {} in main.xml of this X3P file: a "
                                    "number of metres above 0 is needed",
                                    axes[i]));
    }
  }
  return map;
}

struct Archive {
  std::istream& in;
  const std::string& name;
  std::vector<ZipEntry> entries;

  [[nodiscard]] const ZipEntry* find(std::string_view file) const {
    const auto at =
        std::find_if(entries.begin(), entries.end(),
                     [&](const ZipEntry& entry) { return entry.name == file; });
    return at == entries.end() ? nullptr : &*at;
  }
  [[nodiscard]] std::string unpack(std::string_view file, std::uint64_t most) const {
    const ZipEntry* entry = find(file);
    if (entry == nullptr) {
      refuse(name, fmt::format("this X3P file has no {}", excerpt(file)));
    }
    std::string why;
    auto bytes = unzipped(in, *entry, most, why);
    if (!bytes) refuse(name, fmt::format("{} in this X3P file {}", excerpt(file), why));
    return *std::move(bytes);
  }
};

void take_numbers(const Archive& archive, const Description& main, SurfaceMap& map) {
  const NumberKind kind = kind_of_points(main);
  const double factor = main.number({"Record1", "Axes", "CZ", "Increment"}, 1.0);
  const double offset = main.number({"Record1", "Axes", "CZ", "Offset"}, 0.0);
  const auto link = main.text({"Record3", "DataLink", "PointDataLink"});
  if (!link) {
    refuse(main.name,
           "this X3P file has its points in main.xml, which is not read: "
           "export it with binary data");
  }
  const std::uint64_t count = std::uint64_t{map.columns} * map.rows;
  const std::uint64_t size = count * size_of(kind);
  const std::string bytes = archive.unpack(*link, size);
  if (bytes.size() != size) {
    refuse(main.name, fmt::format("main.xml of this X3P file says {} x {} points of {} "
                                  "bytes, but {} has {} bytes",
                                  map.columns, map.rows, size_of(kind), excerpt(*link),
                                  bytes.size()));
  }
  map.z.resize(count);
  ByteCursor cursor{.left = bytes};
  for (double& z : map.z) {
    z = cursor.number(kind) * factor + offset;
  }
  const auto valid = main.text({"Record3", "DataLink", "ValidPointsLink"});
  if (!valid || valid->empty()) return;
  const std::string bits = archive.unpack(*valid, (count + 7) / 8);
  for (std::uint64_t k = 0; k < count; ++k) {
    const bool there = k / 8 < bits.size() &&
                       ((static_cast<unsigned char>(bits[k / 8]) >> (k % 8)) & 1U) != 0;
    if (!there) map.z[k] = std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

bool is_archive(std::string_view head) {
  return head.starts_with("PK\x03\x04");
}

SurfaceMap read_x3p(std::istream& in, const std::string& name) {
  Archive archive{in, name, zip_entries(in).value_or(std::vector<ZipEntry>())};
  if (archive.find("main.xml") == nullptr) {
    refuse(name + ":1:1",
           "this is a packed file, perhaps a spreadsheet, which is not read here: "
           "export it as CSV text in UTF-8, or as an X3P file");
  }
  const std::string xml = archive.unpack("main.xml", largest_description);
  const Description main{xml, name};
  SurfaceMap map = described_map(main);
  take_numbers(archive, main, map);
  return map;
}

}  // namespace trochoid::files
