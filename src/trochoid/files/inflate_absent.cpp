#include <trochoid/files/inflate.h>

namespace trochoid::files {

bool can_inflate() noexcept {
  return false;
}

std::optional<std::string> inflated(std::string_view /*packed*/,
                                    std::uint64_t /*count*/) {
  return std::nullopt;
}

std::optional<std::string> raw_inflated(std::string_view /*packed*/,
                                        std::uint64_t /*count*/) {
  return std::nullopt;
}

}  // namespace trochoid::files
