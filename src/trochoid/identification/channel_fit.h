#pragma once

#include <trochoid/force/sensor.h>
#include <trochoid/identification/fit.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Records, or means, of any channels of a sensor.
namespace trochoid::identification {

/// @brief What the channels of a sensor read in one cut.
struct ChannelData {
  geometry::Cut cut;  ///< with the spindle speed, which power needs
  std::vector<double>
      angle;  ///< recorded angle [rad], shape (n); empty: a mean of turns
  std::vector<double> value;  ///< N, N m, W, shape (n, channels); of a mean (channels)
  std::vector<double> sd;     ///< of one value of each channel, shape (channels)
  /// Standard error of the offset that was taken out of each channel; empty: none was.
  std::vector<double> offset_se = {};
};

/// What is to be found from channels, and how.
struct ChannelRequest {
  chip::Model chip_model = chip::Model::trochoidal;
  RunoutUnknowns runout = RunoutUnknowns::fixed;
  bool axial_offsets = false;   ///< of teeth 2..N are found as well
  bool tilt = false;            ///< of the tool axis is found as well
  std::optional<double> phase;  ///< [rad]; absent: free, one for each record
  bool sensor_free = false;     ///< the angle of the sensor is found
  bool fit_channel_offsets =
      false;              ///< a constant and a slope of each channel and record
  bool absolute = false;  ///< standard deviations are known; else only their ratios
  /// Variance over that of the standard deviations, where they are ratios only and no
  /// equation is left over to tell it.
  double untold_variance = 1.0;
  /// By how much residuals that are no white noise widen the errors; where `absolute`: 1.
  double widening = 1.0;
  /// Search from the given runout alone, at phases of 0.
  bool near_given = false;
  /// Of each coefficient [SI]; empty: none of any.
  std::vector<std::optional<Normal>> prior;
};

/// @brief Fit coefficients, and what else is asked for, to channels of any kind.
///
/// @eq I-27 minimise |W (y - D(p) K)|^2 + sum of ((K_c - K0_c)/sd_c)^2 over K and p
/// @eq I-28 covariance s^2 (J^T J)^-1, J = [W D | W d(D K)/dp] with the rows of the prior;
///          s^2 = 1 where the standard deviations are known, else RSS/(n - rank - dim p);
///          it grows by the errors of the offsets that were taken out (I-24)
/// @src derived
///
/// @param setup  tool and given runout, which is the start of the search; its `cut` and
///               `chip.model` are replaced
/// @param law    the kind of law; exponents stay as they are
/// @param data   at least one
/// @return a fit with `channels`; not ok where no coefficient is told
/// @throws std::invalid_argument when shapes do not agree
Fit fit_channels(const force::Setup& setup, const force::Law& law,
                 const force::Sensor& sensor, std::span<const ChannelData> data,
                 const ChannelRequest& request);

/// How well a further unknown of the runout could be told from the rest.
struct FurtherUnknown {
  Found unknown;       ///< its value where the search begins
  double angle = 0.0;  ///< of its column to all others [rad]; 0: not told at all
  double se = 0.0;     ///< [m], or tan of the tilt; of a fit that finds it
};

/// @brief What a fit would tell of the axial offsets and the tilt that a request asks for, and
/// of the rest of the runout, without fitting it: linear about the given runout.
///
/// @eq  I-29 sin(angle_i) = 1/(|j_i| sqrt((J^T J)^-1_ii)), se_i as I-28
/// @src derived
/// @return one for each unknown of the runout
std::vector<FurtherUnknown> further_unknowns(const force::Setup& setup,
                                             const force::Law& law,
                                             const force::Sensor& sensor,
                                             std::span<const ChannelData> data,
                                             const ChannelRequest& request);

}  // namespace trochoid::identification
