#pragma once

#include <trochoid/base/command.h>
#include <trochoid/base/stop.h>
#include <trochoid/cases/case.h>
#include <trochoid/results/answer.h>
#include <trochoid/run/progress.h>

namespace trochoid::run {

/// What a command is told besides its case.
struct AnswerOptions {
  bool curves = false;               ///< of identify: every sample
  bool moves = false;                ///< of program: every one, however many
  bool simulate_controller = false;  ///< of correct
  bool anyway = false;               ///< of identify: whatever work it takes
  bool tables = true;                ///< of simulate
};

/// @brief The answer of any command to its case, without files.
///
/// @param progress  told what is done; what it throws ends the work
/// @param stop      when identify and stability are to end with what they have
/// @throws base::InputError when a measurement cannot be read
results::Answer answer(base::Command command, const cases::Case& given,
                       const AnswerOptions& options = {}, const Progress& progress = {},
                       base::Stop stop = {});

}  // namespace trochoid::run
