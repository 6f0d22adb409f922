#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::signal {

/// @brief Angles without the jumps of an encoder that starts again every turn.
/// @param angle  [rad], either way round; a step beyond half a turn is a jump
std::vector<double> unwrapped(std::span<const double> angle);

/// Whole revolutions of a record laid over one another.
struct OneRevolution {
  std::vector<double> angle;                   ///< middles of the bins [rad], shape (b)
  std::array<std::vector<double>, 3> mean;     ///< [N], shape (b); NaN: empty bin
  std::array<std::vector<double>, 3> scatter;  ///< standard deviation [N], shape (b);
                                               ///< NaN: fewer than two samples
  std::vector<int> count;                      ///< samples of each bin
  int revolutions = 0;                         ///< that were used; 0: less than one
};

/// @brief Fold a record to one revolution; parts of a turn at its end are left out.
///
/// @eq  S-2  mean and standard deviation of the samples in each bin of phi mod 2 pi
///
/// Where the angles of a bin differ from turn to turn, a straight
/// line is taken through its samples and read in the middle of
/// the bin, or as near to it as a standard deviation of their
/// angles from their mean: the slope of the force is not scatter,
/// and a line is not to be trusted beyond its samples.
/// @param channels  [N], shape (n) each
/// @param angle     [rad], shape (n), increasing (see `unwrapped`)
/// @param bins      at least 1
/// @throws std::invalid_argument when the shapes do not agree or bins < 1
OneRevolution fold(const std::array<std::vector<double>, 3>& channels,
                   std::span<const double> angle, int bins);

}  // namespace trochoid::signal
