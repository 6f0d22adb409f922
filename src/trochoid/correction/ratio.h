#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::correction {

/// @brief Chip differences from the peaks of the flutes alone.
struct RatioEstimate {
  bool ok = false;
  std::string reason;         ///< when not ok
  std::vector<double> h_ro;   ///< rho_j - rho_(j-1) [m], sum 0
  std::vector<double> rho;    ///< [m], mean 0
  std::vector<bool> cutting;  ///< of each flute
};

/// @brief Amplitude ratio, for a power law of known exponent.
///
/// @eq R-20 h_ro = h (r - 1)/(r + 1), r = (F_1/F_2)^(1/(1 - m)), h the chip without
///          runout where the peaks are; any number of teeth: h_j = N h F_j^(1/(1-m)) /
///          sum over k of F_k^(1/(1-m)), h_ro_j = h_j - h
/// @src [diez2010] eq. 3 to 7 at the peak; N teeth: the chips of a turn add up
/// @param peaks  of |F_y| of each flute [N]
/// @param h      RigidCut::nominal_chip: f_z where the arc of cut holds 90 deg [m]
/// @param m      exponent, below 1
/// @note Exact where every peak is at 90 deg, one tooth cuts at a time and its chip is
///       bounded by the tooth before. A flute with no force cuts nothing: its runout is
///       only known to be at least h, and there is no estimate.
RatioEstimate ratio_estimate(std::span<const double> peaks, double h, double m);

}  // namespace trochoid::correction
