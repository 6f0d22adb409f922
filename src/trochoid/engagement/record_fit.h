#pragma once

#include <trochoid/engagement/record.h>
#include <trochoid/engagement/steps.h>
#include <trochoid/identification/fit.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::engagement {

/// @brief Coefficients of one tool from the means of the steps of a program.
///
/// Linear in the coefficients, so no start is needed. Runout hardly changes means and stays
/// as it is. Power and torque tell the tangential coefficients alone. Errors are those of
/// blocks of steps: what is wrong with one step is wrong with its neighbours.
/// @eq N-24 K = argmin sum |F_measured - D K - c|^2 over steps, D the means for a unit of
///          each coefficient, c the offsets where no air tells them;
///          Cov K = G (sum over blocks of s s') G, G = (D'D)^-1, s = sum over a block D'r
/// @src standard
struct MeanFit {
  std::vector<double> K;                  ///< in the order of force::coefficients
  std::vector<std::optional<double>> se;  ///< nothing: not told, K is that of the tool
  std::size_t steps = 0;                  ///< that were used
  double factor = 2.0;                    ///< of the 95 % interval
  double rms = 0.0;                       ///< that is left, as Recorded::value
};

/// @param tool  of whose steps, in Job::tools
/// @return nothing where too few steps are steady
std::optional<MeanFit> fit_means(const Job& job, std::span<const Step> steps,
                                 const LaidOver& over, const RecordedSteps& recorded,
                                 std::size_t tool);

/// A part of a straight line whose turns are all alike, and what was recorded in it.
struct SteadyCut {
  std::uint32_t line = 0;   ///< of the text, from 1
  double turns = 0.0;       ///< of the spindle
  identification::Run run;  ///< forces in the axes of the feed, without those of air
};

/// @brief Parts of a program that a fit of forces can use: few, as different as there are.
///
/// The speed of the spindle is found in each part. The feed of a tooth is what the machine
/// made of it: of a record that is slower than the program it is smaller.
/// @param idle  of over_steps
/// @param tool  of whose steps, in Job::tools
/// @return nothing where the record has no forces, or too few samples for a tooth
std::vector<SteadyCut> steady_cuts(const Job& job, std::span<const Step> steps,
                                   const LaidOver& over, const Idle& idle,
                                   std::size_t tool);

/// @brief Coefficients and runout of a tool from the forces in steady cuts of a program: the
/// fit of `identify`, in which each cut has its own engagement, feed and phase.
/// @eq N-26 {F}_w = [D_w(p, phi_w)]{K} + c_w over the steady cuts w: one {K} and one runout p,
///          a phase phi_w for each, constants c_w where no air tells them
/// @src derived
/// @param cuts     at least one
/// @param unknowns what is searched of the runout
identification::Fit fit_forces(std::span<const SteadyCut> cuts, const Tool& tool,
                               identification::RunoutUnknowns unknowns,
                               const Idle& idle, const base::Stop& stop);

}  // namespace trochoid::engagement
