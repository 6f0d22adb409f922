#pragma once

#include <trochoid/results/sweep.h>

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
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

}  // namespace trochoid::sweep
