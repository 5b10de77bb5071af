#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/ordered_parallel.h"

namespace kinegraph {

/// How much work is wanted that is done ahead; what is wanted more is done first.
enum class Priority { surely, likely, maybe };

/// Threads that do work before it is asked for. Whoever wants results makes a Later of each, begins those that will be
/// wanted, or may be, and gets them in an order of its own, so that what comes out does not depend on the number of threads:
/// what nobody has begun is done on the thread that gets it, and what is not got counts as if it had not been done.
///
///     SpeculativeExecutor ahead(2);
///     Later<double> one = ahead.later<double>([](const CancellationToken&) { return slow(1.); });
///     Later<double> two = ahead.later<double>([](const CancellationToken&) { return slow(2.); });
///     one.begin(), two.begin();
///     const double sum = one.get() + two.get();
///
/// Who waits for what another thread does helps meanwhile with what is wanted as much. Work may get results that it made
/// itself. All else is for the calling thread, which is the one that made this, or has called `rest` last.
class SpeculativeExecutor {
 public:
  /// `threads`: with the calling one. `cancellation`, where given, is asked on the calling thread whenever its work asks whether
  /// it is stopped, and every 20 ms while it waits; it may throw to end all, from the call that gets a result.
  explicit SpeculativeExecutor(int threads, CancellationToken cancellation = {});
  ~SpeculativeExecutor();  ///< as `rest`
  SpeculativeExecutor(const SpeculativeExecutor&) = delete;
  SpeculativeExecutor& operator=(const SpeculativeExecutor&) = delete;

  /// Stops what runs, forgets what was begun, and lets the threads go until something is begun again. What was not got
  /// can be got still.
  void rest();

  template <class T>
  class Speculative;
  template <class T>
  Speculative<T> later(std::function<T(const CancellationToken&)> work) {
    return Speculative<T>(crew_, std::move(work));
  }

 private:
  using Work = std::function<void(const CancellationToken&)>;
  class Crew;
  struct Item;

  /// Work without its result.
  class Task {
   public:
    Task() = default;
    Task(std::shared_ptr<Crew> crew, Work work);
    Task(Task&&) noexcept = default;
    Task& operator=(Task&& other) noexcept;
    ~Task();

    explicit operator bool() const { return item_ != nullptr; }
    void begin(Priority wanted) const;
    void finish() const;

   private:
    std::shared_ptr<Crew> crew_;
    std::shared_ptr<Item> item_;
  };

  std::shared_ptr<Crew> crew_;
};

/// A result that there will be. When this goes, it is not wanted any more: work that runs is told so.
template <class T>
class SpeculativeExecutor::Speculative {
 public:
  Speculative() = default;
  Speculative(std::shared_ptr<Crew> crew, std::function<T(const CancellationToken&)> work)
      : result_(std::make_shared<std::optional<T>>()),
        task_(std::move(crew), [result = result_, work = std::move(work)](const CancellationToken& stopped) {
          result->emplace(work(stopped));
        }) {}

  explicit operator bool() const { return bool(task_); }

  /// May be done from now on. Of results that are wanted alike the one that was begun first is done first. Once more: it is
  /// wanted as much as that says, and as if it were begun then.
  void begin(Priority wanted = Priority::surely) const { task_.begin(wanted); }

  /// Does it, or waits for it. Throws what the work throws.
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

}  // namespace kinegraph
