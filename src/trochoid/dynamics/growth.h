#pragma once

#include <array>
#include <optional>
#include <span>

namespace trochoid::dynamics {

/// @brief By how much a vibration grows from turn to turn, seen in the motion itself.
///
/// What one turn adds to the motion, d_n = q_n - q_(n-1), is mostly one pair of
/// multipliers once the others have died out; a pair obeys a recurrence of two terms,
/// which is fitted to the turns.
///
/// @eq T-11 d_(n+1) = a d_n + b d_(n-1);  growth: the larger |x| with x^2 = a x + b
/// @src derived: small vibrations are sums of powers of the multipliers of a turn
///
/// @param once   q at the start of every turn [m]
/// @param small the largest change that is taken [m]: well below
/// the feed per tooth, so that no tooth leaves the cut
/// @return of the stretch of turns that obeys the
///         recurrence best; nothing where none does
std::optional<double> growth_per_turn(std::span<const std::array<double, 2>> once,
                                      double small);

/// @brief Size of what a turn adds, late over earlier: root mean squares over the last
/// quarter of the turns and over the quarter before.
/// @return nothing below eight turns
std::optional<double> late_change(std::span<const std::array<double, 2>> once);

/// @brief The largest change of a turn over the last quarter [m]; 0 below two turns.
double late_size(std::span<const std::array<double, 2>> once);

}  // namespace trochoid::dynamics
