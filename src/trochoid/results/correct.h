#pragma once

#include <trochoid/correction/correct.h>
#include <trochoid/results/answer.h>

namespace trochoid::results {

/// @brief What `correct` answers: the motion that cancels runout, its command, and the
/// cut before and after.
struct CorrectResult {
  Heading heading;
  correction::CorrectionOptions options;  ///< what was asked
  correction::Correction correction;      ///< what was found
};

/// @brief Whether anything better could be found, and how this is known.
std::string optimum_words(const correction::Optimum& optimum);

Answer answer_of(const CorrectResult& result);

}  // namespace trochoid::results
