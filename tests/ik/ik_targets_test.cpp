#include "kinegraph/ik/ik_target.h"

#include <gtest/gtest.h>

#include <numbers>

#include "kinegraph/features/eval.h"
#include "kinegraph/ik/solve_ik.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

using std::numbers::pi;

Config twoPandas() {
  Config config;
  config.addFile(KINEGRAPH_SOURCE_DIR "/models/scenarios/pandasTable.g");
  return config;
}

/// Two arms of one link of 1 m each that turn about z, side by side on a turntable, 1 m apart; each weighs 1 kg at its
/// tip.
Config twoHands() {
  Config config;
  config.addText(
      "world {}\n"
      "table (world) { joint: hingeZ }\n"
      "a (table) { joint: hingeZ, pre: [0 0 0] }\n"
      "tip_a (a) { pose: [1 0 0], mass: 1 }\n"
      "b_base (table) { pose: [0 1 0] }\n"
      "b (b_base) { joint: hingeZ }\n"
      "tip_b (b) { pose: [1 0 0], mass: 1 }\n"
      "post (world) { pose: [0 3 0] }\n");
  return config;
}

VectorXd valueOf(Config config, const VectorXd& q, FeatureSymbol symbol, const std::vector<std::string>& frames) {
  config.setJointState(q);
  return eval(config, symbol, frames).y;
}

TEST(IkTarget, AHandMeetsAPlaceThatAnotherHandCarries) {
  Config config = twoPandas();
  const Pose wanted({.05, -.02, -.2}, Quaterniond(Eigen::AngleAxisd(2.8, Vector3d(1., 2., 0.).normalized())));
  const IkResult result = solveIk(config, {IkTarget::toPose("l_gripper", wanted).relativeTo("r_gripper")});
  ASSERT_TRUE(result.feasible()) << result.message;
  const VectorXd before = config.getJointState();
  EXPECT_GT((result.q - before).head(7).norm(), 1e-3);
  EXPECT_GT((result.q - before).tail(7).norm(), 1e-3) << "both arms go towards each other";
  config.setJointState(result.q);
  const Pose there = config.getFrame("l_gripper").getPose(config.getFrame("r_gripper"));
  EXPECT_LT((there.p - wanted.p).norm(), 1.1e-6);
  EXPECT_LT(there.q.angularDistance(wanted.q), 1.1e-6);
}

TEST(IkTarget, ADirectionRelativeToAMovingFrameIsMetInItsCoordinates) {
  const Config config = twoPandas();
  const Vector3d wanted = Vector3d(1., -2., .5).normalized();
  const IkResult result =
      solveIk(config, {IkTarget::toDirection("l_gripper", Vector3d::UnitX(), wanted).relativeTo("r_gripper"),
                       IkTarget::toPosition("r_gripper", {.3, .2, 1.1})});
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_LT((valueOf(config, result.q, FeatureSymbol::vectorXRel, {"l_gripper", "r_gripper"}) - wanted).norm(), 2e-6);
}

TEST(IkTarget, WhatCarriesBothFramesStaysWhereItIs) {
  Config config = twoHands();
  config.setJointState(Vector3d(.7, .1, -.2));
  const IkResult result = solveIk(config, {IkTarget::toPosition("tip_a", {0., .1, 0.}).relativeTo("tip_b")});
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_EQ(result.q[0], .7);
}

TEST(IkTarget, AGazeLooksAtAPointAndNotAwayFromIt) {
  Config config = twoPandas();
  const Vector3d point(.2, .5, .9);
  const IkResult result = solveIk(config, {IkTarget::toGaze("l_gripper", point, -Vector3d::UnitZ())});
  ASSERT_TRUE(result.feasible()) << result.message;
  config.setJointState(result.q);
  const Pose X = config.getFrame("l_gripper").getPose();
  const Vector3d sight = (point - X.p).normalized(), axis = X.q * -Vector3d::UnitZ();
  EXPECT_GT(sight.dot(axis), 0.);
  EXPECT_LT(sight.cross(axis).norm(), 1.1e-6);
}

TEST(IkTarget, AGazeFollowsAFrameThatMoves) {
  Config config = twoPandas();
  const IkResult result = solveIk(
      config, {IkTarget::toGaze("l_gripper", config.getFrame("r_gripper")),
               IkTarget::toPosition("r_gripper", {.4, .1, 1.2}), IkTarget::toPosition("l_gripper", {-.4, .1, 1.})});
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_LT(valueOf(config, result.q, FeatureSymbol::gazeAt, {"r_gripper", "l_gripper"}).norm(), 2e-6);
}

TEST(IkTarget, GazesOfAPlanarArmHaveTheAngleOfTrigonometry) {
  Config config;
  config.addText("world {}\nneck (world) { joint: hingeZ }\neye (neck) { pose: [.5 0 0] }\n");
  const IkResult result = solveIk(config, {IkTarget::toGaze("eye", {1., 1., 0.}, Vector3d::UnitY())});
  ASSERT_TRUE(result.feasible()) << result.message;
  // In the frame of the neck the point is at (.5, y), y > 0, with .5^2 + y^2 = 2.
  EXPECT_NEAR(result.q[0], pi / 4. - std::atan2(std::sqrt(1.75), .5), 2e-6);
}

TEST(IkTarget, TheCenterOfMassGoesWhereItIsAskedTo) {
  const Config config = twoHands();
  const Vector3d wanted(.2, .9, 0.);
  const IkResult result = solveIk(config, {IkTarget::toCenterOfMass(wanted)});
  ASSERT_TRUE(result.feasible()) << result.message;
  Config moved = config;
  moved.setJointState(result.q);
  const Vector3d tips = .5 * (moved.getFrame("tip_a").getPosition() + moved.getFrame("tip_b").getPosition());
  EXPECT_LT((tips - wanted).lpNorm<Eigen::Infinity>(), 1.1e-6);
  const IkResult one = solveIk(config, {IkTarget::toCenterOfMass({0., 1., 0.}, {"tip_a"})});
  ASSERT_TRUE(one.feasible()) << one.message;
  EXPECT_EQ(one.q[2], config.getJointState()[2]) << "the other arm has no part in it";
}

TEST(IkTarget, AnyFeatureHasItsTargetToItsTolerance) {
  const Config config = twoPandas();
  IkFeature upright{FeatureSymbol::scalarProductZZ, {"l_gripper", "world"}, 1e-3};
  const IkResult result =
      solveIk(config, {IkTarget::toPosition("l_gripper", {0., .3, 1.1}), IkTarget::toFeature(upright, Target(.5))});
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_NEAR(valueOf(config, result.q, FeatureSymbol::scalarProductZZ, {"l_gripper", "world"})[0], .5, 1e-3);
  EXPECT_LE(result.feature_error, 1e-3);
}

TEST(IkTarget, ABoundOfAFeatureIsSatisfiedAndInactiveIfItHolds) {
  const Config config = twoPandas();
  IkFeature apart{FeatureSymbol::distance, {"l_palm", "r_palm"}, 1e-6};
  apart.at_most = true;
  const Vector3d meet(0., .2, 1.1);
  const auto solve = [&](double bound) {
    return solveIk(config, {IkTarget::toPosition("l_gripper", meet + Vector3d(-.1, 0., 0.)),
                            IkTarget::toPosition("r_gripper", meet + Vector3d(.1, 0., 0.)),
                            IkTarget::toFeature(apart, Target(bound))});
  };
  const IkResult result = solve(-.25);
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_LE(valueOf(config, result.q, FeatureSymbol::distance, {"l_palm", "r_palm"})[0], -.25 + 1.1e-6);
  const IkResult far = solve(-5.);
  EXPECT_FALSE(far.feasible());
  EXPECT_NE(far.message.find("feature distance of 'l_palm', 'r_palm' misses its bound by"), std::string::npos)
      << far.message;
}

TEST(IkTarget, WhatIsMissedIsNamedWithWhatItIsRelativeTo) {
  const IkResult result = solveIk(twoHands(), {IkTarget::toPosition("tip_a", {9., 0., 0.}).relativeTo("tip_b")});
  EXPECT_EQ(result.status, IkStatus::goal_unreachable);
  EXPECT_NE(result.message.find("frame 'tip_a' misses its position relative to 'tip_b' by"), std::string::npos)
      << result.message;
}

TEST(IkTarget, APoseThatIsTakenFromAFrameThatMovesIsAnErrorThatSaysWhatToDo) {
  Config config = twoPandas();
  config.setJointState(solveIk(config, {IkTarget::toPosition("r_gripper", {.1, .2, 1.1})}).q);
  expectError<ValueError>(
      [&] { solveIk(config, {IkTarget::toPose("l_gripper", config.getFrame("l_palm"))}); },
      {"is the pose of frame 'l_palm'", "moves with joint 'l_panda_joint7'", "relativeTo 'l_palm'"});
  expectError<ValueError>(
      [&] {
        solveIk(config, {IkTarget::toPosition("l_gripper", config.getFrame("r_palm")),
                         IkTarget::toPosition("r_gripper", {0., .3, 1.1})});
      },
      {"is the pose of frame 'r_palm'"});
  // The other arm keeps its joints, because no target moves it: its hand is a fixed pose.
  EXPECT_TRUE(solveIk(config, {IkTarget::toPosition("l_gripper", config.getFrame("r_gripper"))}, {.collisions = false})
                  .feasible());
}

TEST(IkTarget, WhatNoJointChangesIsAnError) {
  const Config config = twoHands();
  expectError<ValueError>(
      [&] {
        solveIk(config, {IkTarget::toPosition("tip_a", {0., 0., 0.}).relativeTo("a")});
      },
      {"no active joint moves frame 'tip_a' relative to 'a'"});
  expectError<ValueError>(
      [&] {
        solveIk(config, {IkTarget::toFeature({FeatureSymbol::position, {"post"}})});
      },
      {"no active joint changes feature position of 'post'"});
  expectError<ValueError>(
      [&] {
        solveIk(config, {IkTarget::toFeature({FeatureSymbol::angularVel, {"tip_a"}})});
      },
      {"angularVel", "expected a feature of one"});
  expectError<ValueError>(
      [&] {
        solveIk(config, {IkTarget::toFeature({FeatureSymbol::position, {"tip_a"}, -1.})});
      },
      {"the tolerance of position is -1"});
}

TEST(IkTarget, BatchesOfRelativeTargetsAreTheSameAtAnyNumberOfThreads) {
  const Config config = twoPandas();
  std::vector<std::vector<IkTarget>> problems;
  Rng rng(3);
  for (int i = 0; i < 24; ++i) {
    const Vector3d p(rng.uniform(-.2, .2), rng.uniform(-.2, .2), rng.uniform(-.3, 0.));
    problems.push_back({IkTarget::toPosition("l_gripper", p).relativeTo("r_gripper"),
                        IkTarget::toFeature({FeatureSymbol::positionDiff, {"r_gripper", "table"}, 1e-4, {0., 0., 1.}},
                                            Target({0., 0., .3 + .01 * i}))});
  }
  const std::vector<IkResult> one = solveIkBatch(config, problems), four = solveIkBatch(config, problems, {}, 4);
  int solved = 0;
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_EQ(one[i].q, four[i].q);
    EXPECT_EQ(one[i].q, solveIk(config, problems[i]).q);
    if (!one[i].feasible()) continue;
    ++solved;
    const VectorXd there = valueOf(config, one[i].q, FeatureSymbol::positionRel, {"l_gripper", "r_gripper"});
    EXPECT_LT((there - problems[i][0].pose.p).norm(), 1.1e-6);
    EXPECT_NEAR(valueOf(config, one[i].q, FeatureSymbol::positionDiff, {"r_gripper", "table"})[2], .3 + .01 * double(i),
                1.1e-4);
  }
  EXPECT_GE(solved, 22);
}

}  // namespace
}  // namespace kinegraph
