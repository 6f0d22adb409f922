#pragma once

#include <trochoid/program/machine.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::program {

inline constexpr std::array axis_letters = {'X', 'Y', 'Z'};
inline constexpr std::array center_letters = {'I', 'J', 'K'};

inline bool known(double value) noexcept {
  return !std::isnan(value);
}
inline bool known(const std::array<double, 3>& place) noexcept {
  return known(place[0]) && known(place[1]) && known(place[2]);
}

/// A motion while it is executed.
struct Motion {
  Run& run;
  Sorted& s;
  std::array<const Word*, 3> axes{};
  std::array<double, 3> target{};

  [[nodiscard]] Machine& machine() const noexcept { return run.machine; }
  [[nodiscard]] bool has_axes() const noexcept {
    return axes[0] != nullptr || axes[1] != nullptr || axes[2] != nullptr;
  }
  /// Of the first axis word; without one of the G word.
  [[nodiscard]] std::uint32_t first_axis() const noexcept {
    std::uint32_t first = UINT32_MAX;
    for (const Word* axis : axes) {
      if (axis != nullptr) first = std::min(first, axis->at);
    }
    return first == UINT32_MAX ? s.orders.place_of(Group::motion) : first;
  }
  /// Of the G word; without one of the first axis word.
  [[nodiscard]] std::uint32_t motion_word() const noexcept {
    return s.orders.has(Group::motion) ? s.orders.place_of(Group::motion)
                                       : first_axis();
  }
  void complain(std::uint32_t at, Fault fault, std::string what) const {
    program::complain(run, s, at, fault, std::move(what));
  }
};

/// By IC( ) and AC( ) of Sinumerik, otherwise by G90 and G91.
bool is_incremental(const Machine& m, const Word& word) noexcept;

/// @brief A rapid to a place, of which coordinates may be unknown.
void rapid_to(Motion& o, const std::array<double, 3>& end, MoveNote note);

/// @brief The speed along a path of a length [m/s]; 0: it is told.
double feed_of(Motion& o, double length);

/// @brief Whether a feed move knows where it begins and ends. If not, it is told.
bool knows_place(Motion& o);

/// @brief G1 to the target.
void move_on_line(Motion& o);

/// @brief G2 or G3 to the target: one move in the plane of the table, chords in others.
void move_on_arc(Motion& o);

/// @brief G81 G82 G83 G73: the holes of a block.
void drill_holes(Motion& o);

}  // namespace trochoid::program
