#include <trochoid/numerics/parallel.h>

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace trochoid::numerics::parallel_test {

using trochoid::numerics::for_each_index;
using trochoid::numerics::on_one_thread;
using trochoid::numerics::thread_count;
using trochoid::numerics::ThreadLimit;

TEST(Parallel, EachIndexIsVisitedOnce) {
  for (const std::size_t n : {0U, 1U, 7U, 8U, 9U, 1000U}) {
    for (const std::size_t grain : {1U, 8U, 64U}) {
      std::vector<std::atomic<int>> visits(n);
      for_each_index(
          n, [&](std::size_t i) { ++visits[i]; }, grain);
      for (const auto& count : visits) {
        EXPECT_EQ(count, 1) << n << " by " << grain;
      }
    }
  }
}

TEST(Parallel, LoopsMayStandInLoops) {
  std::vector<std::atomic<int>> visits(40 * 30);
  for (int again = 0; again < 20; ++again) {
    for_each_index(
        40,
        [&](std::size_t i) {
          for_each_index(
              30, [&](std::size_t k) { ++visits[30 * i + k]; }, 1);
        },
        1);
  }
  for (const auto& count : visits) {
    EXPECT_EQ(count, 20);
  }
}

TEST(Parallel, SeveralThreadsMayCallAtOnce) {
  std::atomic<int> visits = 0;
  std::vector<std::jthread> callers;
  for (int caller = 0; caller < 4; ++caller) {
    callers.emplace_back([&] {
      for (int again = 0; again < 50; ++again) {
        for_each_index(
            100, [&](std::size_t) { ++visits; }, 1);
      }
    });
  }
  callers.clear();
  EXPECT_EQ(visits, 4 * 50 * 100);
}

TEST(Parallel, AnErrorOfACallArrives) {
  for (int again = 0; again < 50; ++again) {
    EXPECT_THROW(
        for_each_index(
            100, [](std::size_t i) { i == 37 ? throw std::out_of_range("37") : 0; }, 1),
        std::out_of_range);
  }
}

TEST(Parallel, OnOneThreadAllStaysOnIt) {
  on_one_thread([] {
    EXPECT_EQ(thread_count(), 1U);
    const auto here = std::this_thread::get_id();
    for_each_index(
        100, [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), here); }, 1);
  });
}

TEST(Parallel, ALimitHoldsWhileItLives) {
  const std::size_t before = thread_count();
  {
    const ThreadLimit one(1);
    EXPECT_EQ(thread_count(), 1U);
    const ThreadLimit many(100);  // the smallest counts
    EXPECT_EQ(thread_count(), 1U);
    const auto here = std::this_thread::get_id();
    for_each_index(
        100, [&](std::size_t) { EXPECT_EQ(std::this_thread::get_id(), here); }, 1);
  }
  EXPECT_EQ(thread_count(), before);
}

}  // namespace trochoid::numerics::parallel_test
