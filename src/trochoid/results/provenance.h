#pragma once

#include <string_view>

namespace trochoid::results {

/// Version of the project, for example `0.2.0`.
std::string_view version();

/// Git commit that was built, with `-dirty` after changes; `unknown` outside git.
std::string_view commit();

}  // namespace trochoid::results
