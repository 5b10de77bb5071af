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

TEST(SpeculativeExecutor, ResultsAreThoseOfTheirWorkAtAnyNumberOfThreads) {
  for (const int threads : kThreads) {
    SpeculativeExecutor ahead(threads);
    std::vector<Speculative<int>> squares;
    for (int i = 0; i < 40; ++i) {
      squares.push_back(ahead.later<int>([i](const CancellationToken&) { return i * i; }));
      squares.back().begin(i % 2 == 0 ? Priority::maybe : Priority::surely);
    }
    for (int i = 0; i < 40; ++i) EXPECT_EQ(squares[std::size_t(i)].get(), i * i);
  }
}

TEST(SpeculativeExecutor, WhatIsNotBegunIsDoneWhereItIsGotAndNowhereElse) {
  for (const int threads : kThreads) {
    SpeculativeExecutor ahead(threads);
    std::atomic<int> done = 0;
    const auto count = [&](const CancellationToken&) {
      ++done;
      return std::this_thread::get_id();
    };
    const Speculative<std::thread::id> one = ahead.later<std::thread::id>(count),
                                       other = ahead.later<std::thread::id>(count);
    EXPECT_EQ(one.get(), std::this_thread::get_id());
    EXPECT_EQ(one.get(), std::this_thread::get_id());
    EXPECT_EQ(done, 1);
  }
}

TEST(SpeculativeExecutor, WhatIsWantedMoreIsDoneFirst) {
  SpeculativeExecutor ahead(2);
  std::atomic<bool> go = false, is_busy = false, done = false;
  std::vector<int> order;  // of the one thread beside this one
  const Speculative<int> first = ahead.later<int>([&](const CancellationToken&) {
    is_busy = true;
    waitFor(go);
    return 0;
  });
  first.begin();
  waitFor(is_busy);
  std::vector<Speculative<int>> others;
  for (const Priority wanted : {Priority::maybe, Priority::likely, Priority::surely, Priority::likely}) {
    others.push_back(ahead.later<int>([&, i = int(others.size())](const CancellationToken&) {
      order.push_back(i);
      if (i == 0) done = true;
      return i;
    }));
    others.back().begin(wanted);
  }
  go = true;
  waitFor(done);
  EXPECT_EQ(order, (std::vector<int>{2, 1, 3, 0}));
}

TEST(SpeculativeExecutor, WorkThatIsNotWantedAnyMoreIsTold) {
  SpeculativeExecutor ahead(2);
  std::atomic<bool> begun = false, told = false;
  {
    const Speculative<int> later = ahead.later<int>([&](const CancellationToken& stopped) {
      begun = true;
      while (!stopped()) std::this_thread::yield();
      told = true;
      return 0;
    });
    later.begin();
    waitFor(begun);
  }
  waitFor(told);
}

TEST(SpeculativeExecutor, WorkMayGetResultsThatItMadeItself) {
  for (const int threads : kThreads) {
    SpeculativeExecutor ahead(threads);
    const std::function<int(int)> fibonacci = [&](int n) {
      if (n < 2) return n;
      const Speculative<int> one = ahead.later<int>([&, n](const CancellationToken&) { return fibonacci(n - 1); });
      const Speculative<int> other = ahead.later<int>([&, n](const CancellationToken&) { return fibonacci(n - 2); });
      one.begin(), other.begin();
      return one.get() + other.get();
    };
    EXPECT_EQ(fibonacci(14), 377);
  }
}

TEST(SpeculativeExecutor, AnErrorIsThrownWhereTheResultIsGot) {
  for (const int threads : kThreads) {
    SpeculativeExecutor ahead(threads);
    const Speculative<int> good = ahead.later<int>([](const CancellationToken&) { return 1; });
    const Speculative<int> bad =
        ahead.later<int>([](const CancellationToken&) -> int { throw std::runtime_error("bad"); });
    const Speculative<int> not_got =
        ahead.later<int>([](const CancellationToken&) -> int { throw std::runtime_error("worse"); });
    for (const Speculative<int>* later : {&bad, &good, &not_got}) later->begin();
    EXPECT_EQ(good.get(), 1);
    EXPECT_THROW(bad.get(), std::runtime_error);
  }
}

TEST(SpeculativeExecutor, BetweenEndsAllAndWhatWasNotGotCanBeGotAfterwards) {
  for (const int threads : kThreads) {
    std::atomic<bool> is_pressed = true, may_end = false;
    SpeculativeExecutor ahead(threads, [&] {
      if (is_pressed) throw std::runtime_error("pressed");
    });
    const Speculative<int> later = ahead.later<int>([&](const CancellationToken& stopped) {
      while (!may_end && !stopped()) std::this_thread::yield();
      return may_end ? 7 : 0;
    });
    later.begin();
    EXPECT_THROW(later.get(), std::runtime_error);
    ahead.rest();
    is_pressed = false;
    may_end = true;
    EXPECT_EQ(later.get(), 7);
  }
}

TEST(SpeculativeExecutor, BetweenEndsWorkThatGetsResults) {
  for (const int threads : kThreads) {
    SpeculativeExecutor ahead(threads, [] { throw std::runtime_error("pressed"); });
    const Speculative<int> outer = ahead.later<int>([&](const CancellationToken&) {
      const Speculative<int> inner = ahead.later<int>([](const CancellationToken& stopped) {
        while (!stopped()) std::this_thread::yield();
        return 1;
      });
      inner.begin();
      return inner.get();
    });
    EXPECT_THROW(outer.get(), std::runtime_error);
  }
}

TEST(SpeculativeExecutor, AtRestNobodyWorksAndThereafterTheyGoOn) {
  SpeculativeExecutor ahead(2);
  std::atomic<int> running = 0, runs = 0;
  std::atomic<bool> begun = false;
  const Speculative<int> later = ahead.later<int>([&](const CancellationToken& stopped) {
    ++running;
    begun = true;
    while (runs == 0 && !stopped()) std::this_thread::yield();
    --running;
    return int(++runs);
  });
  later.begin();
  waitFor(begun);
  ahead.rest();
  EXPECT_EQ(running, 0);
  EXPECT_EQ(later.get(), 2);
}

}  // namespace
}  // namespace kinegraph
