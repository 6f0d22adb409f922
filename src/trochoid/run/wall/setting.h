#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/structure/wall_loads.h>
#include <trochoid/surface/error_map.h>
#include <trochoid/surface/joint_fit.h>
#include <trochoid/surface/pass_sequence.h>
#include <trochoid/surface/setting.h>

#include <optional>
#include <vector>

/// What a case says of its wall, for the room surface.
namespace trochoid::run {

/// [cutter_body]; none: the cutter is rigid.
std::optional<structure::Cantilever> wall_cutter(const inputs::MachineTables& machine);
/// [wall]; none: the wall is rigid.
std::optional<structure::Plate> wall_plate(const inputs::MachineTables& machine);

surface::Setting wall_setting(const inputs::Case& given);

/// Of the wall that `surface` computes.
surface::Feedback wall_feedback(const inputs::Case& given);

/// How `calibrate` fits.
surface::FitOptions wall_fit(const inputs::Case& given);

/// @brief Of the cutter along the wall, at the phase; 0 without [wall] [m].
double wall_position(const inputs::Case& given);

/// @brief Loads of [wall] beside the cut, and where their deflections are wanted.
structure::WallLoads wall_loads(const inputs::Case& given);

/// @brief Every [[pass]] with what it leaves to [cut]; none: one pass, that of [cut].
std::vector<surface::PassCut> wall_passes(const inputs::Case& given);

/// Where `surface` computes the wall.
surface::MapOptions map_options(const inputs::Case& given);

}  // namespace trochoid::run
