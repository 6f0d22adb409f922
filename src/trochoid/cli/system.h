#pragma once

#include <cstddef>

/// What the program asks of the system that it runs on: a console, and memory.
namespace trochoid::cli {

/// @brief Bytes go out as they are, in UTF-8, whatever the console was set to.
void prepare_console();

/// @brief Whether stderr is a terminal that knows how a line is cleared.
bool clears_lines();

/// @brief How many bytes were asked for when there was no memory; 0: that never happened.
///
/// The program's own `operator new` keeps it: std::bad_alloc says nothing.
std::size_t refused_bytes() noexcept;

/// @brief Say, without asking for any, that there is no memory for a command.
void say_no_memory(const char* command) noexcept;

/// @brief Say it also where a library of others lets nothing out, and end there.
/// @param command  kept, not copied
void say_no_memory_at_the_end_of(const char* command) noexcept;

}  // namespace trochoid::cli
