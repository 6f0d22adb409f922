#pragma once

#include <trochoid/signal/record.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::signal {

/// Samples from `begin` up to, but not with, `end`.
struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
};

/// @brief A record told apart: where nothing cuts, and where the tool cuts as it does for
/// most of a pass through the material.
struct Passes {
  std::vector<Part> air;     ///< ascending; without the turn next to a cut
  std::vector<Part> steady;  ///< ascending, one a pass; entry and exit left out
};

/// @brief Find air, entry, steady cut and exit in a record: air by how much the forces vary
/// within a turn, or else by their means; entry and exit by means and lines of turns (S-8).
///
/// @eq S-6 v = sqrt(sum over channels of the mean square about a straight line over one
///         turn); air: v <= min(v_c/5, max(2 v_min, v_c/1000)) for two turns or
///         more, v_c that of the usual cut
/// @src derived
///
/// Turns are looked at every quarter turn. A turn holds every tooth once, so that v does
/// not change in a steady cut, whatever its engagement. In a pass of less than six turns
/// v tells entry and exit, too: steady is v >= 0.9 of its upper quartile, less than two
/// turns in a row excepted, and all where v never falls below 0.7 of it.
/// @param angle  [rad], shape (n), increasing, to 0.1 % in a turn
/// @return without air and with everything steady where less than three turns are there,
///         or fewer than 12 samples a turn, or nothing is told apart
Passes passes_of(const std::array<std::vector<double>, 3>& channels,
                 std::span<const double> angle);

/// @brief The longest steady cut, the first of equal ones: what is fitted where nobody says
/// otherwise.
Part longest_steady(const Passes& passes);

/// @brief The samples from one time to another, both included.
/// @param time  [s], ascending
Part part_between(std::span<const double> time, double from, double to);

/// @brief Leave out of a record what is not in a part.
void keep_part(const Part& part, Record& record);

}  // namespace trochoid::signal
