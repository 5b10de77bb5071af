#include "kinegraph/common/ordered_parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

namespace kinegraph {
namespace {

TEST(InOrder, ResultsAreTakenInOrderAndNoMoreJobsRunThanThereAreThreads) {
  for (const int threads : {1, 2, 4}) {
    std::atomic<int> running = 0, most = 0;
    std::vector<int> results(40), taken;
    inOrder(
        40, threads,
        [&](int i, const JobStopped&) {
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

TEST(InOrder, JobsAreBegunOnlyAsFarAheadAsThereAreThreads) {
  std::atomic<int> begun = 0;
  inOrder(
      1000, 3, [&](int, const JobStopped&) { ++begun; }, [](int i) { return i < 4; });
  EXPECT_LE(begun, 5 + 2);
}

TEST(InOrder, AJobThatIsNotWantedAnyMoreIsTold) {
  std::atomic<bool> waits = false;
  inOrder(
      2, 2,
      [&](int i, const JobStopped& stopped) {
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

TEST(InOrder, AnErrorOfAJobIsThrownWhereItsResultWouldBeTaken) {
  for (const int threads : {1, 2, 4}) {
    int taken = 0;
    EXPECT_THROW(inOrder(
                     3, threads,
                     [](int i, const JobStopped&) {
                       if (i == 1) throw std::runtime_error("two");
                     },
                     [&](int) { return ++taken > 0; }),
                 std::runtime_error);
    EXPECT_EQ(taken, 1);
  }
}

TEST(InOrder, BetweenMayEndItAlsoWhereJobsTakeLong) {
  for (const int threads : {1, 2}) {
    const auto forever = [](int, const JobStopped& stopped) {
      while (!stopped()) std::this_thread::yield();
    };
    EXPECT_THROW(inOrder(
                     2, threads, forever, [](int) { return true; }, [] { throw std::runtime_error("pressed"); }),
                 std::runtime_error);
  }
}

TEST(InOrder, BetweenMayEndItAlsoWhereJobsTakeNoTime) {
  for (const int threads : {1, 2}) {
    const auto nothing = [](int, const JobStopped&) {};
    EXPECT_THROW(inOrder(
                     2, threads, nothing, [](int) { return true; }, [] { throw std::runtime_error("pressed"); }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace kinegraph
