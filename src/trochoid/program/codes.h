#pragma once

#include <trochoid/program/complaints.h>
#include <trochoid/program/move.h>

#include <cstdint>
#include <optional>
#include <string_view>

namespace trochoid::program {

/// Of the words of one group only one may stand in a block.
enum class Group : std::uint8_t {
  motion,
  once,  ///< those that hold in their block only
  plane,
  distance,
  center,
  feed_mode,
  unit,
  compensation,
  length,
  retract,
  offset,
  path,
  exact_stop,
  scaling,
  rotation,
  spindle_mode,
  smoothing,
  machine,
  spindle,
  stop,
  other,  ///< any number of them
};
inline constexpr std::size_t group_count = static_cast<std::size_t>(Group::other) + 1;

/// What a G or M word does.
enum class Action : std::uint8_t {
  nothing,  ///< that the load depends on
  refused,
  rapid,
  line,
  clockwise,
  counter_clockwise,
  drill,
  drill_dwell,
  peck,
  chip_break,
  cancel_motion,
  dwell,
  plane_xy,
  plane_zx,
  plane_yz,
  inch,
  metric,
  inch_lengths,    ///< the feed keeps its unit
  metric_lengths,  ///< the feed keeps its unit
  absolute,
  incremental,
  center_absolute,
  center_incremental,
  per_minute,
  per_turn,
  inverse_time,
  initial_level,
  r_level,
  home,
  machine_place,
  fixed_point,      ///< of the machine: the axes named go there
  lift,             ///< z goes up, who knows where to
  offset,           ///< G54 and its like, by their own name
  numbered_offset,  ///< G54.1 P1, G154 P1
  no_offset,
  compensation,
  look_ahead,  ///< nothing with P or Q; otherwise another word
  tool_change,
  spindle_right,
  spindle_stop,
  end,
};

/// @brief A G or M word.
struct Code {
  int tenths = 0;  ///< of its number: 911 is G91.1
  Group group = Group::other;
  Action action = Action::nothing;
  std::string_view takes = {};  ///< letters of its block that it takes without effect
  Fault fault = Fault::unknown;
  std::string_view what = {};  ///< of a refused one: what it is
};

/// @brief What a G word means in a dialect; none: it is not known there.
const Code* g_code(int tenths, Dialect dialect) noexcept;

/// @brief The same of an M word.
const Code* m_code(int tenths, Dialect dialect) noexcept;

}  // namespace trochoid::program
