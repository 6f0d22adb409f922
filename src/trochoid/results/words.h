#pragma once

#include <trochoid/results/answer.h>

namespace trochoid::results {

/// @brief What the page says as the terminal does, and what it does not decide again: made
/// of the numbers of a summary, which may have been read from a folder.
Object words_of(const Answer& answer);

}  // namespace trochoid::results
