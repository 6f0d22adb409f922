#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace trochoid::files {

/// Whether this library was built with zlib.
bool can_inflate() noexcept;

/// @brief The first bytes of what zlib has packed.
/// @param count  no more than these are unpacked, nor is memory taken for more
/// @return none: the packed bytes are damaged or end before
std::optional<std::string> inflated(std::string_view packed, std::uint64_t count);

/// @brief The same for bytes without zlib's head and check, as in a ZIP archive.
std::optional<std::string> raw_inflated(std::string_view packed, std::uint64_t count);

}  // namespace trochoid::files
