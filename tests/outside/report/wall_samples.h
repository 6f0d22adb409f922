#pragma once

#include <trochoid/results/answer.h>

#include <filesystem>

/// Answers of `surface` and `calibrate` as the program gives
/// them, so that the pages are tested against what is really
/// written. The walls are computed, their noise is made.
namespace sample {

/// @param model   of [surface]
/// @param folder  where the case is written
trochoid::results::Answer wall(const char* model, const std::filesystem::path& folder);

/// @brief Calibration of such a wall, with a micrometre of noise and a datum offset.
/// @param number_teeth  whether the readings tell the tooth
trochoid::results::Answer calibration(const char* model, bool number_teeth,
                                      const std::filesystem::path& folder);

/// @brief Readings at one height, which cannot tell the coefficients apart.
trochoid::results::Answer one_height(const std::filesystem::path& folder);

/// The lobes of a new case of `stability`.
trochoid::results::Answer lobes(const std::filesystem::path& folder);

/// Forces along the program of an example.
trochoid::results::Answer along_program();

/// How to measure and cut a wall.
trochoid::results::Answer wall_plan(const std::filesystem::path& folder);

}  // namespace sample
