#include "kinegraph/ik/solve_ik.h"

#include <gtest/gtest.h>

#include <atomic>
#include <numbers>
#include <stdexcept>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

Config panda() {
  Config config;
  config.addFile(KINEGRAPH_SOURCE_DIR "/models/scenarios/pandaSingle.g");
  return config;
}

/// Two links of 1 m that rotate about z, with the shoulder at the origin.
Config planarArm(const std::string& limits = {}) {
  Config config;
  config.addText("world {}\nshoulder (world) { joint: hingeZ " + limits +
                 " }\n"
                 "upper (shoulder) { pose: [1 0 0] }\n"
                 "elbow (upper) { joint: hingeZ, q: 0.5 }\n"
                 "tip (elbow) { pose: [1 0 0] }\n");
  return config;
}

std::vector<std::vector<IkTarget>> reachablePoses(Config config, const std::string& frame, int count,
                                                  std::uint64_t seed, bool without_collisions) {
  Rng rng(seed);
  const auto model = config.model();
  std::vector<std::vector<IkTarget>> problems;
  while (int(problems.size()) < count) {
    VectorXd q(model->dofs);
    for (int i = 0; i < q.size(); ++i) q[i] = rng.uniform(model->lower[i], model->upper[i]);
    config.setJointState(q);
    if (without_collisions && config.getTotalPenetration() > 0.) continue;
    problems.push_back({IkTarget::toPose(frame, config.getFrame(frame).getPose())});
  }
  return problems;
}

/// Distance and angle between `q` and the pose of a target.
std::pair<double, double> missOf(Config& config, const VectorXd& q, const IkTarget& target) {
  config.setJointState(q);
  const Pose X = config.getFrame(target.frame).getPose();
  return {(X.p - target.pose.p).norm(), X.q.angularDistance(target.pose.q)};
}

IkOptions withoutCollisions() {
  IkOptions options;
  options.collisions = false;
  return options;
}

TEST(SolveIk, TheElbowAngleOfATwoLinkArmIsThatOfTheCosineRule) {
  const Config arm = planarArm();
  const IkResult result = solveIk(arm, {IkTarget::toPosition("tip", {1., 1., 0.})});
  ASSERT_EQ(result.status, IkStatus::solved) << result.message;
  EXPECT_NEAR(std::abs(result.q[1]), std::numbers::pi / 2., 2e-6);  // |(1, 1)| = sqrt 2
  EXPECT_EQ(result.message, "");
}

TEST(SolveIk, PosesFromRandomJointsOfThePandaAreReachedToTheTolerance) {
  Config config = panda();
  const auto problems = reachablePoses(config, "l_gripper", 1000, 1, false);
  const auto model = config.model();
  int solved = 0;
  const std::vector<IkResult> results = solveIkBatch(config, problems, withoutCollisions());
  for (std::size_t i = 0; i < results.size(); ++i) {
    const IkResult& result = results[i];
    EXPECT_TRUE((result.q.array() >= model->lower.array()).all() && (result.q.array() <= model->upper.array()).all());
    if (!result.feasible()) continue;
    ++solved;
    const auto [distance, angle] = missOf(config, result.q, problems[i][0]);
    EXPECT_LE(distance, 1.001e-6);
    EXPECT_LE(angle, 1.1e-6);
    EXPECT_NEAR(distance, result.position_error, 1e-12);
  }
  EXPECT_GE(solved, 999);
}

TEST(SolveIk, AnswersToPosesWithACollisionFreeConfigurationAreCollisionFree) {
  Config config = panda();
  IkOptions options;
  options.margin = .005;
  int solved = 0;
  const auto problems = reachablePoses(config, "l_gripper", 100, 2, true);
  for (const auto& targets : problems) {
    const IkResult plain = solveIk(config, targets), apart = solveIk(config, targets, options);
    if (plain.feasible()) {
      ++solved;
      EXPECT_LE(missOf(config, plain.q, targets[0]).first, 1.001e-6);
      EXPECT_EQ(config.getTotalPenetration(), 0.);
    }
    if (apart.feasible()) {
      config.setJointState(apart.q);
      EXPECT_TRUE(config.getCollisions(.005 - 1e-9).empty());
    }
  }
  EXPECT_GE(solved, 99);
}

TEST(SolveIk, WithoutAvoidanceCollisionsAreAllowed) {
  const Config config = panda();
  const auto problems = reachablePoses(config, "l_gripper", 20, 3, false);
  IkOptions options = withoutCollisions();
  int colliding = 0;
  for (const auto& targets : problems) {
    const IkResult free = solveIk(config, targets, options);
    Config moved = config;
    moved.setJointState(free.q);
    colliding += moved.getTotalPenetration() > 0.;
    EXPECT_TRUE(free.feasible());
  }
  EXPECT_GT(colliding, 0);
}

TEST(SolveIk, ATargetOutOfReachIsMissedByTheGapThatRemains) {
  const IkResult result = solveIk(planarArm(), {IkTarget::toPosition("tip", {0., 3., 0.})});
  EXPECT_EQ(result.status, IkStatus::goal_unreachable);
  EXPECT_NEAR(result.position_error, 1., 1e-6);
  EXPECT_NE(result.message.find("frame 'tip' misses its position by 1 m"), std::string::npos) << result.message;
}

TEST(SolveIk, ALimitThatBindsIsNamed) {
  const IkResult result = solveIk(planarArm("limits: [-.5 .5]"), {IkTarget::toPosition("tip", {-2., .1, 0.})});
  EXPECT_FALSE(result.feasible());
  EXPECT_NE(result.message.find("joint 'shoulder' is at its"), std::string::npos) << result.message;
  EXPECT_EQ(result.message.find("joint 'elbow'"), std::string::npos) << result.message;
}

TEST(SolveIk, ACollidingPairIsNamed) {
  Config config = planarArm();
  config.addFrame("ball", "tip", "shape: sphere, size: [.1], contact: 1");
  config.addFrame("wall", "", "pose: [1 1 0], shape: sphere, size: [.2], contact: 1");
  const std::vector<IkTarget> targets = {IkTarget::toPosition("tip", {1., 1., 0.})};
  const IkResult result = solveIk(config, targets);
  EXPECT_FALSE(result.feasible());
  EXPECT_NE(result.message.find("reached the targets in collision, most often of 'ball' and 'wall'"), std::string::npos)
      << result.message;
  EXPECT_TRUE(solveIk(config, targets, withoutCollisions()).feasible());
}

TEST(SolveIk, AnswersAreTheSameBitsAtAnyNumberOfThreadsAndAlone) {
  const Config config = panda();
  const auto problems = reachablePoses(config, "l_gripper", 40, 4, true);
  const std::vector<IkResult> one = solveIkBatch(config, problems, {}, 1);
  for (const int threads : {2, 3, 7}) {
    const std::vector<IkResult> many = solveIkBatch(config, problems, {}, threads);
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(many[i].q, one[i].q);
      EXPECT_EQ(many[i].evals, one[i].evals);
    }
  }
  for (std::size_t i = 0; i < problems.size(); i += 10) EXPECT_EQ(solveIk(config, problems[i]).q, one[i].q);
}

TEST(SolveIk, EachProblemOfABatchMayHaveItsOwnStart) {
  Config config = panda();
  const auto model = config.model();
  Rng rng(3);
  std::vector<std::vector<IkTarget>> problems;
  std::vector<VectorXd> starts;
  for (int k = 0; k < 30; ++k) {
    VectorXd q(model->dofs);
    for (int i = 0; i < q.size(); ++i) q[i] = rng.uniform(model->lower[i], model->upper[i]);
    config.setJointState(q);
    problems.push_back({IkTarget::toPose("l_gripper", config.getFrame("l_gripper").getPose())});
    starts.push_back((q.array() + 1e-3).matrix().cwiseMax(model->lower).cwiseMin(model->upper));
  }
  IkOptions options = withoutCollisions();
  options.attempts = 1;
  const std::vector<IkResult> batch = solveIkBatch(config, problems, options, 1, {}, {}, starts);
  const std::vector<IkResult> threads = solveIkBatch(config, problems, options, 3, {}, {}, starts);
  IkOptions best = withoutCollisions();
  best.best = true, best.attempts = 5;
  const std::vector<IkResult> nearest = solveIkBatch(config, problems, best, 1, {}, {}, starts);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    ASSERT_TRUE(batch[i].feasible()) << batch[i].message;
    EXPECT_LT((batch[i].q - starts[i]).cwiseAbs().maxCoeff(), .02);  // the branch of its start
    EXPECT_EQ(threads[i].q, batch[i].q);
    config.setJointState(starts[i]);  // the present q is the start of a single problem
    EXPECT_EQ(solveIk(config, problems[i], options).q, batch[i].q);
    EXPECT_EQ(solveIk(config, problems[i], best).q, nearest[i].q);
  }
  expectError<ValueError>([&] { solveIkBatch(config, problems, options, 1, {}, {}, {starts[0]}); },
                          {"there are 1 starts and 30 problems"});
  starts[4].resize(3);
  expectError<ValueError>([&] { solveIkBatch(config, problems, options, 1, {}, {}, starts); },
                          {"start 4 has 3 entries; expected 7 finite ones"});
}

TEST(SolveIk, TheBestAnswerIsNotFartherFromTheStartThanTheFirst) {
  const Config config = panda();
  IkOptions best;
  best.best = true;
  best.attempts = 30;
  for (const auto& targets : reachablePoses(config, "l_gripper", 10, 5, true)) {
    const IkResult first = solveIk(config, targets), nearest = solveIk(config, targets, best);
    ASSERT_TRUE(nearest.feasible()) << nearest.message;
    EXPECT_LE((nearest.q - config.getJointState()).norm(), (first.q - config.getJointState()).norm() + 1e-6);
    EXPECT_EQ(nearest.attempts, 30);
  }
}

TEST(SolveIk, TheNearestConfigurationIsStationaryInTheRemainingFreedom) {
  Config config = panda();
  IkOptions options = withoutCollisions();
  options.best = true;
  options.attempts = 10;
  const VectorXd start = config.getJointState();
  const IkTarget target =
      IkTarget::toPosition("l_gripper", config.getFrame("l_gripper").getPose().p + Vector3d(.1, .1, -.1));
  const IkResult result = solveIk(config, {target}, options);
  ASSERT_TRUE(result.feasible());
  config.setJointState(result.q);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J = MatrixXd::Zero(3, 7);
  config.state().addPointJacobian(config.getFrame("l_gripper").id(), target.pose.p, 1., J);
  const VectorXd d = result.q - start;
  const VectorXd along = d - J.transpose() * (J * J.transpose()).inverse() * (J * d);  // motion that leaves the gripper
                                                                                       // in place
  EXPECT_LT(along.norm(), 1e-3 * d.norm());
}

TEST(SolveIk, ADirectionIsMetAndTheRotationAboutItIsFree) {
  Config config = panda();
  const Vector3d down(0., 0., -1.);
  const IkResult result = solveIk(config, {IkTarget::toPosition("l_gripper", {.3, .3, 1.1}),
                                           IkTarget::toDirection("l_gripper", Vector3d::UnitZ(), down)});
  ASSERT_TRUE(result.feasible()) << result.message;
  config.setJointState(result.q);
  EXPECT_GT((config.getFrame("l_gripper").getPose().q * Vector3d::UnitZ()).dot(down), 1. - 1e-11);
}

TEST(SolveIk, ARotationAloneIsMet) {
  Config config = panda();
  const Quaterniond wanted(Eigen::AngleAxisd(2., Vector3d(1., 2., 3.).normalized()));
  const IkResult result = solveIk(config, {IkTarget::toRotation("l_gripper", wanted)});
  ASSERT_TRUE(result.feasible()) << result.message;
  config.setJointState(result.q);
  EXPECT_LT(config.getFrame("l_gripper").getPose().q.angularDistance(wanted), 1.1e-6);
}

TEST(SolveIk, JointsThatMoveNoTargetStay) {
  Config config;
  config.addFile(KINEGRAPH_SOURCE_DIR "/models/scenarios/pandasTable.g");
  const VectorXd before = config.getJointState();
  const Pose there = config.getFrame("l_gripper").getPose();
  const IkResult result = solveIk(config, {IkTarget::toPosition("l_gripper", there.p + Vector3d(0., 0., .1))});
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_EQ(config.getJointState(), before);
  const std::vector<std::string> names = config.getJointNames();
  int stayed = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (!names[i].starts_with("r_")) continue;
    EXPECT_EQ(result.q[i], before[i]);
    ++stayed;
  }
  EXPECT_EQ(stayed, 7);
}

TEST(SolveIk, TwoArmsReachTwoTargetsWithoutTouching) {
  Config config;
  config.addFile(KINEGRAPH_SOURCE_DIR "/models/scenarios/pandasTable.g");
  const Vector3d l = config.getFrame("l_gripper").getPose().p, r = config.getFrame("r_gripper").getPose().p;
  const std::vector<IkTarget> targets = {IkTarget::toPosition("l_gripper", .6 * l + .4 * r),
                                         IkTarget::toPosition("r_gripper", .4 * l + .6 * r)};
  const IkResult result = solveIk(config, targets);
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_LE(missOf(config, result.q, targets[0]).first, 1.001e-6);
  EXPECT_LE(missOf(config, result.q, targets[1]).first, 1.001e-6);
  EXPECT_EQ(config.getTotalPenetration(), 0.);
}

TEST(SolveIk, AMobileBaseDrivesToFarTargets) {
  Config config;
  config.addText(
      "world {}\nbase (world) { joint: transXYPhi }\n"
      "post (base) { pose: [.2 0 .5] }\n"
      "shoulder (post) { joint: hingeY, limits: [-2 2] }\n"
      "upper (shoulder) { pose: [0 0 .5] }\n"
      "elbow (upper) { joint: hingeY, limits: [-2 2] }\n"
      "tip (elbow) { pose: [0 0 .5] }\n");
  for (const double far : {1., 30., 1000.}) {
    const IkTarget target = IkTarget::toPosition("tip", {far, -2. * far, 1.2});
    const IkResult result = solveIk(config, {target});
    ASSERT_TRUE(result.feasible()) << far << ": " << result.message;
    EXPECT_LE(missOf(config, result.q, target).first, 1.001e-6);
  }
}

TEST(SolveIk, AFreeBodyGoesToAnyPose) {
  Config config;
  config.addText("world {}\nbody (world) { joint: free }\n");
  const IkTarget target =
      IkTarget::toPose("body", Pose({3., -2., 1.}, Quaterniond(Eigen::AngleAxisd(3., Vector3d::UnitX()))));
  const IkResult result = solveIk(config, {target});
  ASSERT_TRUE(result.feasible()) << result.message;
  EXPECT_NEAR(result.q.tail<4>().norm(), 1., 1e-12);
  EXPECT_LE(missOf(config, result.q, target).second, 1.1e-6);
}

TEST(SolveIk, MistakesAreNamed) {
  const Config config = panda();
  const auto position = [](const char* frame) { return std::vector{IkTarget::toPosition(frame, Vector3d::Zero())}; };
  expectError<FrameNotFound>([&] { solveIk(config, position("l_griper")); }, {"l_griper", "l_gripper"});
  expectError<ValueError>([&] { solveIk(config, position("table")); }, {"no active joint moves frame 'table'"});
  expectError<ValueError>([&] { solveIk(config, {}); }, {"there are no targets"});
  expectError<ValueError>(
      [&] {
        solveIk(config, {IkTarget::toPosition("l_gripper", {0., std::nan(""), 0.})});
      },
      {"l_gripper", "not finite"});
  expectError<ValueError>(
      [&] { solveIk(config, {IkTarget::toDirection("l_gripper", Vector3d::Zero(), Vector3d::UnitX())}); },
      {"axis is zero"});
  expectError<ValueError>(
      [&] {
        solveIkBatch(config, {position("l_gripper"), position("l_palm")});
      },
      {"problem 1", "must have the frames and kinds"});
  expectError<ValueError>([&] { solveIkBatch(config, {position("l_gripper")}, {}, 0); }, {"threads is 0"});
  IkOptions options;
  options.position_tolerance = 0.;
  expectError<ValueError>([&] { solveIk(config, position("l_gripper"), options); },
                          {"position_tolerance is 0", "positive"});
}

TEST(SolveIk, AWatchEndsTheSearchAndMayThrow) {
  const Config config = panda();
  // takes seconds
  std::vector<std::vector<IkTarget>> problems(5000, {IkTarget::toPosition("l_gripper", {5., 0., 0.})});
  for (const int threads : {1, 2}) {
    int calls = 0;
    const std::vector<IkResult> results = solveIkBatch(config, problems, {}, threads, {}, [&] { return ++calls > 0; });
    EXPECT_EQ(results.back().status, IkStatus::cancelled);
    EXPECT_EQ(results.back().q.size(), 7);
    EXPECT_THROW(solveIkBatch(config, problems, {}, threads, [](const Progress&) { throw std::runtime_error("stop"); }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace kinegraph
