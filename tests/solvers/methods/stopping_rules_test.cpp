#include "kinegraph/solvers/methods/stopping_rules.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(InnerTest, AsksForSmallerStepsFromRoundToRound) {
  constexpr double kLeast = 1e-4;
  InnerTest test(false);
  double smallest = InnerTest::kFirstStep;
  for (int round = 0; round < 10; ++round) {
    EXPECT_TRUE(test.isSolved(smallest, false));
    EXPECT_FALSE(test.isSolved(1.01 * smallest, false));
    EXPECT_FALSE(test.isSolved(smallest, true)) << "a damped step says nothing";
    test.tighten(kLeast, false);
    smallest = std::max(InnerTest::kStepFall * smallest, kLeast);
  }
  EXPECT_EQ(smallest, kLeast);
}

TEST(InnerTest, AsksForLessFromRoundToRoundWhereThereAreManyVariables) {
  InnerTest test(true);
  test.tighten(1e-4, false);
  EXPECT_TRUE(test.isSolved(InnerTest::kStepFallOfMany * InnerTest::kFirstStep, false));
  EXPECT_FALSE(test.isSolved(1.01 * InnerTest::kStepFallOfMany * InnerTest::kFirstStep, false));
}

TEST(InnerTest, TakesALagrangianThatHardlyFallsAsSolved) {
  InnerTest test(false);
  test.addStep(10., 10. * (1. - 1.01 * InnerTest::kFirstDecrease));
  EXPECT_FALSE(test.isSolved(1., false));
  test.addStep(10., 10. * (1. - .99 * InnerTest::kFirstDecrease));
  EXPECT_TRUE(test.isSolved(1., true));
  test.tighten(1e-4, false);
  EXPECT_TRUE(test.isSolved(1., true)) << "where constraints do not hold, it stays rough";
  test.tighten(1e-4, true);
  EXPECT_FALSE(test.isSolved(1., true));
  test.addStep(10., 10.);
  test.beginRound();
  EXPECT_FALSE(test.isSolved(1., true)) << "a new round has its own steps";
}

TEST(StagnationTest, NeedsRefusedStepsAndCostsThatHardlyFall) {
  SolverOptions options;
  options.stopTolerance = 1e-2;
  options.stopFTolerance = 1e-3;
  const auto stagnatesAfter = [&](double cost, int refused, bool holds) {
    StagnationTest test(options);
    EXPECT_FALSE(test.stagnates(StagnationTest::kWindow, 1., holds)) << "the first window has nothing to compare with";
    for (int i = 0; i < refused; ++i) test.addRefusal();
    return test.stagnates(2 * StagnationTest::kWindow, cost, holds);
  };
  const double least = StagnationTest::kWindow * options.stopFTolerance;  // the lesser of both tolerances
  EXPECT_TRUE(stagnatesAfter(1. - .9 * least, StagnationTest::kRefused, true));
  EXPECT_FALSE(stagnatesAfter(1. - 1.1 * least, StagnationTest::kRefused, true));
  EXPECT_FALSE(stagnatesAfter(1., StagnationTest::kRefused - 1, true));
  EXPECT_FALSE(stagnatesAfter(1., StagnationTest::kRefused, false));
}

TEST(RemainderTest, AddsUpDecreasesThatFallByAConstantFactor) {
  SolverOptions options;
  options.stopTolerance = 1e-2;
  options.stopFTolerance = 1e-3;
  constexpr double kCost = 5.;
  const double most = RemainderTest::kShare * options.stopFTolerance * kCost;  // the lesser of both tolerances
  const auto isSmall = [&](double before, double now) {
    RemainderTest test(options);
    EXPECT_FALSE(test.isSmall(now, kCost)) << "the first step has nothing to compare with";
    test.addStep(before);
    return test.isSmall(now, kCost);
  };
  EXPECT_TRUE(isSmall(.98 * most, .49 * most));
  EXPECT_FALSE(isSmall(1.02 * most, .51 * most));
  EXPECT_FALSE(isSmall(.101 * most, .1 * most)) << "hardly falls, so that many steps follow";
  EXPECT_FALSE(isSmall(0., 0.));
  options.stopFTolerance = 0.;
  EXPECT_FALSE(isSmall(1e-3 * most, 1e-4 * most)) << "zero switches the test off";
}

TEST(ViolationTest, IsStuckAfterTwoBadRoundsUnderALargePenalty) {
  ViolationTest test;
  test.addRound(1.);
  EXPECT_FALSE(test.isStuck(.9, true));
  EXPECT_TRUE(test.isStuck(.9, true));
  EXPECT_FALSE(test.isStuck(.5, true)) << "a good round ends the series";
  EXPECT_FALSE(test.isStuck(.9, true));
  EXPECT_FALSE(test.isStuck(.9, false)) << "so does a small penalty";
  EXPECT_TRUE(test.fellEnough(.25));
  EXPECT_FALSE(test.fellEnough(.26));
}

TEST(ViolationTest, IsHopelessWithoutProgressOnly) {
  ViolationTest test;
  double violation = 1.;
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(test.isHopeless(violation *= .4, 1.)) << "the violation falls";
  double cost = 1.;
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(test.isHopeless(violation, cost *= .99)) << "the costs fall";
  int times = 1;
  while (!test.isHopeless(violation, cost)) ++times;
  EXPECT_EQ(times, ViolationTest::kMaxFailures - 1);
}

TEST(CorrectionTest, PausesLongerAndLongerWhereCorrectionsFail) {
  CorrectionTest test;
  const auto pause = [&] {
    int steps = 0;
    while (!test.isDue()) ++steps;
    return steps;
  };
  for (const int expected : {0, 8, 16, 32, 32}) {
    test.addCorrection(false);
    EXPECT_EQ(pause(), expected);
  }
  test.addCorrection(true);
  EXPECT_EQ(pause(), 0);
}
