#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::program {

enum class MoveKind : std::uint8_t { rapid, line, arc, chord, dwell };

/// As files spell it.
constexpr std::string_view name_of(MoveKind kind) noexcept {
  switch (kind) {
    case MoveKind::rapid:
      return "rapid";
    case MoveKind::line:
      return "line";
    case MoveKind::arc:
      return "arc";
    case MoveKind::chord:
      return "chord";
    case MoveKind::dwell:
      return "dwell";
  }
  return {};
}

/// Where a move comes from, if not from words that name its end.
enum class MoveNote : std::uint8_t {
  none,
  cycle,    ///< of a drilling cycle
  retract,  ///< to a place that is not in the program: G28, G30, G53, SUPA
  start,    ///< none: where the machine stands before the first block
};

/// As files spell it.
constexpr std::string_view name_of(MoveNote note) noexcept {
  switch (note) {
    case MoveNote::none:
      return "";
    case MoveNote::cycle:
      return "cycle";
    case MoveNote::retract:
      return "retract";
    case MoveNote::start:
      return "start";
  }
  return {};
}

/// How the block of a move is written, for who writes into the text: bits.
enum Writing : std::uint8_t {
  in_inches = 1,        ///< lengths; else in mm
  feed_in_inches = 2,   ///< F; else in mm
  feed_per_turn = 4,    ///< G95
  inverse_time = 8,     ///< G93
  by_increments = 16,   ///< G91
  center_by_place = 32  ///< G90.1
};

inline constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// @brief One move of the machine. It begins where the move before it ends.
///
/// Places are in the frame of the stock; NaN stands for a coordinate that is not known.
struct Move {
  std::array<double, 3> end{unknown, unknown, unknown};  ///< [m]
  std::array<double, 2> center{unknown, unknown};        ///< of an arc [m]
  double turn =
      0.0;  ///< of an arc [rad], positive counter-clockwise, |turn| may exceed 2 pi
  double time = 0.0;        ///< that the move takes [s]
  double feed = 0.0;        ///< along the path [m/s]; 0 of rapids and dwells
  double spindle = 0.0;     ///< speed [rad/s], 0: it stands
  std::uint32_t line = 0;   ///< in the text, from 1
  std::int32_t block = -1;  ///< N number, -1: none
  std::int16_t tool = -1;   ///< index in `Program::tools`, -1: neither T nor M6 before
  MoveKind kind = MoveKind::rapid;
  MoveNote note = MoveNote::none;
  std::uint8_t writing = 0;  ///< of Writing
};

enum class Dialect : std::uint8_t { iso, linuxcnc, sinumerik };

/// As files spell it.
constexpr std::string_view name_of(Dialect dialect) noexcept {
  switch (dialect) {
    case Dialect::iso:
      return "iso";
    case Dialect::linuxcnc:
      return "linuxcnc";
    case Dialect::sinumerik:
      return "sinumerik";
  }
  return {};
}

/// Where program zero is, from a move on.
struct Zero {
  std::size_t first_move = 0;
  std::array<double, 3> place{};  ///< in the frame of the stock [m]
};

/// What a text in G code makes the machine do.
struct Program {
  Dialect dialect = Dialect::iso;
  std::vector<Move> moves;
  std::vector<std::string>
      tools;                ///< numbers or names, in the order of their first use
  std::vector<Zero> zeros;  ///< the first is that of the first move
};

}  // namespace trochoid::program
