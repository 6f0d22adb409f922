#pragma once

#include <trochoid/engagement/steps.h>
#include <trochoid/program/write_feeds.h>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::engagement {

/// What a turn is not to exceed; infinite: no limit.
struct Limits {
  static constexpr double none = std::numeric_limits<double>::infinity();
  double peak_xy = none;     ///< [N]
  double peak_tooth = none;  ///< [N]
  double torque = none;      ///< peak [N m]
  double power = none;       ///< mean of a turn [W]
  double moment = none;      ///< [N m]
  double deflection = none;  ///< [m]
  double chip = none;        ///< [m]
  double least_chip = 0.0;   ///< the largest chip of a turn is not to be below [m]
  /// Power of the spindle over its speed: rows of [rad/s], [W], the speed ascending,
  /// straight between and level beside; empty: no limit.
  std::vector<std::array<double, 2>> power_curve;
};

/// What holds a feed.
enum class Held : std::uint8_t {
  not_cutting,  ///< nothing is cut: the feed of the program
  range,        ///< the highest that is allowed
  peak_xy,
  peak_tooth,
  torque,
  power,
  moment,
  deflection,
  chip,
  drives,  ///< the largest feed of an axis
};

/// The names that files use.
constexpr std::string_view name_of(Held held) noexcept {
  constexpr std::array<std::string_view, 10> names = {
      "air",   "factor", "peak_force", "peak_tooth", "torque",
      "power", "moment", "deflection", "chip",       "machine"};
  return names[static_cast<std::size_t>(held)];
}

/// Power that a spindle has at a speed [W].
double power_at(const Limits& limits, double spindle) noexcept;

/// The largest share of a limit that a turn comes to: 1 is at the limit.
double share_of_limits(const TurnForces& forces, const Limits& limits, double spindle);

/// Lowest and highest feed as a part of the programmed one.
struct FeedRange {
  double least = 0.2;
  double most = 1.0;
};

/// The feed of a step.
struct WantedFeed {
  std::uint32_t piece = 0;  ///< of the path
  std::uint32_t line = 0;   ///< of the text
  double from = 0.0;        ///< along its piece [m]
  double to = 0.0;          ///< along its piece [m]
  double along = 0.0;       ///< path of feed moves up to its middle [m]
  double programmed = 0.0;  ///< [m/s]
  double feed = 0.0;        ///< [m/s]
  Held held = Held::not_cutting;
  bool reachable = true;  ///< false: even the lowest feed breaks a limit
  bool rubs = false;      ///< the largest chip is below the least one
};

/// @brief The largest feed of each step within the limits, tooth by tooth with runout.
///
/// The stock of a step is that at its start, middle and end: what holds at all three.
/// @eq N-14  x = max {x in [least, most]: Q_i(x f) <= limit_i for all i}
/// @src derived
std::vector<WantedFeed> largest_feeds(const Job& given, const Limits& limits,
                                      const FeedRange& range);

/// @brief Feeds for the program's text: steps whose feeds differ little share the lowest
/// of theirs, and a slow part begins where braking to it has to begin.
/// @eq N-15  braking from v_1 to v_2 takes (v_1^2 - v_2^2)/(2 a) of path
/// @src derived
/// @return ascending, all of each feed move
std::vector<program::FeedPart> feed_parts(const Job& job,
                                          std::span<const WantedFeed> wanted);

}  // namespace trochoid::engagement
