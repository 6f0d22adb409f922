#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::signal {

/// Samples from `begin` up to, but not with, `end`.
struct Part {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// What a channel reads without any force: a straight line over the record.
struct ChannelDrift {
  double first = 0.0;     ///< at the first sample [N]
  double last = 0.0;      ///< at the last sample [N]
  double first_se = 0.0;  ///< [N], from the scatter of whole revolutions
  double last_se = 0.0;   ///< [N]
};

struct Drift {
  std::array<ChannelDrift, 3> channel;
  std::vector<Part> idle;  ///< one or two parts
  bool sloped = false;     ///< false: a constant only
};

/// @brief Find where nothing cuts, before the entry or after the exit of the tool.
///
/// A revolution is idle when the forces vary in it no more than twice as much as in the
/// quietest revolution of the record, and less than a fifth as much as where the tool
/// cuts (the 90th percentile). At least two idle revolutions in a row, at the beginning
/// or at the end, count; the one next to the cut is left out. A tool that only slowly
/// enters the material leaves the idle level early and is not taken for idle.
/// @param angle  [rad], shape (n), increasing
/// @return none, one or two parts
std::vector<Part> idle_parts(const std::array<std::vector<double>, 3>& channels,
                             std::span<const double> angle);

/// @brief The part in which the tool cuts as it does for most of the cut: without
/// entry, exit and what is idle.
///
/// The longest run of whole revolutions, counted from the first sample, whose force
/// varies at least 0.9 times as much as the upper quartile of them does.
/// @param angle  [rad], shape (n), increasing
/// @return the whole record where it is shorter than four revolutions
Part steady_part(const std::array<std::vector<double>, 3>& channels,
                 std::span<const double> angle);

/// @brief Offset and drift of each channel from its idle parts.
///
/// @eq  S-4  (a_c, b_c) = argmin of sum over the idle samples of (F_c - a - b t)^2
///
/// A slope is estimated only where idle parts lie on both sides of the cut or cover a
/// quarter of the record; else the constant alone, for it would be carried far.
/// @return none when the record has no idle part
std::optional<Drift> idle_drift(const std::array<std::vector<double>, 3>& channels,
                                std::span<const double> angle);

/// @brief Take a drift out of the channels.
void remove_drift(std::array<std::vector<double>, 3>& channels, const Drift& drift);

}  // namespace trochoid::signal
