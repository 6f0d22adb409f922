#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/engagement/steps.h>
#include <trochoid/results/program.h>
#include <trochoid/run/progress.h>

#include <optional>
#include <span>
#include <vector>

namespace trochoid::run {

/// What vibrates with a tool, from its case.
engagement::Vibration vibration_of(const cases::Case& given);

/// @brief Where the cuts of a program chatter.
/// @param steps        rows, in their order
/// @param vibrations   of the tools, shape (tools)
/// @return nothing where no case has a mode
std::optional<results::ProgramChatter> chatter_of(
    std::span<const engagement::Step> steps, std::span<const engagement::Tool> tools,
    std::span<const engagement::Vibration> vibrations, const Progress& progress,
    const base::Stop& stop);

/// What an engineer should know of it.
void warn_of_chatter(const results::ProgramChatter& chatter,
                     std::vector<base::Warning>& warnings);

}  // namespace trochoid::run
