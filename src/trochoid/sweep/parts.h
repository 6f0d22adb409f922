#pragma once

#include <trochoid/results/sweep.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace trochoid::sweep {

/// FNV-1a, 64 bits: against torn files, not against forgers.
std::uint64_t checksum(std::string_view text) noexcept;

/// A line with its end; one that was cut short is none.
bool whole_line(std::istream& in, std::string& line);

/// @brief Rows as text, from which the same bits are read again.
///
/// A line says the number of the first row, how many there are and the checksum of their
/// lines, which follow.
std::string part_text(std::size_t first, std::span<const results::SweepRow> rows);

/// @brief The next rows, where they are whole.
/// @param first  number that the first of them must have
/// @param cells  of a row
/// @return none where they were cut short, or are other rows
std::optional<std::vector<results::SweepRow>> read_part(std::istream& in,
                                                        std::size_t first,
                                                        std::size_t cells);

/// @brief Rows that are done, in a file that only grows: after a kill the same sweep goes
/// on behind the last part that is whole.
///
/// A line says what the sweep is, then each part its first row, its rows and their
/// checksum. A part that a kill or a full disk cut short is not believed.
class Parts {
 public:
  /// @param file     hidden, beside the result folder; empty: nothing is kept
  /// @param meaning  text of all that the rows depend on
  /// @param cells    of a row
  /// @throws base::InputError when it cannot be written
  Parts(std::filesystem::path file, std::string_view meaning, std::size_t cells);

  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }

  /// Rows of an earlier run of the same sweep, from the first on.
  [[nodiscard]] results::SweepRows take_done() { return std::move(done_); }

  /// @throws base::InputError when it cannot be written
  void add(std::size_t first, std::span<const results::SweepRow> rows);

 private:
  std::filesystem::path file_;
  std::ofstream out_;
  results::SweepRows done_;
};

}  // namespace trochoid::sweep
