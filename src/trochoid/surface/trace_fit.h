#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/surface/finish.h>

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace trochoid::surface {

/// A line of the floor along the feed, across from the axis by y [m].
struct FloorTrace {
  BottomEdge bottom;
  double y = 0.0;
};

/// A line of the wall along the feed, at a height above the tip [m].
struct WallTrace {
  double height = 0.0;
};

using TraceLine = std::variant<FloorTrace, WallTrace>;

/// @brief A measured roughness trace along the feed.
struct Trace {
  TraceLine line;
  std::vector<double> x;         ///< along the feed [m], ascending
  std::vector<double> z;         ///< height of the surface [m], positive out of it
  std::optional<double> cutoff;  ///< of the Gaussian filter of the instrument [m]
};

/// @brief How deep a tooth reaches, against the one that reaches deepest.
struct ToothDepth {
  bool writes = false;    ///< whether the trace has a mark of it
  base::Estimate offset;  ///< [m], at most 0 but for its error; of a tooth that writes
  double at_most = 0.0;   ///< [m]; of one that does not write: it is shorter than this
  double share = 0.0;     ///< of the trace that it wrote
};

/// @brief A wave of the offsets around the tool: k per turn.
struct OffsetWave {
  int k = 1;
  base::Estimate amplitude;  ///< [m]
  base::Estimate phase;  ///< of its crest, from the first tooth in their order [rad]
};

/// Roughness of the same teeth at another feed [m].
struct FeedRoughness {
  double f_z = 0.0;
  double Ra = 0.0;
  double Ra_alike = 0.0;  ///< with all teeth at one depth
};

/// @brief Which tooth wrote what on a trace, and how far it stands out.
struct TraceFit {
  bool ok = false;
  std::string message = "not fitted";  ///< when not ok, why
  /// Whether the pitch tells which tooth is which. Else they are in the order of passage,
  /// the deepest first.
  bool numbered = false;
  std::vector<ToothDepth> teeth;
  std::vector<OffsetWave> waves;  ///< k = 1 to N/2, where every tooth writes
  base::Estimate feed;            ///< of a turn, as the trace has it [m]
  double turns = 0.0;             ///< that the trace spans
  double rms = 0.0;               ///< of what is left [m]
  double Ra_measured = 0.0;       ///< of the trace less its line and its waviness [m]
  double waviness = 0.0;          ///< taken out, from its lowest to its highest [m]
  double Ra = 0.0;                ///< of the fitted profile, filtered as the trace [m]
  double Ra_alike = 0.0;          ///< of the same with all teeth at one depth [m]
  double correlated = 1.0;        ///< readings that count as one
  double repeating = 0.0;         ///< share of what is left that repeats turn by turn
  std::vector<double> fitted;     ///< shape (x), with level and slope [m]
};

/// Fewest turns on a trace, and readings in one.
inline constexpr double fewest_turns = 3.0;
inline constexpr double fewest_readings_a_tooth = 4.0;

/// @brief The profiles of single teeth, with all others far off.
/// @param setup  its runout does not count
std::vector<PeriodicProfile> teeth_alone(force::Setup setup, const TraceLine& line);

/// @brief Offsets of the teeth from the marks that they left.
///
/// An offset moves all marks of a tooth up or down as they are, so that the profile is the
/// lowest of N known curves, each by its own depth.
///
/// @eq W-7 z(x) = level + slope x + S((x - x_0)/f), S(u) = min over j of P_j(u) - d_j, P_j
///         the profile that tooth j would leave alone (W-3, W-6); d_j less the largest one
///         is the offset; along the axis on the floor, along the radius on the wall
/// @eq W-8 the error of an offset is that for white noise times the root of the readings
///         that count as one, 1 + 2 sum of the autocorrelation of what is left up to its
///         first zero
/// @src derived
/// @param given  its runout does not count
TraceFit fit_trace(const force::Setup& given, const Trace& trace);

/// @brief What the same teeth would leave, from half the feed to one and a half. Teeth that
/// write nothing on the trace are taken to write nothing there.
/// @param fit  of the trace, ok
std::vector<FeedRoughness> roughness_at_feeds(const force::Setup& given,
                                              const Trace& trace, const TraceFit& fit);

}  // namespace trochoid::surface
