#include "kinegraph/common/ordered_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace kinegraph {
namespace {

TEST(OrderedParallelFor, ResultsAreTakenInOrderAndNoMoreJobsRunThanThereAreThreads) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> running = 0, most = 0;
    std::vector<int> results(40), taken;
    orderedParallelFor(
        40, threads,
        [&](int i, const CancellationToken&) {
          const int now = ++running;
          for (int seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
          }
          std::this_thread::sleep_for(std::chrono::microseconds(20 * (40 - i)));  // the first ones take longest
          results[std::size_t(i)] = i * i;
          --running;
        },
        [&](int i) {
          taken.push_back(results[std::size_t(i)]);
          return true;
        });
    ASSERT_EQ(taken.size(), 40u);
    for (int i = 0; i < 40; ++i) EXPECT_EQ(taken[std::size_t(i)], i * i);
    EXPECT_LE(most, threads);
  }
}

TEST(OrderedParallelFor, JobsAreBegunOnlyAsFarAheadAsThereAreThreads) {
  std::atomic<int> begun = 0;
  orderedParallelFor(
      1000, 3, [&](int, const CancellationToken&) { ++begun; }, [](int i) { return i < 4; });
  EXPECT_LE(begun, 5 + 2);
}

TEST(OrderedParallelFor, AJobThatIsNotWantedAnyMoreIsTold) {
  std::atomic<bool> waits = false;
  orderedParallelFor(
      2, 2,
      [&](int i, const CancellationToken& stopped) {
        if (i == 0) {
          while (!waits) std::this_thread::yield();
          return;
        }
        waits = true;
        while (!stopped()) std::this_thread::yield();
      },
      [](int) { return false; });
  EXPECT_TRUE(waits);  // and it has returned
}

TEST(OrderedParallelFor, AnErrorOfAJobIsThrownWhereItsResultWouldBeTaken) {
  for (const int threads : {1, 2, 4}) {
    int taken = 0;
    EXPECT_THROW(orderedParallelFor(
                     3, threads,
                     [](int i, const CancellationToken&) {
                       if (i == 1) throw std::runtime_error("two");
                     },
                     [&](int) { return ++taken > 0; }),
                 std::runtime_error);
    EXPECT_EQ(taken, 1);
  }
}

TEST(OrderedParallelFor, BetweenMayEndItAlsoWhereJobsTakeLong) {
  for (const int threads : {1, 2}) {
    const auto forever = [](int, const CancellationToken& stopped) {
      while (!stopped()) std::this_thread::yield();
    };
    EXPECT_THROW(orderedParallelFor(
                     2, threads, forever, [](int) { return true; }, [] { throw std::runtime_error("pressed"); }),
                 std::runtime_error);
  }
}

TEST(OrderedParallelFor, BetweenMayEndItAlsoWhereJobsTakeNoTime) {
  for (const int threads : {1, 2}) {
    const auto nothing = [](int, const CancellationToken&) {};
    EXPECT_THROW(orderedParallelFor(
                     2, threads, nothing, [](int) { return true; }, [] { throw std::runtime_error("pressed"); }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace kinegraph
