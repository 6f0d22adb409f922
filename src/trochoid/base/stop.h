#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>

namespace trochoid::base {

/// @brief From when on long work is to end with what it has found; at first never.
///
/// A value that loops ask, from any thread, where what is done so far is an answer.
struct Stop {
  using Clock = std::chrono::steady_clock;
  Clock::time_point at = Clock::time_point::max();
  /// What may still be computed, in evaluations of the force at a point of an edge, for all
  /// copies together; none: as much as it takes. Other than time, it is the same everywhere.
  std::shared_ptr<std::atomic<std::int64_t>> left = nullptr;
  /// What was begun before nothing was left may take so much more.
  std::int64_t grace = 0;

  [[nodiscard]] bool wanted() const noexcept { return spent() || late(); }
  /// Whether even what was begun takes too much, and is to end without an answer.
  [[nodiscard]] bool exhausted() const noexcept {
    return left != nullptr && left->load(std::memory_order_relaxed) <= -grace;
  }
  /// Whether what was begun is to end now, too.
  [[nodiscard]] bool over() const noexcept { return late() || exhausted(); }
  /// Whether the time is up.
  [[nodiscard]] bool late() const noexcept {
    return at != Clock::time_point::max() && Clock::now() >= at;
  }
  /// Whether there is nothing left.
  [[nodiscard]] bool spent() const noexcept {
    return left != nullptr && left->load(std::memory_order_relaxed) <= 0;
  }
  /// So much has been computed.
  void count(double evaluations) const noexcept {
    if (left != nullptr) {
      left->fetch_sub(static_cast<std::int64_t>(evaluations),
                      std::memory_order_relaxed);
    }
  }
};

}  // namespace trochoid::base
