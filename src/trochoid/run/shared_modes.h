#pragma once

#include <trochoid/cases/case.h>
#include <trochoid/results/modes.h>
#include <trochoid/structure/modes_fit.h>

#include <optional>

namespace trochoid::run {

/// @brief Whether `modes` of a case are those that several responses share, or complex.
///
/// [[measured_frf]] without a file in [frf], or a universal file with responses of one
/// point along x and y of which none is chosen.
/// @throws base::InputError when the file cannot be read
bool modes_are_shared(const cases::Case& given);

/// @brief Modes that several responses share.
/// @throws base::InputError when a file cannot be read
/// @param known  the fit, where it is there already
results::ModesResult shared_modes(const cases::Case& given,
                                  std::optional<structure::ModesFit> known = {});

}  // namespace trochoid::run
