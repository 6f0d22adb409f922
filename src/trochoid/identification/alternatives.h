#pragma once

#include <trochoid/identification/find_axes.h>

#include <functional>
#include <optional>
#include <span>

/// What would explain records clearly better than the cut, the tool and the axes that are
/// stated: each is a likely mistake.
namespace trochoid::identification {

/// Another reading of the channels of the dynamometer.
struct BetterAxes {
  signal::Matrix3 matrix{};  ///< channels = matrix times force on the tool
  double rms = 0.0;          ///< left with it [N]
  double stated_rms = 0.0;   ///< left with the stated one [N]; infinite: no fit
};

/// @brief The reading of the channels that fits best, where it leaves clearly less than the
/// stated one.
/// @param M      the stated one
/// @param least  of what the stated one leaves: clearly less is less than this part
/// @param told   as of find_axes
/// @return nothing: none does, or a channel is missing
std::optional<BetterAxes> better_axes(const AxesProblem& problem,
                                      std::span<const ChannelRun> runs,
                                      const signal::Matrix3& M, double least,
                                      const std::function<void(double)>& told);

/// @brief Whether a reading of the channels leaves clearly less with all harmonics that are
/// fitted, too: within the lowest few little is left to compare.
/// @param other  the reading
/// @param M, least  as of better_axes
bool fits_better(const AxesProblem& problem, std::span<const ChannelRun> runs,
                 const signal::Matrix3& M, const signal::Matrix3& other, double least);

/// Another tool, cut or dynamometer than the stated one.
struct BetterCut {
  std::optional<int>
      teeth;        ///< so many, with the same feed in a turn; nothing: reversed
  bool up = false;  ///< reversed: it is an up cut
  /// x and y turn with the spindle: their angle is so many times that of the spindle.
  int turns_with_spindle = 0;
  double rms = 0.0;         ///< left with it [N]
  double stated_rms = 0.0;  ///< left as stated, by the same kind of fit [N]
};

/// @brief Another number of teeth, milling the other way round, or a dynamometer that turns
/// with the spindle, where it leaves less than half of what the stated cut leaves.
///
/// Numbers of teeth and turning dynamometers are compared without runout, directions with
/// radial offsets of up to four teeth.
/// @param runs     force on the tool
/// @param options  their chip model and phase count
std::optional<BetterCut> better_cut(const force::Setup& setup, const force::Law& law,
                                    std::span<const Run> runs, const Options& options);

}  // namespace trochoid::identification
