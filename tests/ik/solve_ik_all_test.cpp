#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinegraph/common/random.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

constexpr double kFullTurn = 2. * std::numbers::pi;

Config loaded(const std::string& file) {
  Config config;
  config.addFile(std::string(KINEGRAPH_SOURCE_DIR "/models/") + file);
  return config;
}

VectorXd randomJoints(const Config& config, Rng& rng) {
  const auto model = config.model();
  VectorXd q(model->dofs);
  for (int i = 0; i < q.size(); ++i) q[i] = rng.uniform(model->lower[i], model->upper[i]);
  return q;
}

double differenceModuloTurns(const VectorXd& a, const VectorXd& b) {
  double largest = 0.;
  for (int i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(std::remainder(a[i] - b[i], kFullTurn)));
  return largest;
}

void expectReached(Config& config, const std::string& frame, const Pose& pose, const std::vector<IkResult>& all) {
  for (const IkResult& result : all) {
    EXPECT_TRUE(result.feasible()) << result.message;
    config.setJointState(result.q);
    const Pose X = config.getFrame(frame).getPose();
    EXPECT_LT((X.p - pose.p).norm(), 1e-6);
    EXPECT_LT(X.q.angularDistance(pose.q), 1e-6);
  }
}

TEST(SolveIkAll, AUr10HasAllSolutionsThatTheGeneralMethodFinds) {
  Config config = loaded("ur10/ur10.g");
  Rng rng(7);
  int most = 0;
  for (int trial = 0; trial < 20; ++trial) {
    config.setJointState(randomJoints(config, rng));
    const VectorXd source = config.getJointState();
    const Pose pose = config.getFrame("ur_ee_fixed_joint").getPose();
    const std::vector<IkTarget> target = {IkTarget::toPose("ur_ee_fixed_joint", pose)};
    config.setJointState(VectorXd::Constant(6, .3));
    IkOptions options;
    options.collisions = false;
    const std::vector<IkResult> all = solveIkAll(config, target, options);
    expectReached(config, "ur_ee_fixed_joint", pose, all);
    config.setJointState(VectorXd::Constant(6, .3));
    most = std::max(most, int(all.size()));
    EXPECT_LE(all.size(), 8u);
    const auto isKnown = [&](const VectorXd& q) {
      return std::ranges::any_of(all, [&](const IkResult& r) { return differenceModuloTurns(r.q, q) < 1e-3; });
    };
    EXPECT_TRUE(isKnown(source));
    for (int seed = 0; seed < 60; ++seed) {  // by the general method, from other starts
      options.seed = std::uint64_t(seed) + 1;
      config.setJointState(randomJoints(config, rng));
      const IkResult other = solveIk(config, target, options);
      if (other.feasible()) EXPECT_TRUE(isKnown(other.q)) << trial << ": " << other.q.transpose();
    }
  }
  EXPECT_EQ(most, 8);
}

TEST(SolveIkAll, SolutionsAreOrderedByTheirDistanceFromThePresentJoints) {
  Config config = loaded("ur10/ur10.g");
  const VectorXd present = config.getJointState();
  const Pose pose = config.getFrame("ur_ee_fixed_joint").getPose();
  IkOptions options;
  options.collisions = false;
  const std::vector<IkResult> all = solveIkAll(config, {IkTarget::toPose("ur_ee_fixed_joint", pose)}, options);
  ASSERT_GE(all.size(), 2u);
  EXPECT_LT((all[0].q - present).norm(), 1e-6);
  for (std::size_t k = 1; k < all.size(); ++k) EXPECT_GE((all[k].q - present).norm(), (all[k - 1].q - present).norm());
  EXPECT_NO_THROW(makeNlp(all[1]));
}

TEST(SolveIkAll, CollisionsExcludeSolutions) {
  Config config = loaded("ur5e/ur5e.g");
  config.addText("wall: { X: [0 .5 .5], shape: box, size: [2 .1 1], contact: 1 }");
  Rng rng(3);
  int fewer = 0;
  for (int trial = 0; trial < 10; ++trial) {
    config.setJointState(randomJoints(config, rng));
    const std::vector<IkTarget> target = {IkTarget::toPose("tool0", config.getFrame("tool0").getPose())};
    IkOptions options;
    const std::vector<IkResult> free = solveIkAll(config, target, options);
    options.collisions = false;
    const std::vector<IkResult> all = solveIkAll(config, target, options);
    std::size_t expected = 0;
    for (const IkResult& result : all) {
      config.setJointState(result.q);
      expected += config.getTotalPenetration() == 0.;
    }
    EXPECT_EQ(free.size(), std::max<std::size_t>(1, expected));  // without any, one says why
    EXPECT_EQ(free[0].feasible(), expected > 0);
    fewer += expected > 0 && expected < all.size();
  }
  EXPECT_GT(fewer, 0);
}

TEST(SolveIkAll, APandaHasSolutionsOfAllBranchesAlongItsSelfMotion) {
  Config config = loaded("scenarios/panda_noGripper.g");
  Rng rng(5);
  IkOptions options;
  options.collisions = false;
  const std::string tool = "panda_joint7";
  double spread = 0.;
  for (int trial = 0; trial < 5; ++trial) {
    config.setJointState(randomJoints(config, rng));
    const Pose pose = config.getFrame(tool).getPose();
    const std::vector<IkResult> all = solveIkAll(config, {IkTarget::toPose(tool, pose)}, options);
    EXPECT_GE(all.size(), 4u);
    expectReached(config, tool, pose, all);
    for (const IkResult& result : all) spread = std::max(spread, differenceModuloTurns(result.q, all[0].q));
  }
  EXPECT_GT(spread, 1.);
}

TEST(SolveIkAll, OtherTargetsAreSolvedFromManyStarts) {
  Config config;
  config.addText(R"(
base: {}
shoulder (base): { joint: hingeZ, limits: [-3 3] }
elbow (shoulder): { joint: hingeZ, pre: [1 0 0], limits: [-3 3] }
tip (elbow): { Q: [1 0 0] }
)");
  const std::vector<IkResult> all = solveIkAll(config, {IkTarget::toPosition("tip", Vector3d(1., 1., 0.))});
  ASSERT_EQ(all.size(), 2u);  // the cosine rule: the elbow is at +- 90 degrees
  for (const IkResult& result : all) EXPECT_NEAR(std::abs(result.q[1]), kFullTurn / 4., 1e-5);
  EXPECT_LT(all[0].q[1] * all[1].q[1], 0.);
}

TEST(SolveIkAll, WithoutASolutionTheOnlyResultSaysWhy) {
  Config config = loaded("ur10/ur10.g");
  Pose far = config.getFrame("ur_ee_fixed_joint").getPose();
  far.p += Vector3d(5., 0., 0.);
  const std::vector<IkResult> all = solveIkAll(config, {IkTarget::toPose("ur_ee_fixed_joint", far)});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].status, IkStatus::goal_unreachable);
  EXPECT_NE(all[0].message.find("ur_ee_fixed_joint"), std::string::npos);
  expectError<FrameNotFound>([&] { solveIkAll(config, {IkTarget::toPose("hand", far)}); }, {"hand"});
}

}  // namespace
}  // namespace kinegraph
