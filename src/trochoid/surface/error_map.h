#pragma once

#include <trochoid/surface/deflected_shape.h>
#include <trochoid/surface/error_statistics.h>
#include <trochoid/surface/roughness.h>
#include <trochoid/surface/setting.h>

#include <array>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace trochoid::surface {

/// Where a wall is computed, and how exactly.
struct MapOptions {
  int samples_per_turn = 720;   ///< along the feed, and of the forces
  double turns = 1.0;           ///< of the spindle
  std::vector<double> angles;   ///< of the forces instead [rad]; empty: as the samples
  std::vector<double> heights;  ///< above the tip, in [0, a_p] [m]; empty: 21 of them
  std::vector<double> influence_heights;  ///< above the tip [m]; empty: the heights
  double position = 0.0;  ///< of the cutter along the wall at the phase [m]
  Feedback feedback = Feedback::none;
  double tolerance = 1e-6;  ///< of the force, where that of the setting is wider
  /// Feedback by equal steps first: to some parts in a thousand, and much faster.
  bool stepwise = false;
};

/// The wall at one height.
struct ErrorRow {
  double height = 0.0;  ///< above the tip [m]
  double stock =
      std::numeric_limits<double>::infinity();  ///< before the cut, where known [m]
  std::vector<double> x;                        ///< along the feed [m]
  std::vector<double> error;  ///< positive: material left, shape of x [m]
  std::vector<int> tooth;     ///< that made it, 0-based, -1: a pass before; shape of x
  ErrorStatistics statistics;
  std::optional<FeedWaves> waves;              ///< of whole turns of an envelope
  std::optional<Roughness> roughness;          ///< along the feed
  std::optional<Roughness> filtered;           ///< the same behind a filter
  std::vector<double> deflection;              ///< at the angles of the forces [m]
  std::optional<std::array<double, 2>> per_K;  ///< imprint: error by K_tc, K_rc
  double compliance = 0.0;  ///< for the whole force, concentrated [m/N]
};

/// The force at one spindle angle.
struct ForceSample {
  double phi = 0.0;       ///< [rad]
  double x = 0.0;         ///< of the axis along the feed [m]
  double F_x = 0.0;       ///< on the tool [N]
  double F_y = 0.0;       ///< on the tool [N]
  double F_normal = 0.0;  ///< positive: pushes cutter and wall apart [N]
};

/// @brief The wall that a cut leaves, and what makes it so.
struct ErrorMap {
  Model model = Model::envelope;
  Feedback feedback = Feedback::none;
  bool converged = true;       ///< false: there is nothing below `change`
  bool found = true;           ///< false: no deflection agrees with the chip it makes
  int turns = 1;               ///< until the deflection repeated
  double change = 0.0;         ///< of the deflection in the last turn, relative
  std::vector<ErrorRow> rows;  ///< one a height
  MeanAndExtremes error;       ///< of all heights [m]
  std::vector<ForceSample> forces;
  MeanAndExtremes F_normal;                 ///< over the forces [N]
  MeanAndExtremes F_x;                      ///< over the forces [N]
  std::optional<DeflectedShape> shape;      ///< at the largest force, if anything gives
  std::vector<double> influence_heights;    ///< [m]
  std::vector<double> influence_of_cutter;  ///< shape (heights, heights) [m/N]
  std::vector<double> influence_of_wall;    ///< shape (heights, heights) [m/N]
};

/// The heights of the options; 21 over the axial depth where they name none [m].
std::vector<double> map_heights(const MapOptions& options, double a_p);

/// Mean of the means of all heights, least and largest of all.
MeanAndExtremes error_of_rows(std::span<const ErrorRow> rows);

/// @brief Error of a wall over feed and height, read as the model of the setting says.
///
/// What stands of the stock of setting.left beyond the reach of the teeth stays (E-41).
/// @param wall_solved  called once the bodies are known, before the cut; may be empty
/// @throws std::invalid_argument where the cut leaves no single wall, and where
/// also_bends meets feedback
ErrorMap error_map(const Setting& setting, const MapOptions& options = {},
                   const std::function<void()>& wall_solved = {});

}  // namespace trochoid::surface
