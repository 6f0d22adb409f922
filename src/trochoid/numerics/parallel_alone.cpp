#include <trochoid/numerics/parallel.h>

namespace trochoid::numerics {

struct ThreadLimit::Control {};

ThreadLimit::ThreadLimit(int /*threads*/) {}

ThreadLimit::~ThreadLimit() = default;

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& f,
                    std::size_t /*grain*/) {
  for (std::size_t i = 0; i < n; ++i) {
    f(i);
  }
}

void on_one_thread(const std::function<void()>& f) {
  f();
}

std::size_t thread_count() {
  return 1;
}

}  // namespace trochoid::numerics
