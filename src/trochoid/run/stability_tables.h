#pragma once

#include <trochoid/base/table.h>
#include <trochoid/dynamics/lobes.h>

#include <span>

namespace trochoid::run {

/// @brief lobes.csv: |mu| over speed and depth.
base::Table lobes_table(const dynamics::LobeGrid& grid);

/// @brief limit.csv: the least unstable depth over the speed, and the strongest
/// frequency of the vibration that appears there.
base::Table limit_table(const dynamics::DirectionalModel& model,
                        const dynamics::System& system,
                        std::span<const dynamics::Limit> limits);

}  // namespace trochoid::run
