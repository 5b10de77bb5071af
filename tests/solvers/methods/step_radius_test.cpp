#include "kinegraph/solvers/methods/step_radius.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(StepRadius, GrowsAfterTwoGoodStepsInARowThatItStopped) {
  StepRadius radius(.5);
  radius.accept(.5, true);
  EXPECT_EQ(radius.value(), .5);
  radius.accept(.5, true);
  EXPECT_EQ(radius.value(), 1.);
}

TEST(StepRadius, StaysWhereStepsAreShortBadOrInterrupted) {
  StepRadius radius(.5);
  for (int round = 0; round < 5; ++round) {
    radius.accept(.5, true);
    radius.accept(round % 2 ? .1 : .5, round % 2 == 1);
  }
  EXPECT_EQ(radius.value(), .5);
  radius.accept(.5, true);
  radius.refuse();
  radius.accept(.5, true);
  EXPECT_EQ(radius.value(), .5);
}

TEST(StepRadius, FallsToItsFirstValueAndNotBelow) {
  StepRadius radius(.5);
  for (int i = 0; i < 3; ++i) radius.growRestoring();
  EXPECT_EQ(radius.value(), 32.);
  for (const double expected : {8., 2., .5, .5}) {
    radius.refuse();
    EXPECT_EQ(radius.value(), expected);
  }
}

TEST(StepRadius, KnowsWhichStepsItHadAPartIn) {
  const StepRadius radius(1.);
  EXPECT_TRUE(radius.isAtEdge(1.));
  EXPECT_FALSE(radius.isAtEdge(.9));
  EXPECT_TRUE(radius.leavesFree(.5));
  EXPECT_FALSE(radius.leavesFree(.51));
}
