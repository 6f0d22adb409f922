#pragma once

#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/verdict.h>

#include <functional>
#include <span>

/// Whether a cut reaches a steady state, in which its motion repeats.
namespace trochoid::dynamics {

/// Growth in a turn above which a vibration is chatter: it is none that dies out.
inline constexpr double chatter_growth = 1.02;

/// Change of the force from turn to turn, over the largest component of the force, above
/// which a motion that is not periodic is chatter even where it grows no more.
inline constexpr double chatter_change = 0.1;

/// No verdict rests on fewer turns: transients look like anything in a few.
inline constexpr int fewest_turns = 20;

/// @brief (largest - smallest)/largest of values; 0 where none is above 0.
double relative_difference(std::span<const double> values) noexcept;

/// @brief relative_difference of the peaks of |F_y| of the flutes, where watched.
double peak_difference(const Motion& motion);
/// @brief The same of what they cut.
double area_difference(const Motion& motion);

/// @brief Largest |F_x| or |F_y| of the flutes, where watched [N].
double largest_component(const Motion& motion);

/// @brief The verdict on a motion that is not followed further.
///
/// Transients that die out slowly are no chatter yet: it takes a motion that has run
/// away, that grows (T-11), that repeats with a period of its own, or whose force changes
/// by more than chatter_change. Amplitudes and frequencies are left empty.
Verdict verdict_so_far(const MotionProblem& problem, const Motion& motion);

/// A motion, and what it comes to.
struct SteadyState {
  Motion motion;
  Verdict verdict;
};

/// @brief Whether the last turn is one of those that leave the wall: the motion repeats
/// with every turn, or nearly so.
bool walls_repeat(const SteadyState& steady);

/// Told of how many turns are followed next; may be empty.
using TurnsProgress = std::function<void(int turns)>;

/// @brief The motion of a cut, followed until it repeats, has run away or grows no more.
///
/// It is followed for the turns asked for, and for 20 at least: what it comes to does not
/// depend on how many were asked for. Where it does none of these within them, they are
/// doubled, three times at most; one that repeats with a period of its own has to do so as
/// largely after twice the turns. A vibration so small that no tooth leaves the cut and that still grows then is
/// `Growing`; one that is limited by teeth that leave the cut is `Bounded`, with its
/// amplitudes and frequencies (T-13, T-14) over the last turns, in which the flutes are
/// watched as well; so is one whose transients still die out.
/// @throws std::invalid_argument where motion() does
/// @note The verdict on a motion that is not `solved` means nothing.
SteadyState steady_state(MotionProblem problem, const TurnsProgress& progress = {});

}  // namespace trochoid::dynamics
