// The threads that share the copies.

#include <gtest/gtest.h>

#include <algorithm>
#include <condition_variable>
#include <mutex>
#include <numeric>
#include <thread>
#include <vector>

#include "../../src/pbd/thread_pool.h"

namespace deformable_manipulation {
namespace pbd {
namespace {

TEST(ThreadPool, doesEveryItemOnce) {
  for (int threads : {1, 2, 5}) {
    ThreadPool pool(threads);
    EXPECT_EQ(pool.threads(), threads);
    for (int count : {0, 1, 2, 100}) {
      std::vector<int> done(count, 0);
      for (int round = 1; round <= 50; ++round) {
        pool.run(count, [&](int, int item) { ++done[item]; });
        EXPECT_EQ(std::count(done.begin(), done.end(), round), count);
      }
    }
  }
}

TEST(ThreadPool, givesAWorkerOneItemAtATime) {
  ThreadPool pool(4);
  std::vector<long> sums(pool.threads(), 0);  // unguarded: each worker adds to its own
  pool.run(1000, [&](int worker, int item) { sums[worker] += item; });
  EXPECT_EQ(std::accumulate(sums.begin(), sums.end(), 0L), 999L * 1000L / 2L);
}

TEST(ThreadPool, usesSeveralThreads) {
  ThreadPool pool(2);
  std::mutex mutex;
  std::condition_variable both;
  int present = 0;
  pool.run(2, [&](int, int) {  // neither item ends before the other has begun
    std::unique_lock<std::mutex> lock(mutex);
    ++present;
    both.notify_all();
    both.wait(lock, [&] { return present == 2; });
  });
  EXPECT_EQ(present, 2);
}

TEST(ThreadPool, isSharedByCallers) {
  ThreadPool pool(2);
  std::vector<std::vector<int>> done(3, std::vector<int>(20, 0));
  std::vector<std::thread> callers;
  for (std::vector<int>& mine : done) {
    callers.emplace_back([&] {
      for (int round = 0; round < 200; ++round) {
        pool.run(20, [&](int, int item) { ++mine[item]; });
      }
    });
  }
  for (std::thread& caller : callers) {
    caller.join();
  }
  for (const std::vector<int>& mine : done) {
    EXPECT_EQ(mine, std::vector<int>(20, 200));
  }
}

}  // namespace
}  // namespace pbd
}  // namespace deformable_manipulation
