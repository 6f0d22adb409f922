#pragma once

#include <trochoid/identification/identify.h>

#include <span>
#include <string>
#include <vector>

namespace trochoid::identification {

/// @brief What one form of the runout makes of the records.
struct FormTried {
  RunoutUnknowns form = RunoutUnknowns::none;
  double rms = 0.0;  ///< left [N], I-5
  double excess =
      0.0;  ///< I-18 above that of the chosen form, in the chance of one unknown
};

/// @brief The form of the runout that the records decide for.
struct FormChoice {
  Fit fit;
  std::string why;  ///< a sentence
  std::vector<FormTried> tried;
};

/// How the form of the runout was decided.
struct RunoutForm {
  RunoutUnknowns first = {};   ///< that was fitted first
  RunoutUnknowns better = {};  ///< that the records decide for
  bool stated = false;         ///< the first was asked for
  std::string why;
  std::vector<FormTried> tried;
};

/// @brief Decide between no runout, radial offsets, an eccentricity, and both.
///
/// None, where offsets are found to be small and may be zero. Offsets, where these leave
/// nothing that repeats turn by turn. Else by how well each form would foretell further
/// turns: a form wins with more unknowns, or another kind, only by more than chance.
///
/// @eq I-18 RSS + 2 p v, with v what an unknown explains by chance (I-14); a difference
///          below 4 v for each further unknown, and for one at least, decides nothing
/// @src [takeuchi1976]: leaving a block of records out, to first order
/// @param offsets  a fit with RunoutUnknowns::offsets of the same setup, law and runs,
///                 which stands
FormChoice choose_runout(const force::Setup& setup, const force::Law& law,
                         std::span<const Run> runs, const Fit& offsets);

/// @brief The form that explains clearly more than that of a fit, if there is one.
FormChoice better_runout(const force::Setup& setup, const force::Law& law,
                         std::span<const Run> runs, const Fit& stated);

}  // namespace trochoid::identification
