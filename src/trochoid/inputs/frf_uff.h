#pragma once

#include <trochoid/inputs/frf_file.h>

#include <string>

namespace trochoid::inputs {

/// @brief The frequency response of a universal file, or its hammer blows in time.
/// @throws base::InputError when it holds neither, several and none is chosen, or a wrong
///         one
FrfFile frf_from_uff(const std::string& text, const std::string& name,
                     const FrfSource& source);

}  // namespace trochoid::inputs
