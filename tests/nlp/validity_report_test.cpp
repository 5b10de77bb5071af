#include "kinegraph/nlp/nlp.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace kinegraph {

TEST(LazyValidity, IsFoundOnceWhenItIsFirstAskedFor) {
  int calls = 0;
  const LazyValidity verdict([&](const CancellationToken&) {
    ++calls;
    return ValidityReport{false, "a meets b"};
  });
  EXPECT_EQ(calls, 0);
  EXPECT_FALSE(verdict.get().valid);
  EXPECT_EQ(verdict.get().message, "a meets b");
  EXPECT_EQ(calls, 1);
}

TEST(LazyValidity, IsSoughtAnewWhereTheFirstWhoAskedGaveUp) {
  const LazyValidity verdict([](const CancellationToken& cancellation) {
    cancellation.check();
    return ValidityReport{};
  });
  EXPECT_THROW(verdict.get([] { throw std::runtime_error("enough"); }), std::runtime_error);
  EXPECT_TRUE(verdict.get().valid);
}

TEST(LazyValidity, MayBeKnownAlready) { EXPECT_FALSE(LazyValidity(ValidityReport{false, "known"}).get().valid); }

}  // namespace kinegraph
