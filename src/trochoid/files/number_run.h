#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Numbers in a binary file: of what kind they are, where they stand, and a reader that
/// never goes past the end.
namespace trochoid::files {

enum class NumberKind { i8, i16, i32, i64, u8, u16, u32, u64, f32, f64, timestamp };

/// Bytes of one number.
std::size_t size_of(NumberKind kind) noexcept;

/// Numbers that stand at equal distances, a whole block of them perhaps several times.
struct NumberRun {
  NumberKind kind = NumberKind::f64;
  std::endian order = std::endian::little;
  std::uint64_t offset = 0;  ///< of the first one in the file
  std::uint64_t count = 0;   ///< of one block
  std::uint64_t stride = 0;  ///< bytes from one to the next
  std::uint64_t blocks = 1;
  std::uint64_t block_stride = 0;  ///< bytes from one block to the next
  std::optional<unsigned> bit;     ///< only this bit of an integer counts: 0 or 1
};

/// Bytes of a stream, which then stands where it stood.
std::uint64_t size_of(std::istream& in);

/// @brief Whether all of a run lies before the end.
bool inside(const NumberRun& run, std::uint64_t file_size) noexcept;

/// @brief Append the numbers of a run that lies inside the file.
/// @return false: the stream ends before
bool read_run(std::istream& in, const NumberRun& run, std::vector<double>& numbers);

/// Bytes from one place of a file; empty: the file ends before.
std::optional<std::string> bytes_at(std::istream& in, std::uint64_t offset,
                                    std::uint64_t count);

/// Takes numbers and texts off the front of some bytes; `short_of` once there are too few.
struct ByteCursor {
  std::string_view left;
  std::endian order = std::endian::little;
  bool short_of = false;

  std::string_view text(std::uint64_t count) {
    if (count > left.size()) {
      short_of = true;
      left = {};
      return {};
    }
    const auto taken = left.substr(0, static_cast<std::size_t>(count));
    left.remove_prefix(taken.size());
    return taken;
  }

  template <class Whole>
  Whole take() {
    const auto bytes = text(sizeof(Whole));
    Whole value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      const std::size_t at = order == std::endian::big ? i : bytes.size() - 1 - i;
      value = static_cast<Whole>((value << 8U) | static_cast<unsigned char>(bytes[at]));
    }
    return value;
  }

  double number(NumberKind kind);
};

}  // namespace trochoid::files
