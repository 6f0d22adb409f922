#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/run/bent.h>
#include <trochoid/run/shared/progress.h>
#include <trochoid/surface/feedback.h>
#include <trochoid/surface/readings.h>

#include <array>
#include <optional>
#include <vector>

namespace trochoid::run {

/// The wall at one height.
struct MapRow {
  double height = 0.0;             ///< above the tip [m]
  std::vector<double> x;           ///< [m]
  std::vector<double> error;       ///< [m]
  std::vector<int> tooth;          ///< that made it, 0-based
  std::vector<double> deflection;  ///< at the angles of the forces [m]
  /// Amplitude of the part of the profile that repeats once a turn, and once a tooth
  /// [m]; only of whole turns of an envelope.
  std::optional<double> once_per_turn;
  double once_per_tooth = 0.0;
  std::optional<std::array<double, 2>> per_K;  ///< imprint: error by K_tc, K_rc
  double compliance = 0.0;  ///< for the whole force, concentrated [m/N]
};

struct ForceRow {
  double phi = 0.0;  ///< [rad]
  double x = 0.0;    ///< of the axis along the feed [m]
  double F_x = 0.0;  ///< on the tool [N]
  double F_y = 0.0;  ///< on the tool [N]
};

/// @brief Everything that `surface` computes.
struct SurfaceMap {
  surface::Model model = surface::Model::envelope;
  surface::Feedback feedback = surface::Feedback::none;
  double sigma = 1.0;  ///< F_normal = sigma F_y
  bool converged = true;
  bool found = true;    ///< false: no deflection agrees with the chip it makes
  int turns = 1;        ///< until the deflection repeated
  double change = 0.0;  ///< of the deflection in the last turn, relative
  std::vector<MapRow> rows;
  std::vector<ForceRow> forces;
  std::optional<Bent> bent;               ///< of what bends, if anything does
  std::vector<double> influence_heights;  ///< [m]
  std::vector<double> of_cutter;          ///< shape (heights, heights) [m/N]
  std::vector<double> of_wall;            ///< shape (heights, heights) [m/N]
};

SurfaceMap surface_map(const inputs::Case& given, const Progress& progress);

}  // namespace trochoid::run
