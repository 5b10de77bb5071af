#include "kinegraph/common/ordered_parallel.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

#include "kinegraph/common/cancellation_interval.h"

namespace kinegraph::inline common_internal {

namespace {

using Job = std::function<void(int, const CancellationToken&)>;
using Take = std::function<bool(int)>;

class OrderedJobs {
 public:
  OrderedJobs(int count, int threads, const Job& job, const CancellationToken& cancellation)
      : count_(count), threads_(threads), job_(job), cancellation_(cancellation), ended_(std::size_t(count)) {
    const int workers = std::min(count, threads);
    workers_.reserve(std::size_t(workers));
    try {
      for (int i = 0; i < workers; ++i) workers_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // the system has no more threads
      if (workers_.empty()) throw;
    }
  }

  ~OrderedJobs() {
    {
      const std::scoped_lock lock(mutex_);
      cancelled_ = true;
    }
    changed_.notify_all();
  }

  void run(const Take& take) {
    for (int i = 0; i < count_; ++i) {
      wait(i);
      if (ended_[std::size_t(i)].failure) std::rethrow_exception(ended_[std::size_t(i)].failure);
      if (!take(i)) return;
      const std::scoped_lock lock(mutex_);
      taken_ = i + 1;
      changed_.notify_all();
    }
  }

 private:
  struct End {
    bool has_ended = false;
    std::exception_ptr failure;
  };

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return cancelled_ || next_ == count_ || next_ < taken_ + threads_; });
      if (cancelled_ || next_ == count_) return;
      const int i = next_++;
      lock.unlock();
      std::exception_ptr failure;
      try {
        job_(i, [this] { return cancelled_.load(); });
      } catch (...) {
        failure = std::current_exception();
      }
      lock.lock();
      ended_[std::size_t(i)] = {true, failure};
      changed_.notify_all();
    }
  }

  void wait(int job) {
    cancellation_.check();  // also if all jobs are short
    std::unique_lock lock(mutex_);
    while (!changed_.wait_for(lock, kCancellationInterval, [&] { return ended_[std::size_t(job)].has_ended; })) {
      lock.unlock();
      cancellation_.check();
      lock.lock();
    }
  }

  const int count_, threads_;
  const Job& job_;
  const CancellationToken& cancellation_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> cancelled_ = false;
  int next_ = 0, taken_ = 0;
  std::vector<End> ended_;
  std::vector<std::jthread> workers_;  ///< the last member: joined before the others are destroyed
};

}  // namespace

void orderedParallelFor(int count, int threads, const Job& job, const Take& take,
                        const CancellationToken& cancellation) {
  if (threads > 1 && count > 0) return OrderedJobs(count, threads, job, cancellation).run(take);
  const CancellationToken job_cancellation = [&] {
    cancellation.check();
    return false;
  };
  for (int i = 0; i < count; ++i) {
    cancellation.check();
    job(i, job_cancellation);
    if (!take(i)) return;
  }
}

}  // namespace kinegraph::inline common_internal
