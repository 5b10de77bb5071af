#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "kinegraph/common/cancellation.h"

namespace kinegraph::inline common_internal {

/// The priority of speculative work. Work of a higher priority is done first.
enum class Priority { high, normal, low };

/// Executes work on a pool of threads before its result is requested.
///
/// The caller defers each piece of work, begins those whose results it will or may need, and gets results in an order
/// of its own. Results therefore do not depend on the number of threads. `get` executes work that was not begun on the
/// calling thread. Work whose result is not requested has no effect.
///
///     SpeculativeExecutor executor(2);
///     Speculative<double> one = executor.defer<double>([](const CancellationToken&) { return slow(1.); });
///     Speculative<double> two = executor.defer<double>([](const CancellationToken&) { return slow(2.); });
///     one.begin(), two.begin();
///     const double sum = one.get() + two.get();
///
/// A thread that waits for work of another thread meanwhile executes work of at least the same priority. Work may get
/// results that it deferred itself. All other calls belong to the calling thread: the one that constructed the executor
/// or called `cancelAll` last.
class SpeculativeExecutor {
 public:
  /// `threads` includes the calling thread. `cancellation` is asked on the calling thread, whenever work on it asks its
  /// own token, and every 20 ms while it waits. If it is cancelled or throws, all work ends, and the call of `get`
  /// throws.
  explicit SpeculativeExecutor(int threads, CancellationToken cancellation = {});
  ~SpeculativeExecutor();  ///< as `cancelAll`
  SpeculativeExecutor(const SpeculativeExecutor&) = delete;
  SpeculativeExecutor& operator=(const SpeculativeExecutor&) = delete;

  /// Cancels running work, empties the queue, and joins the threads; the next `begin` starts them again. Results that
  /// were not requested yet can still be requested.
  void cancelAll();

  template <class T>
  class Speculative;
  /// Creates work without beginning it. The work may ask its token whether its result is still needed.
  template <class T>
  Speculative<T> defer(std::function<T(const CancellationToken&)> work) {
    return Speculative<T>(pool_, std::move(work));
  }

 private:
  using Work = std::function<void(const CancellationToken&)>;
  class WorkerPool;
  struct Item;

  /// Work without its result.
  class Task {
   public:
    Task() = default;
    Task(std::shared_ptr<WorkerPool> pool, Work work);
    Task(Task&&) noexcept = default;
    Task& operator=(Task&& other) noexcept;
    ~Task();

    explicit operator bool() const { return item_ != nullptr; }
    void begin(Priority priority) const;
    void finish() const;

   private:
    std::shared_ptr<WorkerPool> pool_;
    std::shared_ptr<Item> item_;
  };

  std::shared_ptr<WorkerPool> pool_;
};

/// The future result of deferred work. Its destructor cancels the work.
template <class T>
class SpeculativeExecutor::Speculative {
 public:
  Speculative() = default;
  Speculative(std::shared_ptr<WorkerPool> pool, std::function<T(const CancellationToken&)> work)
      : result_(std::make_shared<std::optional<T>>()),
        task_(std::move(pool), [result = result_, work = std::move(work)](const CancellationToken& cancellation) {
          result->emplace(work(cancellation));
        }) {}

  explicit operator bool() const { return bool(task_); }

  /// Queues the work behind other work of the same priority. Another call changes the priority and moves it to the end
  /// of the queue.
  void begin(Priority priority = Priority::high) const { task_.begin(priority); }

  /// Executes the work or waits for it. Throws exceptions of the work.
  T& get() const {
    task_.finish();
    return **result_;
  }

 private:
  std::shared_ptr<std::optional<T>> result_;
  Task task_;
};

template <class T>
using Speculative = SpeculativeExecutor::Speculative<T>;

}  // namespace kinegraph::inline common_internal
