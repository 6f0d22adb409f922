#pragma once

#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Files packed into one (ZIP), as far as surface maps need them.
namespace trochoid::files {

struct ZipEntry {
  std::string name;
  std::uint16_t flags = 0;
  std::uint16_t method = 0;  ///< 0: stored, 8: deflated
  std::uint32_t check = 0;   ///< CRC-32 of what is packed
  std::uint64_t packed = 0;  ///< bytes
  std::uint64_t size = 0;    ///< bytes, unpacked
  std::uint64_t header = 0;  ///< where its local header stands
};

/// @brief The directory of an archive; none: it is damaged, or of the kind for more than
/// 4 GiB.
std::optional<std::vector<ZipEntry>> zip_entries(std::istream& in);

/// @brief A file of an archive, unpacked.
/// @param most  larger ones are refused before memory is taken [bytes]
/// @return none: damaged, encrypted or packed in another way; `why` says which
std::optional<std::string> unzipped(std::istream& in, const ZipEntry& entry,
                                    std::uint64_t most, std::string& why);

}  // namespace trochoid::files
