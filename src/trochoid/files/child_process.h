#pragma once

#include <functional>
#include <string>

#include <trochoid/signal/record.h>

namespace trochoid::files {

/// @brief Read a record in a process of its own.
///
/// A library that goes astray in a damaged file then takes nothing with it, be it that it
/// breaks down, that it never ends or that it forgets memory.
/// @param read  may throw base::InputError; nothing else that it changes is seen here
/// @throws base::InputError  that of `read`, or that the process did not end well
signal::Record read_in_child_process(const std::string& name,
                                     const std::function<signal::Record()>& read);

}  // namespace trochoid::files
