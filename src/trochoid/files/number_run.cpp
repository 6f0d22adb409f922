#include <trochoid/files/number_run.h>

#include <algorithm>
#include <cmath>

namespace trochoid::files {

namespace {

/// So many bytes are read at once.
constexpr std::uint64_t block_bytes = 1U << 20U;
/// Numbers farther apart are fetched one by one.
constexpr std::uint64_t far_apart = 1U << 16U;

bool read_at(std::istream& in, std::uint64_t offset, std::string& bytes) {
  in.clear();
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  return static_cast<std::size_t>(in.gcount()) == bytes.size();
}

double number_in(const NumberRun& run, std::string_view bytes) {
  ByteCursor cursor{.left = bytes, .order = run.order};
  const double value = cursor.number(run.kind);
  if (!run.bit) return value;
  return (static_cast<std::uint64_t>(value) >> *run.bit) & 1U ? 1.0 : 0.0;
}

bool read_block(std::istream& in, const NumberRun& run, std::uint64_t offset,
                std::vector<double>& numbers) {
  const std::uint64_t size = size_of(run.kind);
  const std::uint64_t at_once =
      run.stride > far_apart ? 1 : std::max<std::uint64_t>(1, block_bytes / run.stride);
  std::string bytes;
  for (std::uint64_t done = 0; done < run.count; done += at_once) {
    const std::uint64_t rows = std::min(at_once, run.count - done);
    bytes.resize(static_cast<std::size_t>((rows - 1) * run.stride + size));
    if (!read_at(in, offset + done * run.stride, bytes)) return false;
    for (std::uint64_t i = 0; i < rows; ++i) {
      numbers.push_back(number_in(
          run, std::string_view(bytes).substr(static_cast<std::size_t>(i * run.stride),
                                              static_cast<std::size_t>(size))));
    }
  }
  return true;
}

/// Whether `count` things, each `stride` after the one before and the last one `size`
/// long, end within `room`.
bool fits(std::uint64_t count, std::uint64_t stride, std::uint64_t size,
          std::uint64_t room) {
  if (count == 0) return true;
  return size <= room &&
         (count == 1 || stride == 0 || count - 1 <= (room - size) / stride);
}

}  // namespace

std::size_t size_of(NumberKind kind) noexcept {
  switch (kind) {
    case NumberKind::i8:
    case NumberKind::u8:
      return 1;
    case NumberKind::i16:
    case NumberKind::u16:
      return 2;
    case NumberKind::i32:
    case NumberKind::u32:
    case NumberKind::f32:
      return 4;
    case NumberKind::i64:
    case NumberKind::u64:
    case NumberKind::f64:
      return 8;
    case NumberKind::timestamp:
      return 16;
  }
  return 1;
}

std::uint64_t size_of(std::istream& in) {
  in.clear();
  const auto stood = in.tellg();
  in.seekg(0, std::ios::end);
  const auto end = in.tellg();
  in.clear();
  in.seekg(stood);
  return end < 0 ? 0 : static_cast<std::uint64_t>(end);
}

bool inside(const NumberRun& run, std::uint64_t file_size) noexcept {
  const std::uint64_t size = size_of(run.kind);
  if (run.offset > file_size) return false;
  const std::uint64_t room = file_size - run.offset;
  if (run.count == 0 || run.blocks == 0) return true;
  if (run.stride < 1 || !fits(run.count, run.stride, size, room)) return false;
  const std::uint64_t block = (run.count - 1) * run.stride + size;
  return fits(run.blocks, run.block_stride, block, room);
}

bool read_run(std::istream& in, const NumberRun& run, std::vector<double>& numbers) {
  for (std::uint64_t block = 0; block < run.blocks; ++block) {
    if (!read_block(in, run, run.offset + block * run.block_stride, numbers)) {
      return false;
    }
  }
  return true;
}

std::optional<std::string> bytes_at(std::istream& in, std::uint64_t offset,
                                    std::uint64_t count) {
  const std::uint64_t end = size_of(in);
  if (offset > end || count > end - offset) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(count), '\0');
  if (!read_at(in, offset, bytes)) return std::nullopt;
  return bytes;
}

double ByteCursor::number(NumberKind kind) {
  switch (kind) {
    case NumberKind::i8:
      return static_cast<std::int8_t>(take<std::uint8_t>());
    case NumberKind::i16:
      return static_cast<std::int16_t>(take<std::uint16_t>());
    case NumberKind::i32:
      return static_cast<std::int32_t>(take<std::uint32_t>());
    case NumberKind::i64:
      return static_cast<double>(static_cast<std::int64_t>(take<std::uint64_t>()));
    case NumberKind::u8:
      return take<std::uint8_t>();
    case NumberKind::u16:
      return take<std::uint16_t>();
    case NumberKind::u32:
      return take<std::uint32_t>();
    case NumberKind::u64:
      return static_cast<double>(take<std::uint64_t>());
    case NumberKind::f32:
      return std::bit_cast<float>(take<std::uint32_t>());
    case NumberKind::f64:
      return std::bit_cast<double>(take<std::uint64_t>());
    case NumberKind::timestamp: {
      // Seconds and their 2^64th parts; in a file of the other order both are swapped.
      const bool big = order == std::endian::big;
      const auto first = take<std::uint64_t>();
      const auto second = take<std::uint64_t>();
      return static_cast<double>(static_cast<std::int64_t>(big ? first : second)) +
             std::ldexp(static_cast<double>(big ? second : first), -64);
    }
  }
  return 0.0;
}

}  // namespace trochoid::files
