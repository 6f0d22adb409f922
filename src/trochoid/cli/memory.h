#pragma once

#include <cstddef>

namespace trochoid::cli {

/// @brief How many bytes were asked for when there was no memory; 0: that never happened.
///
/// The program's own `operator new` keeps it: std::bad_alloc says nothing.
std::size_t refused_bytes() noexcept;

}  // namespace trochoid::cli
