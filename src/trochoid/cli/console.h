#pragma once

namespace trochoid::cli {

/// @brief Bytes go out as they are, in UTF-8, whatever the console was set to.
void prepare_console();

/// @brief Whether stderr is a terminal that knows how a line is cleared.
bool clears_lines();

}  // namespace trochoid::cli
