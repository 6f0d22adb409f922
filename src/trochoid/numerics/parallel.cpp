#include <trochoid/numerics/parallel.h>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace trochoid::numerics {

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(new Control{{tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(threads)}}) {}

ThreadLimit::~ThreadLimit() = default;

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& f,
                    std::size_t grain) {
  if (n <= grain) {
    for (std::size_t i = 0; i < n; ++i) {
      f(i);
    }
    return;
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, n, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) {
                        f(i);
                      }
                    });
}

void on_one_thread(const std::function<void()>& f) {
  tbb::task_arena alone(1);
  alone.execute(f);
}

std::size_t thread_count() {
  const std::size_t allowed =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  const auto here = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  return std::max<std::size_t>(1, std::min(allowed, here));
}

}  // namespace trochoid::numerics
