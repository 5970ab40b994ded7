#include "thread_pool.h"

namespace deformable_manipulation {
namespace pbd {

ThreadPool::ThreadPool(int threads) {
  for (int worker = 1; worker < threads; ++worker) {
    helpers_.emplace_back([this, worker] { help(worker); });
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    closing_ = true;
  }
  work_to_do_.notify_all();
  for (std::thread& helper : helpers_) {
    helper.join();
  }
}

void ThreadPool::runJob(const Job& job) {
  const std::lock_guard<std::mutex> use(in_use_);
  std::unique_lock<std::mutex> lock(mutex_);
  job_ = job;
  next_ = 0;
  unfinished_ = job.count;
  if (job.count > 1) {
    work_to_do_.notify_all();
  }
  work(0, lock);
  all_done_.wait(lock, [this] { return unfinished_ == 0; });
}

void ThreadPool::help(int worker) {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!closing_) {
    work(worker, lock);
    work_to_do_.wait(lock, [this] { return closing_ || next_ < job_.count; });
  }
}

//! Takes items of the job until there are none left.
void ThreadPool::work(int worker, std::unique_lock<std::mutex>& lock) {
  while (next_ < job_.count) {
    const Job job = job_;
    const int item = next_++;
    lock.unlock();
    job.call(job.function, worker, item);
    lock.lock();
    if (--unfinished_ == 0) {
      all_done_.notify_one();
    }
  }
}

}  // namespace pbd
}  // namespace deformable_manipulation
