#pragma once

#include <trochoid/dynamics/chatter.h>
#include <trochoid/dynamics/lobes.h>

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

/// Whether a small vibration grows: at one cut, and over spindle speed and axial depth.
namespace trochoid::dynamics {

/// How exactly stability is looked at.
struct StabilityOptions {
  double tolerance = 1e-6;  ///< of the Floquet multiplier, at least 1e-11
  double margin = 0.01;     ///< within this of 1 a multiplier is called marginal
  double chip_floor =
      2e-6;  ///< least chip of the gradient of a power law [m], positive
};

/// What vibrates, what cuts, and where stability is looked at.
struct StabilityProblem {
  force::Setup setup;
  force::Law law;
  System system;
  StabilityOptions options;
  /// Of the stability lobe diagram; without one of the two there is none.
  std::vector<double> spindle_speeds;  ///< [rad/s], ascending
  std::vector<double> depths;          ///< axial [m], ascending, positive
  base::Stop stop;                     ///< the diagram ends with what it has by then
};

enum class StabilityVerdict { stable, unstable, marginal };

/// The names that files use.
constexpr std::string_view name_of(StabilityVerdict verdict) noexcept {
  switch (verdict) {
    case StabilityVerdict::stable:
      return "stable";
    case StabilityVerdict::unstable:
      return "unstable";
    case StabilityVerdict::marginal:
      return "marginal";
  }
  return {};
}

/// The slope of a power law has no limit where the chip begins: |mu| with other floors.
struct ChipFloorCheck {
  double at_half = 0.0;   ///< |mu| with half of the floor
  double at_twice = 0.0;  ///< and with twice of it
  bool decided = true;    ///< the verdict is the same with both
};

/// The limit depth of a cut, and with what it vibrates there.
struct DepthLimit {
  Limit limit;
  std::vector<ChatterLine> lines;  ///< strongest first
};

/// One point of the limit depth over the spindle speed.
struct LimitPoint {
  Limit limit;
  double chatter_frequency = 0.0;  ///< the strongest [Hz]
};

/// @brief Stability of a cut.
struct Stability {
  Multiplier multiplier;
  StabilityVerdict verdict = StabilityVerdict::stable;
  std::vector<ChatterLine> lines;       ///< of the vibration that fades or grows
  double period = 0.0;                  ///< that the multiplier belongs to [rad]
  bool cuts = true;                     ///< false: no tooth cuts anything
  std::optional<ChipFloorCheck> floor;  ///< of a power law
  double greatest_depth = 0.0;          ///< of those looked at for the limit [m]
  std::optional<DepthLimit> limit;      ///< none: all of them are stable
  std::optional<Limit> sharp_limit;     ///< where flanks damp: without that
  LobeGrid lobes;
  std::vector<LimitPoint> limit_curve;  ///< ascending in speed
  /// False: there was no time for all speeds of the lobes, or for the limit curve.
  bool whole = true;
};

/// Told what is computed and how much of it is done, from 0 to 1; may be empty.
using StabilityProgress = std::function<void(const char* what, double share)>;

/// @brief How deep and how fast a problem is looked at.
/// @param fastest  vibration that counts [Hz]
Reach reach_of(const StabilityProblem& problem, double fastest);

/// @brief Floquet multiplier, limit depth and stability lobe diagram of a cut.
///
/// The verdict is `marginal` within the margin of |mu| = 1, and where it depends on the
/// floor of the chip.
Stability stability(const StabilityProblem& problem,
                    const StabilityProgress& progress = {});

/// @brief By what a small vibration grows in a turn, from the linearised cut (D-8).
/// @return nothing where a period of the cut holds more than 400 vibrations of the
/// fastest mode: it would take too long
std::optional<double> linear_growth(const force::Setup& setup, const force::Law& law,
                                    const System& system,
                                    const StabilityOptions& options = {});

}  // namespace trochoid::dynamics
