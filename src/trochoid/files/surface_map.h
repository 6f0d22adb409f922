#pragma once

#include <trochoid/files/surface_file.h>

#include <array>
#include <cstdint>
#include <istream>
#include <string>
#include <string_view>
#include <vector>

/// Maps of a surface: heights over a grid, in X3P and SDF files.
namespace trochoid::files {

/// Points are X = offset + i step, Y = offset + j step, and Z.
struct SurfaceMap {
  std::size_t columns = 0;         ///< along X
  std::size_t rows = 0;            ///< along Y
  std::array<double, 2> step{};    ///< [m]
  std::array<double, 2> offset{};  ///< [m]
  std::vector<double> z;           ///< row by row [m]; NaN: not measured
};

/// More points than any wall needs: refused before memory is taken.
inline constexpr std::uint64_t most_points = std::uint64_t{1} << 22U;

/// @brief What is wrong with the size of a map; empty: nothing.
std::string wrong_size(double columns, double rows);

/// Whether the first bytes are those of an SDF file (ISO 25178-71), text or binary.
bool is_sdf(std::string_view head);

/// @throws base::InputError
SurfaceMap read_sdf(std::istream& in, const std::string& name);

/// Whether the first bytes are those of an archive, as X3P is one.
bool is_archive(std::string_view head);

/// @brief Read X3P (ISO 25178-72, ISO 5436-2).
/// @throws base::InputError
SurfaceMap read_x3p(std::istream& in, const std::string& name);

/// @brief Readings of a map. Without a frame X is along the feed, Y above the tip and Z
/// the error.
/// @throws base::InputError  more than half of the points were not measured
SurfaceFile readings_of(const SurfaceMap& map, const SurfaceSource& source);

}  // namespace trochoid::files
