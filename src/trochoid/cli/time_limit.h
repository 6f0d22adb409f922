#pragma once

#include <trochoid/base/stop.h>

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

namespace trochoid::cli {

/// @brief Ends work that has not ended by itself in time.
class TimeLimit {
 public:
  /// @param seconds  none: there is no limit
  /// @param asked    the work may end by itself when it is asked to: it gets a quarter of
  ///                 the limit more for that, or a second
  /// @param end      ends the program; called by a thread of its own, while the work
  ///                 goes on, and not once this object is no more
  TimeLimit(std::optional<double> seconds, bool asked, std::function<void()> end);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;

  /// When the work is asked to end.
  [[nodiscard]] base::Stop stop() const noexcept { return stop_; }

 private:
  void watch(base::Stop::Clock::time_point last);

  base::Stop stop_;
  std::function<void()> end_;
  bool done_ = false;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::thread watch_;
};

}  // namespace trochoid::cli
