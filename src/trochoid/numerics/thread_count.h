#pragma once

#include <trochoid/numerics/parallel.h>

#include <memory>

namespace trochoid::numerics {

/// @brief The limit that the environment variable TROCHOID_THREADS asks for; none: none.
/// @throws base::InputError for anything but a number from 1 to 4096
std::unique_ptr<ThreadLimit> thread_limit_of_environment();

}  // namespace trochoid::numerics
