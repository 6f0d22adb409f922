#pragma once

#include <trochoid/files/frf_file.h>

#include <string>

namespace trochoid::files {

/// @brief The frequency response of a universal file, or its hammer blows in time.
/// @throws base::InputError when it holds neither, several and none is chosen, or a wrong
///         one
FrfFile frf_from_uff(const std::string& text, const std::string& name,
                     const FrfSource& source);

/// @brief All responses of a universal file, where they are of one point along x and y.
/// @return empty: one response only, or of several points, or along z, or not joined by a
///         cross response
/// @throws base::InputError where one of them is wrong
std::vector<DirectedFrf> directed_frfs_from_uff(const std::string& text,
                                                const std::string& name,
                                                const FrfSource& source);

}  // namespace trochoid::files
