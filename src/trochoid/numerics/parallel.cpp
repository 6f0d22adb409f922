#include <trochoid/numerics/parallel.h>

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

namespace trochoid::numerics {

struct ThreadLimit::Control {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(new Control{{tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(threads)}}) {}

ThreadLimit::~ThreadLimit() = default;

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& f) {
  constexpr std::size_t grain = 8;
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

}  // namespace trochoid::numerics
