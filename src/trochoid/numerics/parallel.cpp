#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <set>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

namespace trochoid::numerics {

namespace {

/// One call of for_each_index: whoever has time takes the next few of its calls.
struct Job {
  const std::function<void(std::size_t)>& f;
  std::size_t n;
  std::size_t grain;
  std::atomic<std::size_t> next{0};
  std::size_t helpers = 0;        ///< threads of the pool that are at it
  std::exception_ptr error = {};  ///< the first
};

/// Threads that help with the jobs that are open, the innermost first. Who opened a job
/// works on it until nothing is left to take, so that no job waits for a helper to come,
/// and jobs may be opened within jobs. The threads are never ended: the C library for
/// Windows holds a lock while the program exits, and a thread that ends may ask for it.
class Pool {
 public:
  Pool() {
    const std::lock_guard lock(mutex_);  // they ask how many there are
    const unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    try {
      for (unsigned i = 1; i < threads; ++i) {
        std::thread([this, i] { help(i); }).detach();
        ++workers_;
      }
    } catch (const std::system_error&) {  // the system gives no more
    }
  }

  std::size_t allowed() {
    const std::lock_guard lock(mutex_);
    return allowed_now();
  }

  void limit(std::size_t threads) {
    const std::lock_guard lock(mutex_);
    limits_.insert(threads);
  }

  void unlimit(std::size_t threads) {
    const std::lock_guard lock(mutex_);
    limits_.erase(limits_.find(threads));
    work_.notify_all();
  }

  void run(Job& job) {
    {
      const std::lock_guard lock(mutex_);
      open_.push_back(&job);
    }
    work_.notify_all();
    take(job);
    std::unique_lock lock(mutex_);
    std::erase(open_, &job);
    done_.wait(lock, [&] { return job.helpers == 0; });
    if (job.error) {
      std::rethrow_exception(job.error);
    }
  }

 private:
  std::size_t allowed_now() const {
    const std::size_t all = workers_ + 1;
    return limits_.empty() ? all : std::min(all, *limits_.begin());
  }

  void take(Job& job) {
    for (;;) {
      const std::size_t first = job.next.fetch_add(job.grain);
      if (first >= job.n) {
        return;
      }
      try {
        const std::size_t end = std::min(job.n, first + job.grain);
        for (std::size_t i = first; i < end; ++i) {
          job.f(i);
        }
      } catch (...) {
        job.next = job.n;  // the rest is not wanted any more
        const std::lock_guard lock(mutex_);
        if (!job.error) {
          job.error = std::current_exception();
        }
      }
    }
  }

  Job* unfinished() const {
    const auto found = std::find_if(open_.rbegin(), open_.rend(),
                                    [](const Job* job) { return job->next < job->n; });
    return found == open_.rend() ? nullptr : *found;
  }

  /// @param number  of this thread, from 1: the first ones stay when fewer are allowed
  [[noreturn]] void help(std::size_t number) {
    std::unique_lock lock(mutex_);
    for (;;) {
      Job* job = nullptr;
      work_.wait(lock, [&] {
        job = number < allowed_now() ? unfinished() : nullptr;
        return job != nullptr;
      });
      ++job->helpers;
      lock.unlock();
      take(*job);
      lock.lock();
      --job->helpers;
      done_.notify_all();
    }
  }

  std::mutex mutex_;
  std::condition_variable work_;
  std::condition_variable done_;
  std::vector<Job*> open_;
  std::multiset<std::size_t> limits_;
  std::size_t workers_ = 0;
};

Pool& pool() {
  static Pool& threads = *new Pool;
  return threads;
}

thread_local bool alone = false;

}  // namespace

struct ThreadLimit::Control {
  std::size_t threads;
};

ThreadLimit::ThreadLimit(int threads)
    : control_(new Control{static_cast<std::size_t>(threads)}) {
  pool().limit(control_->threads);
}

ThreadLimit::~ThreadLimit() {
  pool().unlimit(control_->threads);
}

void for_each_index(std::size_t n, const std::function<void(std::size_t)>& f,
                    std::size_t grain) {
  if (n <= grain || thread_count() == 1) {
    for (std::size_t i = 0; i < n; ++i) {
      f(i);
    }
    return;
  }
  Job job{.f = f, .n = n, .grain = grain};
  pool().run(job);
}

void on_one_thread(const std::function<void()>& f) {
  struct Alone {
    bool before = std::exchange(alone, true);
    ~Alone() { alone = before; }
  } const here;
  f();
}

std::size_t thread_count() {
  return alone ? 1 : pool().allowed();
}

}  // namespace trochoid::numerics
