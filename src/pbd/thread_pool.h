#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace deformable_manipulation {
namespace pbd {

//! Threads that wait, asleep, for work that falls into independent items.
//!
//! Which thread computes an item is left to chance, so an item must not depend on that. Several
//! bodies may share a pool and use it at the same time: one waits for the other.
class ThreadPool {
 public:
  //! @param threads  at least 1, the calling thread included
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const { return static_cast<int>(helpers_.size()) + 1; }

  //! Calls task(worker, item) for items 0 to count - 1 and returns when all are done. Workers are
  //! numbered from 0 to threads() - 1, and a worker does one item at a time. Nothing is allocated.
  //! The task must not throw.
  template <typename Task>
  void run(int count, Task&& task) {
    using Function = std::remove_reference_t<Task>;
    runJob({[](void* function, int worker, int item) { (*static_cast<Function*>(function))(worker, item); },
            const_cast<void*>(static_cast<const void*>(std::addressof(task))), count});
  }

 private:
  struct Job {
    void (*call)(void* function, int worker, int item);
    void* function;
    int count;
  };

  void runJob(const Job& job);
  void help(int worker);
  void work(int worker, std::unique_lock<std::mutex>& lock);

  std::mutex in_use_;  // by one run() at a time

  std::mutex mutex_;  // of everything below
  std::condition_variable work_to_do_;
  std::condition_variable all_done_;
  Job job_{};
  int next_ = 0;        // item
  int unfinished_ = 0;  // items
  bool closing_ = false;
  std::vector<std::thread> helpers_;
};

}  // namespace pbd
}  // namespace deformable_manipulation
