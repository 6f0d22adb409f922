#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace trochoid::signal {

/// Quarters of a turn in a window: one turn.
inline constexpr std::size_t quarters_of_turn = 4;

/// @brief What a record is in windows of one turn, one beginning at each quarter of a turn:
/// the mean of each channel and the amplitudes of its lines, which do not change while the
/// cut is steady, whatever the phase.
struct TurnLines {
  static constexpr std::size_t channels = 3;
  int lines = 0;  ///< harmonics 1..lines of the spindle
  std::vector<double>
      value;  ///< [N], shape (windows, features): 3 means, then amplitudes
  std::vector<double>
      noise;  ///< variance of a channel about its lines [N^2], (windows, 3)
  std::vector<double> count;  ///< samples, shape (windows)

  [[nodiscard]] std::size_t features() const noexcept {
    return channels * (1 + static_cast<std::size_t>(lines));
  }
  [[nodiscard]] std::size_t windows() const noexcept { return count.size(); }
  [[nodiscard]] std::span<const double> at(std::size_t window) const {
    return std::span(value).subspan(window * features(), features());
  }
  [[nodiscard]] std::span<const double> means(std::size_t window) const {
    return at(window).first(channels);
  }
  /// Sum of the squared amplitudes of all lines and channels [N^2].
  [[nodiscard]] double line_power(std::size_t window) const;
};

/// @brief Means and lines of all windows of one turn.
///
/// @param angle   [rad], shape (n)
/// @param begins  first sample of each quarter of a turn, and the end of the last, shape
///                (quarters + 1)
/// @param lines   at least 1
TurnLines turn_lines(const std::array<std::vector<double>, 3>& channels,
                     std::span<const double> angle, std::span<const std::size_t> begins,
                     int lines);

/// Windows from `begin` up to, but not with, `end`.
struct Windows {
  std::size_t begin = 0;
  std::size_t end = 0;

  [[nodiscard]] std::size_t size() const noexcept { return end - begin; }
};

/// @brief Take out of the means what the channels read in air, by straight lines from air to
/// air.
/// @param air  ascending
void take_idle_out(std::span<const Windows> air, TurnLines& lines);

/// A pass through the material, and what is known of its ends.
struct Pass {
  Windows windows;
  bool air_before = false;
  bool air_after = false;
};

/// @brief The windows of a pass that are like its flattest quarter: entry and exit left out.
///
/// @eq S-8 at an end is entry or exit, what in means of 1, 2, 4, 8 turns differs in any
///         feature by more than (0.004 + 0.1 d/P) F + 4 se from the flattest quarter of
///         the pass, d away from its middle, P its length, F its force
/// @src derived
///
/// Without air at an end, what differs there by less than 0.15 F at most is no entry.
/// @return all of the pass where it is too short to tell
Windows steady_windows(const TurnLines& lines, const Pass& pass);

/// @brief Windows at the beginning and at the end that are air by their means: noise may
/// hide it from how much the force varies.
///
/// Air are two turns or more whose means stay as they are in the first two, while those in
/// the middle of the record differ from them by far more than chance, and whose lines are
/// no more than noise.
/// @return none, or one or two
std::vector<Windows> air_by_means(const TurnLines& lines);

}  // namespace trochoid::signal
