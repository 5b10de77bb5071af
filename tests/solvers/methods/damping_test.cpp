#include "kinegraph/solvers/methods/damping.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"

using namespace kinegraph;

TEST(Damping, GrowsFasterAndFasterWhileStepsAreRefused) {
  Damping damping(1., 1.);
  double last = damping.value(), last_factor = 1.;
  for (int refusal = 0; refusal < 6; ++refusal) {
    damping.refuse(1.);
    const double factor = damping.value() / last;
    EXPECT_EQ(factor, 2. * last_factor);
    last = damping.value();
    last_factor = factor;
  }
  damping.accept(1., false);
  last = damping.value();
  damping.refuse(1.);
  EXPECT_EQ(damping.value(), Damping::kFirstGrowth * last) << "an accepted step ends the series";
}

TEST(Damping, FallsMoreTheBetterAStepWasPredicted) {
  Rng rng(0);
  for (int sample = 0; sample < 100; ++sample) {
    const double first = rng.uniform(.1, 10.), worse = rng.uniform(0., 1.), better = rng.uniform(worse, 1.);
    Damping after_worse(first, first), after_better(first, first);
    after_worse.accept(worse, false);
    after_better.accept(better, false);
    EXPECT_LE(after_better.value(), after_worse.value());
    EXPECT_GE(after_better.value(), Damping::kBestFall * first);
    EXPECT_EQ(worse > .5, after_worse.value() < first) << "a ratio of 1/2 leaves it as it is";
  }
}

TEST(Damping, FallsLittleWhereLessHasJustFailed) {
  Damping wary(1., 1.), refused(1., 1.);
  wary.accept(1., true);
  EXPECT_EQ(wary.value(), Damping::kWaryFall);
  refused.refuse(1.);
  const double before = refused.value();
  refused.accept(1., false);
  EXPECT_EQ(refused.value(), Damping::kWaryFall * before);
}

TEST(Damping, IsSmallAfterEnoughRelaxing) {
  for (const double curvature : {1e-3, 1., 1e4}) {
    Damping damping(1., 1e7);
    int times = 0;
    for (; !damping.isSmall(curvature); ++times) damping.relax(curvature);
    EXPECT_LE(times, 6);
    EXPECT_LE(damping.value(), Damping::kSmall * curvature);
  }
}

TEST(Damping, ReturnsToItsFirstValueWhenItIsLost) {
  Damping damping(.3, .1);
  EXPECT_EQ(damping.value(), .1);
  while (!damping.isLost()) damping.refuse(1.);
  damping.restart();
  EXPECT_EQ(damping.value(), .3);
}

TEST(Damping, MakesUpForCurvatureThatAModelLacks) {
  Rng rng(1);
  for (int sample = 0; sample < 100; ++sample) {
    // f(d) = -g d + a d^2 / 2, and a model that takes the curvature for m
    const double g = rng.uniform(.1, 10.), m = rng.uniform(.1, 10.), a = m * rng.uniform(1., 2.), d = g / m;
    const double ratio = (g * d - .5 * a * d * d) / (g * d - .5 * m * d * d);
    const double lacking = Damping::lacking(ratio, m);
    EXPECT_NEAR(lacking, Damping::kLackingPart * (a - m), 1e-9);
    Damping damping(1., Damping::kMin);
    damping.meet(ratio, lacking);
    EXPECT_EQ(damping.value(), ratio < Damping::kOvershot ? lacking : Damping::kMin);
    if (ratio >= Damping::kOvershot) continue;
    damping.accept(1., false);
    EXPECT_EQ(damping.value(), Damping::kWaryFall * lacking) << "it would overshoot again";
  }
}

TEST(Damping, AfterARefusalIsNoMoreThanTheModelLacks) {
  Damping known(1., Damping::kMin), unknown(1., Damping::kMin);
  known.refuse(1e6, .5);
  unknown.refuse(1e6);
  EXPECT_EQ(known.value(), .5);
  EXPECT_EQ(unknown.value(), Damping::kMinRefusedShare * 1e6);
  known.refuse(1e6, .5);
  EXPECT_EQ(known.value(), 2. * Damping::kFirstGrowth * .5) << "refused again, it grows all the same";
  EXPECT_EQ(Damping::lacking(-1e6, 1.), Damping::kLackingPart * Damping::kMaxLacking) << "as at a non-smooth point";
}
