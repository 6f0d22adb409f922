#pragma once

#include <trochoid/signal/passes.h>
#include <trochoid/signal/record.h>

#include <array>
#include <span>
#include <vector>

namespace trochoid::signal {

/// @brief A whole record as it came, in few pieces, and which of them are used.
struct Overview {
  std::vector<double> turn;  ///< middle of each piece, turns of the spindle as stated
  std::vector<double> time;  ///< the same [s]; empty: the record has no times
  std::array<std::vector<double>, 3> low;   ///< smallest reading [N]
  std::array<std::vector<double>, 3> high;  ///< largest reading [N]
  std::vector<bool> used;                   ///< whether its middle is in the used part
};

/// @brief Smallest and largest readings of a record over at most 600 pieces.
/// @param record  whole, as it was read
/// @param angle   of its samples at the stated speed [rad], shape (n)
Overview overview_of(const Record& record, std::span<const double> angle,
                     const Part& used);

}  // namespace trochoid::signal
