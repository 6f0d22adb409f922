#include <trochoid/files/inflate.h>

#include <limits>

#include <zlib.h>

namespace trochoid::files {

bool can_inflate() noexcept {
  return true;
}

namespace {

/// @param window  bits of zlib's window; negative: no head and no check
std::optional<std::string> unpacked(std::string_view packed, std::uint64_t count,
                                    int window) {
  constexpr std::uint64_t most = std::numeric_limits<uInt>::max();
  if (packed.size() > most || count > most) return std::nullopt;
  z_stream stream{};
  if (inflateInit2(&stream, window) != Z_OK) return std::nullopt;
  std::string bytes(static_cast<std::size_t>(count), '\0');
  // zlib does not write there; its interface is older than const.
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = static_cast<uInt>(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(count);
  const int status = inflate(&stream, Z_SYNC_FLUSH);
  inflateEnd(&stream);
  const bool done = status == Z_OK || status == Z_STREAM_END || status == Z_BUF_ERROR;
  if (!done || stream.avail_out != 0) return std::nullopt;
  return bytes;
}

}  // namespace

std::optional<std::string> inflated(std::string_view packed, std::uint64_t count) {
  return unpacked(packed, count, MAX_WBITS);
}

std::optional<std::string> raw_inflated(std::string_view packed, std::uint64_t count) {
  return unpacked(packed, count, -MAX_WBITS);
}

}  // namespace trochoid::files
