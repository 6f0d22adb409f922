#pragma once

#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/frequency_response.h>

namespace trochoid::run {

/// @brief The response that blows in time give, in the form of M-22.
structure::FrequencyResponse response_of(const signal::TapResponse& tap,
                                         structure::ResponseKind kind);

/// @brief The lowest line that the hits agree on [rad/s]; 0: nobody knows.
double first_coherent(const signal::TapResponse& tap);

}  // namespace trochoid::run
