#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace trochoid::numerics {

/// @brief Call f(0) ... f(n - 1), on several threads where that pays.
///
/// The calls must not depend on one another; results do not depend on the threads.
/// @param grain  so many calls are not worth a thread of their own, at least 1
void for_each_index(std::size_t n, const std::function<void(std::size_t)>& f,
                    std::size_t grain = 8);

/// @brief Call f so that for_each_index within it stays on this thread.
void on_one_thread(const std::function<void()>& f);

/// @brief On how many threads for_each_index works here, at most.
std::size_t thread_count();

/// @brief Limits the number of threads of for_each_index while it lives.
class ThreadLimit {
 public:
  /// @param threads  at least 1
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

}  // namespace trochoid::numerics
