#include "kinegraph/nlp/validity_report.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace kinegraph {

TEST(LazyVerdict, IsFoundOnceWhenItIsFirstAskedFor) {
  int calls = 0;
  const LazyVerdict verdict([&](const std::function<void()>&) {
    ++calls;
    return MotionVerdict{false, "a meets b"};
  });
  EXPECT_EQ(calls, 0);
  EXPECT_FALSE(verdict.get().free);
  EXPECT_EQ(verdict.get().message, "a meets b");
  EXPECT_EQ(calls, 1);
}

TEST(LazyVerdict, IsSoughtAnewWhereTheFirstWhoAskedGaveUp) {
  const LazyVerdict verdict([](const std::function<void()>& between) {
    between();
    return MotionVerdict{};
  });
  EXPECT_THROW(verdict.get([] { throw std::runtime_error("enough"); }), std::runtime_error);
  EXPECT_TRUE(verdict.get().free);
}

TEST(LazyVerdict, MayBeKnownAlready) { EXPECT_FALSE(LazyVerdict(MotionVerdict{false, "known"}).get().free); }

}  // namespace kinegraph
