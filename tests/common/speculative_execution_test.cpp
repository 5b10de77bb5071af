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

TEST(WorkAhead, ResultsAreThoseOfTheirWorkAtAnyNumberOfThreads) {
  for (const int threads : kThreads) {
    WorkAhead ahead(threads);
    std::vector<Later<int>> squares;
    for (int i = 0; i < 40; ++i) {
      squares.push_back(ahead.later<int>([i](const JobStopped&) { return i * i; }));
      squares.back().begin(i % 2 == 0 ? Wanted::maybe : Wanted::surely);
    }
    for (int i = 0; i < 40; ++i) EXPECT_EQ(squares[std::size_t(i)].get(), i * i);
  }
}

TEST(WorkAhead, WhatIsNotBegunIsDoneWhereItIsGotAndNowhereElse) {
  for (const int threads : kThreads) {
    WorkAhead ahead(threads);
    std::atomic<int> done = 0;
    const auto count = [&](const JobStopped&) {
      ++done;
      return std::this_thread::get_id();
    };
    const Later<std::thread::id> one = ahead.later<std::thread::id>(count), other = ahead.later<std::thread::id>(count);
    EXPECT_EQ(one.get(), std::this_thread::get_id());
    EXPECT_EQ(one.get(), std::this_thread::get_id());
    EXPECT_EQ(done, 1);
  }
}

TEST(WorkAhead, WhatIsWantedMoreIsDoneFirst) {
  WorkAhead ahead(2);
  std::atomic<bool> go = false, is_busy = false, done = false;
  std::vector<int> order;  // of the one thread beside this one
  const Later<int> first = ahead.later<int>([&](const JobStopped&) {
    is_busy = true;
    waitFor(go);
    return 0;
  });
  first.begin();
  waitFor(is_busy);
  std::vector<Later<int>> others;
  for (const Wanted wanted : {Wanted::maybe, Wanted::likely, Wanted::surely, Wanted::likely}) {
    others.push_back(ahead.later<int>([&, i = int(others.size())](const JobStopped&) {
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

TEST(WorkAhead, WorkThatIsNotWantedAnyMoreIsTold) {
  WorkAhead ahead(2);
  std::atomic<bool> begun = false, told = false;
  {
    const Later<int> later = ahead.later<int>([&](const JobStopped& stopped) {
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

TEST(WorkAhead, WorkMayGetResultsThatItMadeItself) {
  for (const int threads : kThreads) {
    WorkAhead ahead(threads);
    const std::function<int(int)> fibonacci = [&](int n) {
      if (n < 2) return n;
      const Later<int> one = ahead.later<int>([&, n](const JobStopped&) { return fibonacci(n - 1); });
      const Later<int> other = ahead.later<int>([&, n](const JobStopped&) { return fibonacci(n - 2); });
      one.begin(), other.begin();
      return one.get() + other.get();
    };
    EXPECT_EQ(fibonacci(14), 377);
  }
}

TEST(WorkAhead, AnErrorIsThrownWhereTheResultIsGot) {
  for (const int threads : kThreads) {
    WorkAhead ahead(threads);
    const Later<int> good = ahead.later<int>([](const JobStopped&) { return 1; });
    const Later<int> bad = ahead.later<int>([](const JobStopped&) -> int { throw std::runtime_error("bad"); });
    const Later<int> not_got = ahead.later<int>([](const JobStopped&) -> int { throw std::runtime_error("worse"); });
    for (const Later<int>* later : {&bad, &good, &not_got}) later->begin();
    EXPECT_EQ(good.get(), 1);
    EXPECT_THROW(bad.get(), std::runtime_error);
  }
}

TEST(WorkAhead, BetweenEndsAllAndWhatWasNotGotCanBeGotAfterwards) {
  for (const int threads : kThreads) {
    std::atomic<bool> is_pressed = true, may_end = false;
    WorkAhead ahead(threads, [&] {
      if (is_pressed) throw std::runtime_error("pressed");
    });
    const Later<int> later = ahead.later<int>([&](const JobStopped& stopped) {
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

TEST(WorkAhead, BetweenEndsWorkThatGetsResults) {
  for (const int threads : kThreads) {
    WorkAhead ahead(threads, [] { throw std::runtime_error("pressed"); });
    const Later<int> outer = ahead.later<int>([&](const JobStopped&) {
      const Later<int> inner = ahead.later<int>([](const JobStopped& stopped) {
        while (!stopped()) std::this_thread::yield();
        return 1;
      });
      inner.begin();
      return inner.get();
    });
    EXPECT_THROW(outer.get(), std::runtime_error);
  }
}

TEST(WorkAhead, AtRestNobodyWorksAndThereafterTheyGoOn) {
  WorkAhead ahead(2);
  std::atomic<int> running = 0, runs = 0;
  std::atomic<bool> begun = false;
  const Later<int> later = ahead.later<int>([&](const JobStopped& stopped) {
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
