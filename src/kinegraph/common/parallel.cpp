#include "kinegraph/common/parallel.h"

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

class Parts {
 public:
  Parts(int count, int part, const std::function<void(int, int, int)>& work, const CancellationToken& cancellation)
      : count_(count),
        part_(part),
        parts_(count / part + (count % part > 0)),
        work_(work),
        cancellation_(cancellation),
        failed_(parts_) {}

  void run(int threads) {
    {
      std::vector<std::jthread> others;
      others.reserve(std::size_t(std::max(0, std::min(threads, parts_) - 1)));
      try {
        for (int worker = 1; worker < std::min(threads, parts_); ++worker) {
          ++busy_;
          others.emplace_back([this, worker] { help(worker); });
        }
      } catch (const std::system_error&) {  // the system has no more threads
        --busy_;
      }
      takeParts(0);
      waitForOthers();
    }
    if (cancelled_) std::rethrow_exception(cancelled_);
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  void takeParts(int worker) {
    for (int i = next_++; i < parts_; i = next_++) {
      if (worker == 0 && !mayContinue()) return;
      try {
        work_(worker, i * part_, std::min(count_ - i * part_, part_) + i * part_);
      } catch (...) {
        const std::scoped_lock lock(mutex_);
        if (i < failed_) failure_ = std::current_exception();
        failed_ = std::min(failed_, i);
        next_ = parts_;
        return;
      }
    }
  }

  /// Asks the cancellation token, on the calling thread. False if no further part shall begin.
  bool mayContinue() {
    if (!cancellation_ || cancelled_) return !cancelled_;
    try {
      cancellation_.check();
      return true;
    } catch (...) {
      cancelled_ = std::current_exception();
      next_ = parts_;
      return false;
    }
  }

  void help(int worker) {
    takeParts(worker);
    const std::scoped_lock lock(mutex_);
    if (--busy_ == 0) all_done_.notify_one();
  }

  void waitForOthers() {
    std::unique_lock lock(mutex_);
    while (!all_done_.wait_for(lock, kCancellationInterval, [this] { return busy_ == 0; })) {
      lock.unlock();
      mayContinue();
      lock.lock();
    }
    lock.unlock();
    mayContinue();
  }

  const int count_, part_, parts_;
  const std::function<void(int, int, int)>& work_;
  const CancellationToken& cancellation_;
  std::atomic<int> next_ = 0, busy_ = 0;  ///< next part; number of other threads that still run
  std::mutex mutex_;
  std::condition_variable all_done_;
  std::exception_ptr failure_, cancelled_;
  int failed_;
};

}  // namespace

void parallelFor(int count, int part, int threads, const std::function<void(int, int, int)>& work,
                 const CancellationToken& cancellation) {
  Parts(count, part, work, cancellation).run(threads);
}

}  // namespace kinegraph::inline common_internal
