#pragma once

#include <trochoid/base/estimate.h>
#include <trochoid/results/value.h>

#include <optional>

namespace trochoid::results {

/// @brief An estimate in another unit: value, se, low and high; null where there is none.
Value estimate_value(const std::optional<base::Estimate>& estimate, double unit);

}  // namespace trochoid::results
