#include <trochoid/files/zip.h>

#include <trochoid/files/inflate.h>
#include <trochoid/files/number_run.h>

#include <algorithm>
#include <array>

namespace trochoid::files {

namespace {

constexpr std::uint32_t end_mark = 0x06054b50;
constexpr std::uint32_t entry_mark = 0x02014b50;
constexpr std::uint32_t local_mark = 0x04034b50;
constexpr std::uint64_t end_size = 22;
constexpr std::uint64_t local_size = 30;
constexpr std::uint64_t longest_comment = 0xFFFF;
constexpr std::uint64_t largest_directory = 1U << 20U;
/// Deflate packs no better than this.
constexpr std::uint64_t best_ratio = 1032;

constexpr auto check_table = [] {
  std::array<std::uint32_t, 256> table{};
  for (std::uint32_t i = 0; i < 256; ++i) {
    std::uint32_t c = i;
    for (int bit = 0; bit < 8; ++bit) {
      c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
    }
    table[i] = c;
  }
  return table;
}();

std::uint32_t check_of(std::string_view bytes) {
  std::uint32_t check = 0xFFFFFFFFU;
  for (const char c : bytes) {
    check =
        check_table[(check ^ static_cast<unsigned char>(c)) & 0xFFU] ^ (check >> 8U);
  }
  return ~check;
}

/// Where the directory stands: the last thing of an archive but for a comment.
struct Directory {
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
};

std::optional<Directory> find_directory(std::istream& in) {
  const std::uint64_t whole = size_of(in);
  if (whole < end_size) return std::nullopt;
  const std::uint64_t tail = std::min(whole, end_size + longest_comment);
  const auto bytes = bytes_at(in, whole - tail, tail);
  if (!bytes) return std::nullopt;
  const auto at = bytes->rfind("PK\x05\x06");
  if (at == std::string::npos) return std::nullopt;
  ByteCursor cursor{.left = std::string_view(*bytes).substr(at)};
  if (cursor.take<std::uint32_t>() != end_mark) return std::nullopt;
  cursor.text(8);
  Directory directory;
  directory.size = cursor.take<std::uint32_t>();
  directory.offset = cursor.take<std::uint32_t>();
  const bool sound = !cursor.short_of && directory.size <= largest_directory &&
                     directory.offset + directory.size <= whole;
  return sound ? std::optional(directory) : std::nullopt;
}

}  // namespace

std::optional<std::vector<ZipEntry>> zip_entries(std::istream& in) {
  const auto directory = find_directory(in);
  const auto bytes = directory ? bytes_at(in, directory->offset, directory->size)
                               : std::optional<std::string>();
  if (!bytes) return std::nullopt;
  std::vector<ZipEntry> entries;
  ByteCursor cursor{.left = *bytes};
  while (!cursor.left.empty()) {
    ZipEntry entry;
    if (cursor.take<std::uint32_t>() != entry_mark) return std::nullopt;
    cursor.text(4);
    entry.flags = cursor.take<std::uint16_t>();
    entry.method = cursor.take<std::uint16_t>();
    cursor.text(4);
    entry.check = cursor.take<std::uint32_t>();
    entry.packed = cursor.take<std::uint32_t>();
    entry.size = cursor.take<std::uint32_t>();
    const auto name = cursor.take<std::uint16_t>();
    const auto extra = cursor.take<std::uint16_t>();
    const auto comment = cursor.take<std::uint16_t>();
    cursor.text(8);
    entry.header = cursor.take<std::uint32_t>();
    entry.name = std::string(cursor.text(name));
    cursor.text(std::uint64_t{extra} + comment);
    if (cursor.short_of) return std::nullopt;
    entries.push_back(std::move(entry));
  }
  return entries;
}

std::optional<std::string> unzipped(std::istream& in, const ZipEntry& entry,
                                    std::uint64_t most, std::string& why) {
  const auto fails = [&](const char* text) {
    why = text;
    return std::nullopt;
  };
  const bool encrypted = (entry.flags & 1U) != 0;
  if (encrypted) return fails("is encrypted");
  if (entry.method != 0 && entry.method != 8) return fails("is packed in a rare way");
  if (entry.size > most) return fails("is too large");
  const auto begin = bytes_at(in, entry.header, local_size);
  ByteCursor cursor{.left = begin ? std::string_view(*begin) : std::string_view()};
  if (cursor.take<std::uint32_t>() != local_mark) return fails("is damaged");
  cursor.text(22);
  const std::uint64_t skip = cursor.take<std::uint16_t>();
  const std::uint64_t data =
      entry.header + local_size + skip + cursor.take<std::uint16_t>();
  const std::uint64_t whole = size_of(in);
  const bool sizes = entry.method == 0 ? entry.size == entry.packed
                                       : entry.size <= best_ratio * entry.packed;
  if (cursor.short_of || data > whole || entry.packed > whole - data || !sizes) {
    return fails("is damaged");
  }
  auto bytes = bytes_at(in, data, entry.packed);
  if (bytes && entry.method == 8) {
    if (!can_inflate())
      return fails("is packed, and this program was built without zlib");
    bytes = raw_inflated(*bytes, entry.size);
  }
  if (!bytes || check_of(*bytes) != entry.check) return fails("is damaged");
  return bytes;
}

}  // namespace trochoid::files
