#pragma once

#include <trochoid/program/cycles.h>
#include <trochoid/program/orders.h>
#include <trochoid/program/read_program.h>

#include <optional>
#include <string>
#include <vector>

namespace trochoid::program {

enum class Plane : std::uint8_t { xy, zx, yz };
enum class FeedMode : std::uint8_t { per_minute, per_turn, inverse_time };

/// What drilling cycles keep until G80.
struct CycleMemory {
  std::optional<double> r_level;  ///< as written, in SI
  std::optional<double> bottom;   ///< as written, in SI
  double peck = 0.0;              ///< [m]
  double less = 0.0;              ///< by which each next peck is smaller [m]
  double least = 0.0;             ///< the smallest peck then [m]
  double dwell = 0.0;             ///< [s]
  double initial = unknown;       ///< height where the cycles began [m]
};

/// @brief All that holds from one block to the next.
struct Machine {
  std::array<double, 3> place{unknown, unknown,
                              unknown};  ///< in the frame of the stock
  std::array<double, 3> shift{};         ///< program zero in the frame of the stock [m]
  double length_unit = unit::mm;
  double feed_unit = unit::mm;
  std::optional<double> feed;  ///< as written
  FeedMode feed_mode = FeedMode::per_minute;
  double speed = 0.0;  ///< S [rad/s]
  bool turning = false;
  std::int16_t tool = -1;
  std::string chosen = "0";  ///< by T, for the next M6
  Plane plane = Plane::xy;
  Action motion = Action::cancel_motion;
  bool incremental = false;
  bool center_absolute = false;
  bool to_r_level = false;
  CycleMemory cycle;
  std::string offset;          ///< the first work offset; empty: none yet
  std::array<bool, 3> left{};  ///< axes that went to a place that is not in the program
  bool doubtful = false;       ///< after a problem: what may follow from it is not told
};

/// @brief A program while it is read.
struct Run {
  const ReadOptions& options;
  Habits habits;
  bool changes_tool = false;  ///< M6 is somewhere in the text
  Machine machine = {};
  Complaints complaints = {};
  Points points = {};
  Program program = {};
  std::vector<Leg> legs = {};  ///< of one hole
};

/// @brief A block with its words sorted.
struct Sorted {
  Block& block;
  Orders& orders;
};

/// @brief Tell a problem at a byte of a block.
void complain(Run& run, Sorted& s, std::uint32_t at, Fault fault, std::string what);

/// @brief Everything of a block that comes before its motion: modes, feed, tool, spindle.
void set_modes(Run& run, Sorted& s);

/// @brief The motion of a block.
void move(Run& run, Sorted& s);

/// @brief A move at the place where the machine is, with its tool and spindle.
Move begun(const Run& run, const Sorted& s, MoveKind kind);

/// @brief The time in a word. In ISO a P of 100 and above without a point is in ms, as
/// Fanuc and Haas read it.
double seconds_of(const Word& word, Dialect dialect) noexcept;

/// @brief The dwell of a block: seconds in P, X, U; in Sinumerik F, or turns in S.
void pause(Run& run, Sorted& s);

}  // namespace trochoid::program
