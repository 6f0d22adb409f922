#pragma once

#include <trochoid/inputs/case.h>
#include <trochoid/signal/record.h>

namespace trochoid::inputs {

/// @brief Read a measured force record (CSV or DynoWare) into SI.
/// @throws base::InputError with every problem of the file (at most 50 lines shown)
signal::Record read_record(const Measurement& measurement);

}  // namespace trochoid::inputs
