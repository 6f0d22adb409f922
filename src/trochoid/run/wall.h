#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/case.h>
#include <trochoid/results/surface.h>
#include <trochoid/structure/wall_loads.h>
#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/datum.h>
#include <trochoid/surface/error_map.h>
#include <trochoid/surface/joint_fit.h>
#include <trochoid/surface/pass_sequence.h>
#include <trochoid/surface/readings.h>
#include <trochoid/surface/setting.h>

#include <optional>
#include <span>
#include <vector>

/// What a case says of its wall, for the room surface, and what is to be said of it.
namespace trochoid::run {

/// [cutter_body]; none: the cutter is rigid.
std::optional<structure::Cantilever> wall_cutter(const cases::MachineTables& machine);
/// [wall]; none: the wall is rigid.
std::optional<structure::Plate> wall_plate(const cases::MachineTables& machine);

/// Both, and where they meet.
surface::BodyDimensions wall_dimensions(const cases::Case& given);

surface::Setting wall_setting(const cases::Case& given);

/// Of the wall that `surface` computes.
surface::Feedback wall_feedback(const cases::Case& given);

/// How `calibrate` fits.
surface::FitOptions wall_fit(const cases::Case& given);

/// @brief Of the cutter along the wall, at the phase; 0 without [wall] [m].
double wall_position(const cases::Case& given);

/// @brief Loads of [wall] beside the cut, and where their deflections are wanted.
structure::WallLoads wall_loads(const cases::Case& given);

/// @brief Every [[pass]] with what it leaves to [cut]; none: one pass, that of [cut].
std::vector<surface::PassCut> wall_passes(const cases::Case& given);

/// Where `surface` computes the wall.
surface::MapOptions map_options(const cases::Case& given);

/// All [[surface_measurement]] of a case, as the room surface takes them.
struct MeasuredWall {
  std::vector<surface::Reading> readings;
  std::vector<surface::Datum> datum;  ///< of each file
  files::SurfaceCounts counts;        ///< of all files
  std::vector<base::Warning> notes;   ///< what was left out or averaged, by file
};

/// @throws base::InputError with the problems of all files
MeasuredWall measured_wall(const cases::Case& given);

/// @brief Warnings about what bends: a wall that bends by more than half its thickness,
/// and a chip that the deflection would change.
/// @param largest  error of the wall [m]
/// @param a_e      radial depth of the cut [m]
void add_bending_warnings(const cases::Case& given, double largest, double a_e,
                          std::vector<base::Warning>& warnings);

/// @brief What an engineer should know before trusting a computed wall.
void add_surface_warnings(const cases::Case& given, const results::SurfaceResult& r,
                          std::vector<base::Warning>& warnings);

/// @brief What an engineer should know before trusting a calibration.
void add_calibration_warnings(const cases::Case& given,
                              std::span<const surface::Reading> readings,
                              const surface::Calibration& calibration,
                              std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
