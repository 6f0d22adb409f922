#include <trochoid/base/read_text.h>

#include <cstddef>
#include <fstream>
#include <utility>

namespace trochoid::base {

std::optional<std::string> read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text;
  constexpr std::size_t piece = 1U << 16U;
  std::string buffer(piece, '\0');
  while (in.read(buffer.data(), piece) || in.gcount() > 0) {
    text.append(buffer.data(), static_cast<std::size_t>(in.gcount()));
  }
  // Its end is reached, and not only where reading stopped.
  return in.eof() && !in.bad() ? std::optional(std::move(text)) : std::nullopt;
}

}  // namespace trochoid::base
