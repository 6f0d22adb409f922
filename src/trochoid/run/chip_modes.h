#pragma once

#include <trochoid/dynamics/system.h>
#include <trochoid/inputs/machine_tables.h>

#include <span>

namespace trochoid::run {

/// @brief The [[mode]] tables as the chip feels them; modes along z are left out.
///
/// Two of mass, stiffness and frequency give the
/// third; a table mode moves against the tool.
dynamics::System chip_modes(std::span<const inputs::Mode> modes);

}  // namespace trochoid::run
