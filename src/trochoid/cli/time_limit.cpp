#include <trochoid/cli/time_limit.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace trochoid::cli {

namespace {

using Clock = base::Stop::Clock;

/// For what was asked to end: this part of the limit, and a second at least.
constexpr double patience = 0.25;
constexpr double least_patience = 1.0;  // [s]

Clock::duration seconds_of(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(
      std::chrono::duration<double>(seconds));
}

}  // namespace

TimeLimit::TimeLimit(std::optional<double> seconds, bool asked,
                     std::function<void()> end)
    : end_(std::move(end)) {
  if (!seconds) {
    return;
  }
  stop_.at = Clock::now() + seconds_of(*seconds);
  const auto last =
      stop_.at +
      seconds_of(asked ? std::max(patience * *seconds, least_patience) : 0.0);
  watch_ = std::thread([this, last] { watch(last); });
}

TimeLimit::~TimeLimit() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_all();
  if (watch_.joinable()) {
    watch_.join();
  }
}

void TimeLimit::watch(Clock::time_point last) {
  std::unique_lock lock(mutex_);
  if (!ended_.wait_until(lock, last, [this] { return done_; })) {
    end_();
  }
}

}  // namespace trochoid::cli
