#include "kinegraph/viewer/messages/run_requests.h"

#include <gtest/gtest.h>

#include "kinegraph/viewer/messages/commands.h"

using namespace kinegraph;

TEST(RunRequests, PauseLastsAndResetIsReturnedOnce) {
  RunRequests requests;
  EXPECT_TRUE(requests.apply(RunCommand{1}));
  EXPECT_TRUE(requests.apply(RunCommand{4}));
  const RunRequests first = requests.take(), second = requests.take();
  EXPECT_TRUE(first.paused && second.paused);
  EXPECT_TRUE(first.reset);
  EXPECT_FALSE(second.reset);
  EXPECT_TRUE(requests.apply(RunCommand{2}));
  EXPECT_FALSE(requests.take().paused);
}

TEST(RunRequests, EachStepIsTakenOnceAndPauses) {
  RunRequests requests;
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(requests.apply(RunCommand{3}));
  EXPECT_EQ(requests.take().steps, 2);
  EXPECT_EQ(requests.take().steps, 1);
  const RunRequests rest = requests.take();
  EXPECT_EQ(rest.steps, 0);
  EXPECT_TRUE(rest.paused);
}

TEST(RunRequests, APerturbationLastsUntilItEnds) {
  RunRequests requests;
  EXPECT_TRUE(requests.apply(PerturbCommand{7, 3, {.1, .2, .3}, {1., 2., 3.}}));
  ASSERT_TRUE(requests.take().perturbation);
  EXPECT_EQ(*requests.take().perturbation, (RunRequests::Perturbation{7, 3, {.1, .2, .3}, {1., 2., 3.}}));
  EXPECT_TRUE(requests.apply(PerturbCommand{7, -1, {}, {}}));
  EXPECT_FALSE(requests.take().perturbation);
}

TEST(RunRequests, InvalidCommandsChangeNothing) {
  RunRequests requests;
  EXPECT_FALSE(requests.apply(RunCommand{0}));
  EXPECT_FALSE(requests.apply(RunCommand{5}));
  EXPECT_FALSE(requests.apply(PerturbCommand{1, 1, {0., 0.}, {0., 0., 0.}}));
  EXPECT_FALSE(requests.apply(PerturbCommand{1, 1, {0., 0., 0.}, {0., 1e9, 0.}}));
  const RunRequests now = requests.take();
  EXPECT_FALSE(now.paused || now.reset || now.steps > 0 || now.perturbation);
}
