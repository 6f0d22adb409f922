#pragma once

#include <trochoid/dynamics/motion.h>

#include <functional>
#include <span>
#include <string_view>

/// Whether a cut reaches a steady state, in which its motion repeats from turn to turn.
namespace trochoid::dynamics {

/// Largest change of the force from turn to turn, over the largest force, of a motion
/// that is periodic: 0.2 N of 60 N, as the case of [diez2010] settles.
inline constexpr double periodic_tolerance = 1.0 / 300;

/// Growth in a turn above which a vibration is chatter: it is none that dies out.
inline constexpr double chatter_growth = 1.02;

/// Change of the force from turn to turn, over the largest component of the force, above
/// which a motion that is not periodic is chatter even where it grows no more.
inline constexpr double chatter_change = 0.1;

/// What a motion comes to.
enum class Verdict {
  periodic,      ///< a steady state: it repeats from turn to turn
  not_periodic,  ///< transients still die out
  chatter,       ///< a vibration that does not die out
};

/// Names of files.
constexpr std::string_view name_of(Verdict verdict) noexcept {
  switch (verdict) {
    case Verdict::periodic:
      return "periodic";
    case Verdict::not_periodic:
      return "not_periodic";
    case Verdict::chatter:
      return "chatter";
  }
  return {};
}

/// @brief (largest - smallest)/largest of values; 0 where none is above 0.
double relative_difference(std::span<const double> values) noexcept;

/// @brief relative_difference of the peaks of |F_y| of the flutes, in the last turn.
double peak_difference(const Motion& motion);
/// @brief The same of what they cut.
double area_difference(const Motion& motion);

/// @brief Largest |F_x| or |F_y| of the flutes in the last turn [N].
double largest_component(const Motion& motion);

/// @brief The verdict on a motion that is not followed further.
///
/// Transients that die out slowly are no chatter yet: it takes a motion that has run
/// away, that grows (T-11), or whose force changes by more than chatter_change. One that
/// is not `solved` counts as run away.
Verdict verdict_so_far(const Motion& motion);

/// A motion, and what it comes to.
struct SteadyState {
  Motion motion;
  Verdict verdict = Verdict::periodic;
};

/// Told of how many turns are followed next; may be empty.
using TurnsProgress = std::function<void(int turns)>;

/// @brief The motion of a cut, followed until it repeats or has run away.
///
/// Where it does neither within the turns asked for, they are doubled, three times at
/// most. Chatter is a motion that runs away or grows (T-11), one whose changes from turn
/// to turn do not die out, and teeth that are alike but do not cut alike: a period of
/// several teeth.
/// @throws std::invalid_argument where motion() does
/// @note The verdict on a motion that is not `solved` means nothing.
SteadyState steady_state(MotionProblem problem, const TurnsProgress& progress = {});

}  // namespace trochoid::dynamics
