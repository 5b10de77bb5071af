#include "kinegraph/trajectory_optimization/motion_problems.h"

#include <gtest/gtest.h>

#include <stdexcept>

#include "kinegraph/komo/path/path.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

/// Two links of 1 m reach (1, 1) with the elbow at +pi/2 or -pi/2. The cost prefers -pi/2, and the start is near +pi/2.
std::shared_ptr<Komo> twoAnswers() {
  Config config;
  config.addText(
      "world {}\n"
      "shoulder (world) { joint: hingeZ, limits: [-3 3] }\n"
      "upper (shoulder) { pose: [1 0 0] }\n"
      "elbow (upper) { joint: hingeZ, limits: [-3 3] }\n"
      "tip (elbow) { pose: [1 0 0] }\n");
  config.setJointState(Eigen::Vector2d(.1, 1.5));
  auto komo = std::make_shared<Komo>(config, 1., 1, 0);
  komo->addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, MatrixXd::Constant(1, 1, .1),
                     Eigen::Vector2d(M_PI / 2., -M_PI / 2.));
  komo->addObjective({}, FeatureSymbol::position, {"tip"}, ObjectiveType::eq, MatrixXd::Constant(1, 1, 10.),
                     Vector3d(1., 1., 0.));
  return komo;
}

TEST(SolveFromMany, FindsTheBetterOfTwoAnswersAndLeavesTheKomoThere) {
  const auto komo = twoAnswers();
  const SolveManyResult alone = solveFromMany(komo, {komo->path().variables()});
  EXPECT_TRUE(alone.best().feasible);
  EXPECT_NEAR(alone.best().x[1], M_PI / 2., 1e-3);
  const auto again = twoAnswers();
  const SolveManyResult many = solveFromMany(again, sampleStarts(*again, 12, 0));
  EXPECT_TRUE(many.best().feasible);
  EXPECT_NEAR(many.best().x[0], M_PI / 2., 1e-3);
  EXPECT_NEAR(many.best().x[1], -M_PI / 2., 1e-3);
  EXPECT_LT(many.best().sos, 1e-6);
  EXPECT_EQ(again->path().variables(), many.best().x);
}

TEST(SampleStarts, WhatIsCalledInBetweenMayThrowAndThePathStays) {
  const auto komo = twoAnswers();
  const VectorXd before = komo->path().variables();
  int asked = 0;
  EXPECT_THROW(sampleStarts(*komo, 9, 0,
                            [&] {
                              if (++asked == 4) throw std::runtime_error("stop");
                            }),
               std::runtime_error);
  EXPECT_EQ(komo->path().variables(), before);
  EXPECT_EQ(sampleStarts(*komo, 3, 0).size(), 3u);
  EXPECT_EQ(komo->path().variables(), before);
}

TEST(SolveFromMany, ThreadsDoNotChangeTheAnswer) {
  for (const bool best : {true, false}) {
    std::vector<SolveManyResult> all;
    for (const int threads : {1, 3, 9}) {
      const auto komo = twoAnswers();
      all.push_back(solveFromMany(komo, sampleStarts(*komo, 9, 4), {}, {best, threads}));
    }
    for (int other : {1, 2}) {
      EXPECT_EQ(all[0].chosen, all[other].chosen);
      for (int i = 0; i < 9; ++i) {
        EXPECT_EQ(all[0].results[i].done, all[other].results[i].done);
        EXPECT_EQ(all[0].results[i].x, all[other].results[i].x);
        EXPECT_EQ(all[0].results[i].evals, all[other].results[i].evals);
      }
    }
  }
}

TEST(SolveFromMany, TheFirstFeasibleStartSufficesIfAsked) {
  const auto komo = twoAnswers();
  const SolveManyResult first = solveFromMany(komo, sampleStarts(*komo, 5, 0), {}, {false, 1});
  EXPECT_EQ(first.chosen, 0);
  EXPECT_TRUE(first.results[0].feasible);
  EXPECT_FALSE(first.results[1].done);
}

TEST(SolveFromMany, WithoutAnAnswerTheOneThatViolatesLeastIsChosen) {
  const auto komo = twoAnswers();
  komo->addObjective({}, FeatureSymbol::position, {"tip"}, ObjectiveType::eq, MatrixXd::Constant(1, 1, 10.),
                     Vector3d(-1., 1., 0.));
  const SolveManyResult many = solveFromMany(komo, sampleStarts(*komo, 4, 0));
  EXPECT_FALSE(many.best().feasible);
  for (const SolverResult& result : many.results) EXPECT_GE(result.violation, many.best().violation);
}

TEST(SolveFromMany, SampledStartsBeginWithThePresentPathWhichStays) {
  const auto komo = twoAnswers();
  const VectorXd before = komo->path().variables();
  const std::vector<VectorXd> starts = sampleStarts(*komo, 3, 7);
  EXPECT_EQ(starts[0], before);
  EXPECT_EQ(komo->path().variables(), before);
  EXPECT_NE(starts[1], starts[2]);
  EXPECT_EQ(sampleStarts(*komo, 3, 7)[2], starts[2]);
}

TEST(SolveFromMany, MistakesAreNamed) {
  const auto komo = twoAnswers();
  expectError<ValueError>([&] { solveFromMany(komo, {}); }, {"there are no starts"});
  expectError<ValueError>([&] { solveFromMany(komo, {VectorXd::Zero(3)}); }, {"start 0 has 3 numbers", "has 2"});
  expectError<ValueError>(
      [&] {
        solveFromMany(komo, {komo->path().variables()}, {}, {true, 0});
      },
      {"number of threads is 0"});
  expectError<ValueError>([&] { sampleStarts(*komo, 0, 0); }, {"number of starts is 0"});
}

TEST(SolveFromMany, AProgressCallbackThatThrowsEndsIt) {
  for (const int threads : {1, 2}) {
    const auto komo = twoAnswers();
    const auto starts = sampleStarts(*komo, 2000, 0);
    const auto fail = [](const Progress&) { throw std::runtime_error("enough"); };
    EXPECT_THROW(solveFromMany(komo, starts, {}, {true, threads}, fail), std::runtime_error);
  }
}

}  // namespace
}  // namespace kinegraph
