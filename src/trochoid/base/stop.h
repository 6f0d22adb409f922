#pragma once

#include <chrono>

namespace trochoid::base {

/// @brief From when on long work is to end with what it has found; at first never.
///
/// A value that loops ask, from any thread, where what is done so far is an answer.
struct Stop {
  using Clock = std::chrono::steady_clock;
  Clock::time_point at = Clock::time_point::max();

  [[nodiscard]] bool wanted() const noexcept {
    return at != Clock::time_point::max() && Clock::now() >= at;
  }
};

}  // namespace trochoid::base
