#pragma once

#include <trochoid/numerics/parallel.h>

#include <memory>

namespace trochoid::numerics {

/// No limit is above it.
inline constexpr int most_threads = 4096;

/// @brief The limit that the environment variable TROCHOID_THREADS asks for; none: none.
/// @throws base::InputError for anything but a number from 1 to most_threads
std::unique_ptr<ThreadLimit> thread_limit_of_environment();

}  // namespace trochoid::numerics
