#include <trochoid/files/numeric_table.h>
#include <trochoid/files/tdms_segments.h>

#include <fmt/core.h>

#include <algorithm>
#include <limits>

namespace trochoid::files {

namespace {

constexpr std::uint64_t lead_in_bytes = 28;
constexpr std::uint64_t not_finished = std::numeric_limits<std::uint64_t>::max();

/// Bits of the table of contents.
constexpr std::uint32_t has_metadata = 1U << 1U;
constexpr std::uint32_t new_list = 1U << 2U;
constexpr std::uint32_t has_raw_data = 1U << 3U;
constexpr std::uint32_t is_interleaved = 1U << 5U;
constexpr std::uint32_t is_big_endian = 1U << 6U;
constexpr std::uint32_t is_daqmx = 1U << 7U;

/// One segment, its sizes compared with the file.
struct Segment {
  std::uint64_t begin = 0;
  std::uint32_t contents = 0;
  std::uint64_t data = 0;  ///< where its raw data begin
  std::uint64_t end = 0;
  bool finished = true;

  [[nodiscard]] bool has(std::uint32_t bit) const { return (contents & bit) != 0; }
  [[nodiscard]] std::endian order() const {
    return has(is_big_endian) ? std::endian::big : std::endian::little;
  }
};

struct TdmsReading {
  std::istream& in;
  const std::string& name;
  std::uint64_t size = 0;
  TdmsFile file;
  std::map<std::string, std::size_t> places;
  std::vector<std::size_t> active;  ///< objects of the segment, in their order
};

Segment lead_in(TdmsReading& reading, std::uint64_t begin) {
  const auto bytes = bytes_at(reading.in, begin, lead_in_bytes);
  if (!bytes || !bytes->starts_with("TDSm")) {
    refuse(
        reading.name,
        fmt::format("at byte {} a segment must begin with TDSm{}: the file is damaged "
                    "or cut off",
                    begin + 1, bytes ? "" : ", but the file ends"));
  }
  ByteCursor cursor{.left = *bytes};
  cursor.text(4);
  Segment segment{.begin = begin, .contents = cursor.take<std::uint32_t>()};
  cursor.order = segment.order();
  cursor.take<std::uint32_t>();  // version
  const auto next = cursor.take<std::uint64_t>();
  const auto raw = cursor.take<std::uint64_t>();
  const std::uint64_t left = reading.size - begin - lead_in_bytes;
  segment.finished = next != not_finished;
  const std::uint64_t length = segment.finished ? next : left;
  if (length > left || raw > length) {
    refuse(
        reading.name,
        fmt::format("the segment at byte {} promises {} bytes, {} of them before its "
                    "data, but {} follow: the file is cut off or damaged",
                    begin + 1, length, raw, left));
  }
  segment.data = begin + lead_in_bytes + raw;
  segment.end = begin + lead_in_bytes + length;
  return segment;
}

void take_metadata(TdmsReading& reading, const Segment& segment) {
  if (!segment.has(has_metadata)) return;
  const std::uint64_t begin = segment.begin + lead_in_bytes;
  const auto bytes = bytes_at(reading.in, begin, segment.data - begin);
  ByteCursor cursor{.left = bytes ? std::string_view(*bytes) : std::string_view(),
                    .order = segment.order()};
  if (segment.has(new_list)) reading.active.clear();
  for (const std::size_t at :
       read_tdms_metadata(cursor, reading.name, reading.file.objects, reading.places)) {
    if (std::find(reading.active.begin(), reading.active.end(), at) ==
        reading.active.end()) {
      reading.active.push_back(at);
    }
  }
}

/// Objects that have data in this segment.
std::vector<TdmsObject*> with_data(TdmsReading& reading) {
  std::vector<TdmsObject*> objects;
  for (const std::size_t at : reading.active) {
    TdmsObject& object = reading.file.objects[at];
    if (object.has_data && object.layout) objects.push_back(&object);
  }
  return objects;
}

[[noreturn]] void refuse_data(const TdmsReading& reading, const Segment& segment,
                              std::string_view why) {
  refuse(reading.name,
         fmt::format("the {} bytes of data of the segment at byte {} {}: the "
                     "file is damaged or cut off",
                     segment.end - segment.data, segment.begin + 1, why));
}

/// How many whole chunks there are.
std::uint64_t chunks(const TdmsReading& reading, const Segment& segment,
                     std::uint64_t chunk_bytes) {
  const std::uint64_t there = segment.end - segment.data;
  if (chunk_bytes == 0) refuse_data(reading, segment, "belong to no channel");
  if (there < chunk_bytes && segment.finished) {
    refuse_data(reading, segment, "are fewer than its channels have");
  }
  if (there % chunk_bytes != 0 && segment.finished) {
    refuse_data(reading, segment,
                fmt::format("are no whole number of chunks of {} bytes", chunk_bytes));
  }
  return there / chunk_bytes;
}

/// A sum of sizes; beyond the size of the file its value does not matter.
std::uint64_t added(const TdmsReading& reading, std::uint64_t sum, std::uint64_t count,
                    std::uint64_t each) {
  const std::uint64_t most = reading.size + 1;
  if (each != 0 && count > most / each) return most;
  return std::min(sum + count * each, most);
}

std::uint64_t chunk_bytes(const TdmsReading& reading, const TdmsLayout& layout) {
  return layout.kind ? added(reading, 0, layout.values, size_of(*layout.kind))
                     : std::min(layout.bytes, reading.size + 1);
}

/// Each channel's block, one after another.
void take_contiguous(TdmsReading& reading, const Segment& segment,
                     const std::vector<TdmsObject*>& objects) {
  std::uint64_t all = 0;
  for (const auto* object : objects) {
    all = added(reading, all, 1, chunk_bytes(reading, *object->layout));
  }
  const std::uint64_t blocks = chunks(reading, segment, all);
  std::uint64_t offset = segment.data;
  for (auto* object : objects) {
    const auto& layout = *object->layout;
    if (layout.kind && blocks > 0) {
      object->runs.push_back({.kind = *layout.kind,
                              .order = segment.order(),
                              .offset = offset,
                              .count = layout.values,
                              .stride = size_of(*layout.kind),
                              .blocks = blocks,
                              .block_stride = all});
    }
    offset += chunk_bytes(reading, layout);
  }
}

/// One number of each channel, then the next of each.
void take_interleaved(TdmsReading& reading, const Segment& segment,
                      const std::vector<TdmsObject*>& objects) {
  std::uint64_t row = 0;
  for (const auto* object : objects) {
    if (!object->layout->kind)
      refuse_data(reading, segment, "contain texts between numbers");
    row += size_of(*object->layout->kind);
  }
  const std::uint64_t rows = chunks(reading, segment, row);
  std::uint64_t offset = segment.data;
  for (auto* object : objects) {
    const auto kind = *object->layout->kind;
    object->runs.push_back({.kind = kind,
                            .order = segment.order(),
                            .offset = offset,
                            .count = rows,
                            .stride = row});
    offset += size_of(kind);
  }
}

/// Scans of one or several buffers; in each buffer all channels have equally many.
void take_daqmx(TdmsReading& reading, const Segment& segment,
                const std::vector<TdmsObject*>& objects) {
  if (objects.empty() || !objects.front()->layout->daqmx) {
    refuse_data(reading, segment, "belong to no channel");
  }
  const auto widths = objects.front()->layout->widths;
  std::vector<std::uint64_t> scans(widths.size(), 0);
  for (const auto* object : objects) {
    const auto& layout = *object->layout;
    if (!layout.daqmx || layout.widths != widths) {
      refuse_data(reading, segment, "are described in two ways");
    }
    auto& of_buffer = scans[layout.daqmx->buffer];
    if (of_buffer != 0 && of_buffer != layout.values) {
      refuse_data(reading, segment, "have channels of several lengths in one buffer");
    }
    of_buffer = layout.values;
  }
  std::uint64_t all = 0;
  std::vector<std::uint64_t> begins;
  for (std::size_t b = 0; b < widths.size(); ++b) {
    begins.push_back(all);
    all = added(reading, all, scans[b], widths[b]);
  }
  const std::uint64_t blocks = chunks(reading, segment, all);
  for (auto* object : objects) {
    const auto& layout = *object->layout;
    const auto& scaler = *layout.daqmx;
    if (blocks == 0 || layout.values == 0) continue;
    object->runs.push_back(
        {.kind = scaler.kind,
         .order = segment.order(),
         .offset = segment.data + begins[scaler.buffer] + scaler.offset,
         .count = layout.values,
         .stride = widths[scaler.buffer],
         .blocks = blocks,
         .block_stride = all,
         .bit = scaler.bit});
  }
}

void take_data(TdmsReading& reading, const Segment& segment) {
  if (!segment.has(has_raw_data) || segment.end == segment.data) return;
  const auto objects = with_data(reading);
  if (segment.has(is_daqmx)) {
    take_daqmx(reading, segment, objects);
  } else if (segment.has(is_interleaved)) {
    take_interleaved(reading, segment, objects);
  } else {
    take_contiguous(reading, segment, objects);
  }
  for (const auto* object : objects) {
    if (!object->runs.empty() && !inside(object->runs.back(), segment.end)) {
      refuse_data(reading, segment, "are too few");
    }
  }
}

}  // namespace

std::uint64_t TdmsObject::count() const {
  std::uint64_t sum = 0;
  for (const auto& run : runs) sum += run.count * run.blocks;
  return sum;
}

TdmsFile read_tdms_segments(std::istream& in, const std::string& name) {
  TdmsReading reading{.in = in, .name = name, .size = size_of(in)};
  std::uint64_t at = 0;
  while (at < reading.size) {
    const Segment segment = lead_in(reading, at);
    take_metadata(reading, segment);
    take_data(reading, segment);
    reading.file.unfinished = reading.file.unfinished || !segment.finished;
    at = segment.end;
  }
  return std::move(reading.file);
}

}  // namespace trochoid::files
