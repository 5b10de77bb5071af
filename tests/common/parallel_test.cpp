#include "kinegraph/common/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

using namespace kinegraph;

TEST(ParallelFor, DoesEveryIndexOnceWhateverTheNumberOfThreads) {
  for (int threads : {1, 2, 5}) {
    for (int count : {0, 1, 7, 8, 9, 100}) {
      std::vector<std::atomic<int>> done(std::size_t(count) + 1);
      parallelFor(count, 8, threads, [&](int, int from, int to) {
        EXPECT_LT(from, to);
        EXPECT_LE(to - from, 8);
        for (int i = from; i < to; ++i) ++done[i];
      });
      for (int i = 0; i < count; ++i) EXPECT_EQ(done[i], 1) << i << " of " << count << " on " << threads;
      EXPECT_EQ(done[count], 0);
    }
  }
}

TEST(ParallelFor, NumbersTheWorkersAndTheFirstIsTheCallingThread) {
  const auto caller = std::this_thread::get_id();
  parallelFor(64, 1, 3, [&](int worker, int, int) {
    EXPECT_GE(worker, 0);
    EXPECT_LT(worker, 3);
    EXPECT_EQ(worker == 0, std::this_thread::get_id() == caller);
  });
}

TEST(ParallelFor, PassesOnTheExceptionOfTheFirstPartThatThrows) {
  for (int threads : {1, 4}) {
    try {
      parallelFor(40, 2, threads, [](int, int from, int) {
        if (from >= 10) throw std::runtime_error(std::to_string(from));
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_EQ(std::string(error.what()), "10") << threads << " threads";
    }
  }
}

TEST(ParallelFor, StopsWhereBetweenThrows) {
  int parts = 0, calls = 0;
  EXPECT_THROW(parallelFor(
                   100, 1, 1, [&](int, int, int) { ++parts; },
                   [&] {
                     if (++calls == 4) throw std::runtime_error("stop");
                   }),
               std::runtime_error);
  EXPECT_EQ(parts, 3);
}

TEST(ParallelFor, AsksBetweenWhileItWaitsForTheOthersAndAtTheEnd) {
  for (int threads : {1, 2, 3}) {
    const auto caller = std::this_thread::get_id();
    std::atomic<int> asked = 0;
    // whoever is not the caller waits until the caller, which has nothing left to do, has asked three times more
    parallelFor(
        threads, 1, threads,
        [&](int worker, int, int) {
          for (const int before = asked; worker > 0 && asked < before + 3;)
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        },
        [&] {
          EXPECT_EQ(std::this_thread::get_id(), caller);
          ++asked;
        });
    EXPECT_GE(asked, threads == 1 ? 2 : 3) << threads << " threads";
  }
}

TEST(ParallelFor, WhatBetweenThrowsWhileItWaitsIsPassedOnOnceTheOthersHaveEnded) {
  std::atomic<bool> other_runs = false, other_ended = false, stop = false;
  const auto cancellation = [&] {
    if (!other_runs) return;
    stop = true;
    throw std::runtime_error("stop");
  };
  EXPECT_THROW(parallelFor(
                   2, 1, 2,
                   [&](int worker, int, int) {
                     if (worker == 0) {
                       while (!other_runs) std::this_thread::yield();
                       return;
                     }
                     other_runs = true;
                     while (!stop) std::this_thread::yield();
                     other_ended = true;
                   },
                   cancellation),
               std::runtime_error);
  EXPECT_TRUE(other_ended);
}
