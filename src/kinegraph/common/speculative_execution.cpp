#include "kinegraph/common/speculative_execution.h"

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

/// Ends work that waits for other work after cancelAll.
struct AllCancelled {};

}  // namespace

struct SpeculativeExecutor::Item {
  enum class State { idle, begun, running, ended };

  Work work;
  State state = State::idle;
  Priority priority = Priority::high;
  std::atomic<bool> is_dropped = false;
  std::exception_ptr failure;
};

class SpeculativeExecutor::WorkerPool {
 public:
  WorkerPool(int threads, CancellationToken cancellation) : threads_(threads), cancellation_(std::move(cancellation)) {}
  ~WorkerPool() { cancelAll(); }

  void begin(const std::shared_ptr<Item>& item, Priority priority) {
    if (threads_ < 2) return;
    {
      const std::scoped_lock lock(mutex_);
      if (item->state == Item::State::begun) std::erase(queue_, item);
      if (item->state != Item::State::idle && item->state != Item::State::begun) return;
      item->state = Item::State::begun;
      item->priority = priority;
      queue_.push_back(item);
      startWorkers();
    }
    changed_.notify_all();
  }

  void finish(const std::shared_ptr<Item>& item) {
    std::unique_lock lock(mutex_);
    while (item->state != Item::State::ended) {
      throwInterruption();
      if (is_over_) throw AllCancelled();
      if (item->state != Item::State::running) {
        take(item);
        run(item, lock);
      } else if (const std::shared_ptr<Item> other = next(item->priority)) {
        take(other);
        run(other, lock);
      } else {
        changed_.wait_for(lock, kCancellationInterval);
        askUnlocked(lock);
      }
    }
    if (item->failure) std::rethrow_exception(item->failure);
  }

  /// Cancels work whose result will not be requested.
  void drop(const std::shared_ptr<Item>& item) {
    item->is_dropped = true;
    const std::scoped_lock lock(mutex_);
    std::erase(queue_, item);
  }

  void cancelAll() {
    {
      const std::scoped_lock lock(mutex_);
      is_over_ = true;
      for (const std::shared_ptr<Item>& item : queue_) item->state = Item::State::idle;
      queue_.clear();
    }
    changed_.notify_all();
    workers_.clear();  // joins them
    is_over_ = false;
    interruption_ = nullptr;
    caller_ = std::this_thread::get_id();
  }

 private:
  void startWorkers() {
    if (!workers_.empty()) return;
    try {
      for (int i = 1; i < threads_; ++i) workers_.emplace_back([this] { work(); });
    } catch (const std::system_error&) {  // no more threads
    }
  }

  void work() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return is_over_ || !queue_.empty(); });
      if (is_over_) return;
      const std::shared_ptr<Item> item = next(Priority::low);
      take(item);
      run(item, lock);
    }
  }

  /// Returns queued work of the highest priority, or null if that is below `least`.
  std::shared_ptr<Item> next(Priority least) const {
    const auto first = std::ranges::min_element(queue_, {}, &Item::priority);
    return first == queue_.end() || (*first)->priority > least ? nullptr : *first;
  }

  void take(const std::shared_ptr<Item>& item) {
    if (item->state == Item::State::begun) std::erase(queue_, item);
    item->state = Item::State::running;
  }

  void run(const std::shared_ptr<Item>& item, std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    Work work = std::move(item->work);
    std::exception_ptr failure;
    try {
      work([this, item] { return item->is_dropped || is_over_ || !mayContinue(); });
    } catch (...) {
      failure = std::current_exception();
    }
    const bool is_stopped = is_over_;  // the result may be partial
    if (is_stopped)
      item->work = std::move(work);
    else
      work = nullptr;  // frees its captures
    lock.lock();
    item->failure = is_stopped ? nullptr : failure;
    item->state = is_stopped ? Item::State::idle : Item::State::ended;
    changed_.notify_all();
    throwInterruption();
  }

  /// Asks the cancellation token if this is the calling thread. False if all work shall end.
  bool mayContinue() {
    if (!cancellation_ || std::this_thread::get_id() != caller_) return true;
    try {
      cancellation_.check();
      return true;
    } catch (...) {
      interruption_ = std::current_exception();
      is_over_ = true;
      return false;
    }
  }

  void askUnlocked(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    mayContinue();
    lock.lock();
    throwInterruption();
  }

  void throwInterruption() {
    if (std::this_thread::get_id() == caller_ && interruption_) std::rethrow_exception(interruption_);
  }

  const int threads_;
  const CancellationToken cancellation_;
  std::thread::id caller_ = std::this_thread::get_id();
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> is_over_ = false;
  std::exception_ptr interruption_;  ///< from the cancellation token, until `cancelAll`
  std::vector<std::shared_ptr<Item>> queue_;
  std::vector<std::jthread> workers_;
};

SpeculativeExecutor::SpeculativeExecutor(int threads, CancellationToken cancellation)
    : pool_(std::make_shared<WorkerPool>(threads, std::move(cancellation))) {}
SpeculativeExecutor::~SpeculativeExecutor() { cancelAll(); }

void SpeculativeExecutor::cancelAll() { pool_->cancelAll(); }

SpeculativeExecutor::Task::Task(std::shared_ptr<WorkerPool> pool, Work work)
    : pool_(std::move(pool)), item_(std::make_shared<Item>()) {
  item_->work = std::move(work);
}

SpeculativeExecutor::Task& SpeculativeExecutor::Task::operator=(Task&& other) noexcept {
  if (this == &other) return *this;
  if (item_) pool_->drop(item_);
  pool_ = std::move(other.pool_);
  item_ = std::move(other.item_);
  return *this;
}

SpeculativeExecutor::Task::~Task() {
  if (item_) pool_->drop(item_);
}

void SpeculativeExecutor::Task::begin(Priority priority) const { pool_->begin(item_, priority); }

void SpeculativeExecutor::Task::finish() const { pool_->finish(item_); }

}  // namespace kinegraph::inline common_internal
