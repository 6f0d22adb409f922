#pragma once

#include <trochoid/dynamics/motion.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/shared/progress.h>

#include <optional>
#include <string>

namespace trochoid::run {

enum class Verdict { periodic, not_periodic, chatter };

/// A motion, and whether it comes to repeat itself.
struct Moved {
  dynamics::Motion motion;
  Verdict verdict = Verdict::periodic;
  std::optional<double> growth;  ///< of a small vibration in a turn, where it was seen
};

/// @brief The motion, with more turns than asked for until it repeats or has run away.
///
/// A motion that neither repeats nor dies out is chatter, as are flutes that are alike
/// and do not cut alike.
/// @param problem  its number of turns becomes that of the answer
Moved settled(dynamics::MotionProblem& problem, const Progress& progress);

/// @brief By what a small vibration grows in a turn, from the linearised cut (D-8).
/// @return nothing where a period of the cut holds too many vibrations
std::optional<double> linear_growth(const inputs::Case& given,
                                    const dynamics::System& system);

/// @brief What chatters, in words.
std::string chatter_message(const Moved& moved, std::optional<double> linear_growth);

/// @brief Largest difference of the peaks of F_y between flutes, over the larger.
double peak_difference(const dynamics::Motion& motion);

}  // namespace trochoid::run
