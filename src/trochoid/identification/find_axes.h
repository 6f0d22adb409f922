#pragma once

#include <trochoid/identification/fit.h>
#include <trochoid/signal/axes.h>

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::identification {

/// A run of the tool as the channels of a dynamometer have it.
struct ChannelRun {
  geometry::Cut cut;
  std::vector<double> angle;                   ///< recorded angle [rad], shape (n)
  std::array<std::vector<double>, 3> channel;  ///< [N], shape (n) each
  std::string group = {};                      ///< as of Run
  std::array<bool, 3> measured = {true, true, true};  ///< channels that there are
  double Omega_se = 0.0;                              ///< as of Run
  std::array<double, 3> offset_se{};                  ///< as of Run, of each channel
};

/// @brief Whether the force in x, y and z follows from the channels that are measured;
/// absent: a channel is missing, and M is no signed permutation.
std::optional<std::array<bool, 3>> measured_forces(const std::array<bool, 3>& channels,
                                                   const signal::Matrix3& M);

/// @brief Force on the tool of every run, channels = M force.
/// @throws std::invalid_argument where M cannot be inverted, or the force cannot be told
///         from the channels that are measured
std::vector<Run> on_tool(std::span<const ChannelRun> runs, const signal::Matrix3& M);

/// What is fitted to the channels, whatever they read.
struct AxesProblem {
  force::Setup setup;
  force::Law law;
  Options
      options;  ///< their band limit is an upper one: axes show in the low harmonics
};

/// A reading of the channels that leaves less than the chosen one, but takes coefficients
/// that no cut has.
struct PassedOver {
  signal::Matrix3 matrix{};   ///< channels = matrix times force on the tool
  double rms = 0.0;           ///< of the low band [N]
  std::array<double, 3> K{};  ///< cutting coefficients t, r, a [of the law]
};

/// What the channels of a record read, found from the record alone.
struct AxesChoice {
  bool ok = false;
  std::string message;       ///< when not ok, why
  signal::Matrix3 matrix{};  ///< channels = matrix times force on the tool
  double rms = 0.0;          ///< of the low band with this choice [N]; infinite: no fit
  double next_rms = 0.0;     ///< of the next best choice that is not the same data [N]
  std::optional<PassedOver> passed_over = {};  ///< left less, with signs of no cut
  bool signs_clear = true;  ///< false: decided by coefficients that may be negative
  /// Another reading of the same data takes positive coefficients, too: that with K_rc above
  /// K_ac was chosen.
  bool mirrored = false;
  Start start;  ///< runout and phases of the fit with this choice
};

/// @brief Try the signed permutations of the channels.
///
/// The residual of a fit within the lowest harmonics says which channel is z and which
/// way round the others go. All readings are scanned at once on the same force matrices
/// (I-12), and fitted in the order of the scan until the rest could change neither the
/// choice nor what is said about it. Readings that no residual can tell apart (on a
/// cylinder or at one lead angle always eight, else two: the same with all signs turned) are decided by K_tc,
/// K_rc, K_ac > 0. Where the reading that leaves least takes a negative K_tc or a clearly
/// negative K_rc, which no cut has, the first within 1.5 times of it that does not stands
/// before it. Without one of the channels there is no choice.
/// @param told  the part that is done, from 0 to 1, at every step; may be empty
AxesChoice find_axes(const AxesProblem& problem, std::span<const ChannelRun> runs,
                     const std::function<void(double)>& told);

/// @brief What a given reading of the channels leaves, as find_axes compares it [N];
/// infinite where it cannot be fitted.
double reading_rms(const AxesProblem& problem, std::span<const ChannelRun> runs,
                   const signal::Matrix3& M);

}  // namespace trochoid::identification
