#include "kinegraph/common/speculative_execution.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace kinegraph {
namespace {

constexpr int kThreads[] = {1, 2, 8};

/// Waits until other threads have made it true.
void waitFor(const std::atomic<bool>& done) {
  while (!done) std::this_thread::yield();
}

TEST(SpeculativeExecutor, ResultsDoNotDependOnTheNumberOfThreads) {
  for (const int threads : kThreads) {
    SpeculativeExecutor executor(threads);
    std::vector<Speculative<int>> squares;
    for (int i = 0; i < 40; ++i) {
      squares.push_back(executor.defer<int>([i](const CancellationToken&) { return i * i; }));
      squares.back().begin(i % 2 == 0 ? Priority::low : Priority::high);
    }
    for (int i = 0; i < 40; ++i) EXPECT_EQ(squares[std::size_t(i)].get(), i * i);
  }
}

TEST(SpeculativeExecutor, WorkThatWasNotBegunRunsInGetOnly) {
  for (const int threads : kThreads) {
    SpeculativeExecutor executor(threads);
    std::atomic<int> done = 0;
    const auto count = [&](const CancellationToken&) {
      ++done;
      return std::this_thread::get_id();
    };
    const Speculative<std::thread::id> one = executor.defer<std::thread::id>(count),
                                       other = executor.defer<std::thread::id>(count);
    EXPECT_EQ(one.get(), std::this_thread::get_id());
    EXPECT_EQ(one.get(), std::this_thread::get_id());
    EXPECT_EQ(done, 1);
  }
}

TEST(SpeculativeExecutor, WorkOfHigherPriorityRunsFirst) {
  SpeculativeExecutor executor(2);
  std::atomic<bool> go = false, is_busy = false, done = false;
  std::vector<int> order;  // of the one thread beside this one
  const Speculative<int> first = executor.defer<int>([&](const CancellationToken&) {
    is_busy = true;
    waitFor(go);
    return 0;
  });
  first.begin();
  waitFor(is_busy);
  std::vector<Speculative<int>> others;
  for (const Priority priority : {Priority::low, Priority::normal, Priority::high, Priority::normal}) {
    others.push_back(executor.defer<int>([&, i = int(others.size())](const CancellationToken&) {
      order.push_back(i);
      if (i == 0) done = true;
      return i;
    }));
    others.back().begin(priority);
  }
  go = true;
  waitFor(done);
  EXPECT_EQ(order, (std::vector<int>{2, 1, 3, 0}));
}

TEST(SpeculativeExecutor, DroppedWorkIsCancelled) {
  SpeculativeExecutor executor(2);
  std::atomic<bool> begun = false, told = false;
  {
    const Speculative<int> result = executor.defer<int>([&](const CancellationToken& stopped) {
      begun = true;
      while (!stopped()) std::this_thread::yield();
      told = true;
      return 0;
    });
    result.begin();
    waitFor(begun);
  }
  waitFor(told);
}

TEST(SpeculativeExecutor, WorkMayGetResultsThatItDeferred) {
  for (const int threads : kThreads) {
    SpeculativeExecutor executor(threads);
    const std::function<int(int)> fibonacci = [&](int n) {
      if (n < 2) return n;
      const Speculative<int> one = executor.defer<int>([&, n](const CancellationToken&) { return fibonacci(n - 1); });
      const Speculative<int> other = executor.defer<int>([&, n](const CancellationToken&) { return fibonacci(n - 2); });
      one.begin(), other.begin();
      return one.get() + other.get();
    };
    EXPECT_EQ(fibonacci(14), 377);
  }
}

TEST(SpeculativeExecutor, AnErrorIsThrownByGet) {
  for (const int threads : kThreads) {
    SpeculativeExecutor executor(threads);
    const Speculative<int> good = executor.defer<int>([](const CancellationToken&) { return 1; });
    const Speculative<int> bad =
        executor.defer<int>([](const CancellationToken&) -> int { throw std::runtime_error("bad"); });
    const Speculative<int> not_requested =
        executor.defer<int>([](const CancellationToken&) -> int { throw std::runtime_error("worse"); });
    for (const Speculative<int>* result : {&bad, &good, &not_requested}) result->begin();
    EXPECT_EQ(good.get(), 1);
    EXPECT_THROW(bad.get(), std::runtime_error);
  }
}

TEST(SpeculativeExecutor, CancellationEndsAllAndResultsCanBeRequestedAfterwards) {
  for (const int threads : kThreads) {
    std::atomic<bool> is_pressed = true, may_end = false;
    SpeculativeExecutor executor(threads, [&] {
      if (is_pressed) throw std::runtime_error("pressed");
    });
    const Speculative<int> result = executor.defer<int>([&](const CancellationToken& stopped) {
      while (!may_end && !stopped()) std::this_thread::yield();
      return may_end ? 7 : 0;
    });
    result.begin();
    EXPECT_THROW(result.get(), std::runtime_error);
    executor.cancelAll();
    is_pressed = false;
    may_end = true;
    EXPECT_EQ(result.get(), 7);
  }
}

TEST(SpeculativeExecutor, CancellationEndsWorkThatGetsResults) {
  for (const int threads : kThreads) {
    SpeculativeExecutor executor(threads, [] { throw std::runtime_error("pressed"); });
    const Speculative<int> outer = executor.defer<int>([&](const CancellationToken&) {
      const Speculative<int> inner = executor.defer<int>([](const CancellationToken& stopped) {
        while (!stopped()) std::this_thread::yield();
        return 1;
      });
      inner.begin();
      return inner.get();
    });
    EXPECT_THROW(outer.get(), std::runtime_error);
  }
}

TEST(SpeculativeExecutor, CancelAllEndsWorkThatCanBeginAgain) {
  SpeculativeExecutor executor(2);
  std::atomic<int> running = 0, runs = 0;
  std::atomic<bool> begun = false;
  const Speculative<int> result = executor.defer<int>([&](const CancellationToken& stopped) {
    ++running;
    begun = true;
    while (runs == 0 && !stopped()) std::this_thread::yield();
    --running;
    return int(++runs);
  });
  result.begin();
  waitFor(begun);
  executor.cancelAll();
  EXPECT_EQ(running, 0);
  EXPECT_EQ(result.get(), 2);
}

}  // namespace
}  // namespace kinegraph
