#pragma once

#include <trochoid/base/units.h>
#include <trochoid/program/move.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace trochoid::stock {

using Point = std::array<double, 3>;

/// @brief A straight or circular piece of the path of the tip.
///
/// Collinear moves of one tool, feed and speed are one piece: nothing depends on how a line
/// was cut into blocks.
struct Piece {
  Point from{};                    ///< [m]
  Point to{};                      ///< [m]
  std::array<double, 2> center{};  ///< of an arc [m]
  double radius = 0.0;             ///< of an arc [m]; 0: straight
  double start = 0.0;       ///< of an arc: angle of `from` about the centre [rad]
  double turn = 0.0;        ///< of an arc [rad], positive counter-clockwise
  double length = 0.0;      ///< along the path [m]
  double horizontal = 0.0;  ///< length of its projection [m]
  double turns_from = 0.0;  ///< of the spindle since the start of the program
  double turns_to = 0.0;
  double time_from = 0.0;   ///< [s]
  double time_to = 0.0;     ///< [s]
  double feed = 0.0;        ///< [m/s]; 0: rapid
  double spindle = 0.0;     ///< [rad/s]
  std::uint32_t first = 0;  ///< of its moves in Program::moves
  std::uint32_t last = 0;   ///< the last one of them
  std::int16_t tool = -1;

  [[nodiscard]] bool arc() const noexcept { return radius > 0; }
  /// It has no direction in the plane.
  [[nodiscard]] bool upright() const noexcept { return !(horizontal > 0); }
  /// Feed of a turn along the path, as programmed [m]; infinite where the spindle stands.
  [[nodiscard]] double feed_per_turn() const noexcept {
    return feed * unit::turn / spindle;
  }
};

/// The path of a program.
struct Path {
  std::vector<Piece> pieces;  ///< in their order; dwells and moves nowhere are left out
  /// Where each move begins along its piece [m], shape (moves); NaN: it is in no piece.
  std::vector<double> begins;
  std::vector<std::uint32_t> piece_of;  ///< shape (moves)
  double time = 0.0;                    ///< of the whole program [s]
  double turns = 0.0;
};

/// @brief The path of all moves, rapids too, and when it is gone.
/// @eq N-1  dT = ds/v Omega/(2 pi): turns of the spindle along the path
/// @src derived
/// @param rapid_feed  [m/s]; a rapid from an unknown place takes no time and sweeps nothing
Path path(std::span<const program::Move> moves, double rapid_feed);

/// A place on a piece.
struct PathPoint {
  Point place{};           ///< [m]
  double direction = 0.0;  ///< of the feed from +x [rad]; NaN: upright
};

/// @param u  fraction of the piece, 0 to 1
PathPoint point_at(const Piece& piece, double u) noexcept;

/// @brief Direction of the path in space, of length 1.
/// @param u  fraction of the piece, 0 to 1
Point tangent(const Piece& piece, double u) noexcept;

}  // namespace trochoid::stock
