#include "kinegraph/common/speculative_execution.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace kinegraph {

namespace {

constexpr std::chrono::milliseconds kLook{20};

/// Ends work that waits for other work where all is to end.
struct AllIsOver {};

}  // namespace

struct SpeculativeExecutor::Item {
  enum class State { idle, begun, running, ended };

  Work work;
  State state = State::idle;
  Priority wanted = Priority::surely;
  std::atomic<bool> is_unwanted = false;
  std::exception_ptr failure;
};

class SpeculativeExecutor::Crew {
 public:
  Crew(int threads, CancellationToken cancellation) : threads_(threads), cancellation_(std::move(cancellation)) {}
  ~Crew() { rest(); }

  void begin(const std::shared_ptr<Item>& item, Priority wanted) {
    if (threads_ < 2) return;
    {
      const std::scoped_lock lock(mutex_);
      if (item->state == Item::State::begun) std::erase(queue_, item);
      if (item->state != Item::State::idle && item->state != Item::State::begun) return;
      item->state = Item::State::begun;
      item->wanted = wanted;
      queue_.push_back(item);
      hire();
    }
    changed_.notify_all();
  }

  void finish(const std::shared_ptr<Item>& item) {
    std::unique_lock lock(mutex_);
    while (item->state != Item::State::ended) {
      throwInterruption();
      if (is_over_) throw AllIsOver();
      if (item->state != Item::State::running) {
        take(item);
        run(item, lock);
      } else if (const std::shared_ptr<Item> other = next(item->wanted)) {
        take(other);
        run(other, lock);
      } else {
        changed_.wait_for(lock, kLook);
        askInBreak(lock);
      }
    }
    if (item->failure) std::rethrow_exception(item->failure);
  }

  /// Nobody will ask for it.
  void drop(const std::shared_ptr<Item>& item) {
    item->is_unwanted = true;
    const std::scoped_lock lock(mutex_);
    std::erase(queue_, item);
  }

  void rest() {
    {
      const std::scoped_lock lock(mutex_);
      is_over_ = true;
      for (const std::shared_ptr<Item>& item : queue_) item->state = Item::State::idle;
      queue_.clear();
    }
    changed_.notify_all();
    workers_.clear();  // which waits for them
    is_over_ = false;
    interruption_ = nullptr;
    caller_ = std::this_thread::get_id();
  }

 private:
  void hire() {
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
      const std::shared_ptr<Item> item = next(Priority::maybe);
      take(item);
      run(item, lock);
    }
  }

  /// What is wanted most, and at least so much.
  std::shared_ptr<Item> next(Priority least) const {
    const auto most = std::ranges::min_element(queue_, {}, &Item::wanted);
    return most == queue_.end() || (*most)->wanted > least ? nullptr : *most;
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
      work([this, item] { return item->is_unwanted || is_over_ || !ask(); });
    } catch (...) {
      failure = std::current_exception();
    }
    const bool is_stopped = is_over_;  // then it is no result
    if (is_stopped)
      item->work = std::move(work);
    else
      work = nullptr;  // with what it holds
    lock.lock();
    item->failure = is_stopped ? nullptr : failure;
    item->state = is_stopped ? Item::State::idle : Item::State::ended;
    changed_.notify_all();
    throwInterruption();
  }

  /// False: the calling thread is to end all.
  bool ask() {
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

  void askInBreak(std::unique_lock<std::mutex>& lock) {
    lock.unlock();
    ask();
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
  std::exception_ptr interruption_;  ///< of the calling thread, by `cancellation`, until all rest
  std::vector<std::shared_ptr<Item>> queue_;
  std::vector<std::jthread> workers_;
};

SpeculativeExecutor::SpeculativeExecutor(int threads, CancellationToken cancellation)
    : crew_(std::make_shared<Crew>(threads, std::move(cancellation))) {}
SpeculativeExecutor::~SpeculativeExecutor() { rest(); }

void SpeculativeExecutor::rest() { crew_->rest(); }

SpeculativeExecutor::Task::Task(std::shared_ptr<Crew> crew, Work work)
    : crew_(std::move(crew)), item_(std::make_shared<Item>()) {
  item_->work = std::move(work);
}

SpeculativeExecutor::Task& SpeculativeExecutor::Task::operator=(Task&& other) noexcept {
  if (this == &other) return *this;
  if (item_) crew_->drop(item_);
  crew_ = std::move(other.crew_);
  item_ = std::move(other.item_);
  return *this;
}

SpeculativeExecutor::Task::~Task() {
  if (item_) crew_->drop(item_);
}

void SpeculativeExecutor::Task::begin(Priority wanted) const { crew_->begin(item_, wanted); }

void SpeculativeExecutor::Task::finish() const { crew_->finish(item_); }

}  // namespace kinegraph
