#include "kinegraph/ik/ik_lanes.h"

#include <gtest/gtest.h>

#include <vector>

#include "kinegraph/math/lane_widths.h"

namespace kinegraph {
namespace {

/// All kinds of joints that lanes support, two branches, and a mimicking joint.
Config treeOfJoints() {
  Config config;
  config.addText(
      "world {}\n"
      "base (world) { joint: transXYPhi }\n"
      "post (base) { pose: [.2 .1 .5], joint: hinge, axis: [1 2 3] }\n"
      "a0 (post) { pose: [.1 0 .3 .8 .6 0 0] }\n"
      "a (a0) { joint: hingeX, limits: [-2 2] }\n"
      "b0 (a) { pose: [0 .2 .1] }\n"
      "b (b0) { joint: universal }\n"
      "slide (b) { joint: transZ, limits: [-.5 .5] }\n"
      "left (slide) { pose: [.1 .2 .3 .5 .5 .5 .5] }\n"
      "c0 (post) { pose: [0 -.3 .2] }\n"
      "c (c0) { joint: hingeY, limits: [-1 1] }\n"
      "d0 (c) { pose: [0 0 .3] }\n"
      "d (d0) { joint: hingeZ, mimic: c }\n"
      "right (d) { pose: [.4 0 0] }\n");
  return config;
}

std::vector<IkTarget> targetsOf(const Config& config) {
  const Pose left = config.getFrame("left").getPose();
  return {IkTarget::toPose("left", Pose(left.p + Vector3d(.1, .2, -.1),
                                        left.q * Quaterniond(Eigen::AngleAxisd(1., Vector3d(1., 2., 2.) / 3.)))),
          IkTarget::toPosition("right", {1., .2, .3}), IkTarget::toDirection("right", Vector3d::UnitX(), {0., 1., 1.})};
}

/// Output of a kernel at random joints: one vector of each kind per lane.
struct LaneRun {
  VectorXd x, next, error, jacobian;
  double square, distance, angle;
};

std::vector<LaneRun> runKernel(const IkProblem& problem, const std::vector<IkTarget>& targets, const IkKernel& kernel,
                               int count) {
  const IkLaneModel owner(problem);
  const IkKernelModel model = owner.view();
  EXPECT_TRUE(owner.supported());
  IkJob job;
  const auto shared = std::make_shared<const IkProblem>(problem);
  IkSearch(shared).open(job, targets);
  std::vector<LaneRun> runs;
  Rng rng(5);
  while (int(runs.size()) < count) {
    LaneBuffer buffer(model, kernel.lanes);
    const IkKernelMemory& memory = buffer.memory;
    for (int lane = 0; lane < kernel.lanes; ++lane) {
      for (int v = 0; v < model.variables(); ++v)
        memory.x[v * kernel.lanes + lane] = rng.uniform(std::max(model.lower[v], -3.), std::min(model.upper[v], 3.));
      for (int t = 0; t < model.tasks; ++t) {
        double* goal = memory.goal + t * IkKernelMemory::kPerGoal * kernel.lanes + lane;
        for (int k = 0; k < 9; ++k) goal[k * kernel.lanes] = job.goals[t].R.data()[k];
        for (int k = 0; k < 3; ++k) {
          goal[(9 + k) * kernel.lanes] = job.goals[t].p[k];
          goal[(12 + k) * kernel.lanes] = job.goals[t].t1[k];
          goal[(15 + k) * kernel.lanes] = job.goals[t].t2[k];
        }
      }
    }
    kernel.run(model, memory);
    for (int lane = 0; lane < kernel.lanes; ++lane) {
      const auto column = [&](const double* rows, int size) {
        return VectorXd(
            Eigen::Map<const VectorXd, 0, Eigen::InnerStride<>>(rows + lane, size, Eigen::InnerStride<>(kernel.lanes)));
      };
      const int n = model.variables();
      runs.push_back({column(memory.x, n), column(memory.next, n), column(memory.error, model.rows),
                      column(memory.jacobian, n * model.rows), memory.square[lane], memory.distance[lane],
                      memory.angle[lane]});
    }
  }
  runs.resize(count);
  return runs;
}

TEST(IkLanes, RowsAndJacobianAreThoseOfTheState) {
  const Config config = treeOfJoints();
  const std::vector<IkTarget> targets = targetsOf(config);
  const IkProblem problem(config, targets, {});
  State state(problem.model, problem.parameters);
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const int n = config.getJointDimension();
  ASSERT_EQ(problem.variables(), n);
  const int left = config.getFrame("left").id(), right = config.getFrame("right").id();
  for (const LaneRun& run : runKernel(problem, targets, ikKernel(2), 50)) {
    state.setJoints(run.x.data());
    const RigidTransform X_left = state.pose(left), X_right = state.pose(right);
    Rows J = Rows::Zero(9, n), W = Rows::Zero(3, n);
    state.addPointJacobian(left, X_left.p, 1., J.topRows(3));
    state.addAngularJacobian(left, 1., J.middleRows(3, 3));
    state.addPointJacobian(right, X_right.p, 1., J.bottomRows(3));
    const MatrixXd made = Eigen::Map<const MatrixXd>(run.jacobian.data(), problem.rows, n);
    EXPECT_LT((made.topRows(9) - J).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LT((run.error.head(3) - (targets[0].pose.p - X_left.p)).norm(), 1e-12);
    EXPECT_LT((run.error.segment(6, 3) - (targets[1].pose.p - X_right.p)).norm(), 1e-12);
    const Eigen::AngleAxisd turn(Matrix3d(targets[0].pose.q.toRotationMatrix() * X_left.R.transpose()));
    EXPECT_LT((run.error.segment(3, 3) - turn.angle() * turn.axis()).norm(),
              1e-6);  // its angle is accurate to 2e-8, times pi near half rotations
    const Vector3d wanted = targets[2].direction.normalized(), is = X_right.R.col(0);
    EXPECT_NEAR(run.error.tail(2).norm(), std::acos(is.dot(wanted)), 1e-6);
    EXPECT_NEAR(run.angle, std::max(turn.angle(), std::acos(is.dot(wanted))), 1e-6);
    EXPECT_NEAR(run.square, run.error.squaredNorm(), 1e-6);
  }
}

TEST(IkLanes, AllInstructionSetsGiveTheSameBits) {
  const Config config = treeOfJoints();
  const std::vector<IkTarget> targets = targetsOf(config);
  const IkProblem problem(config, targets, {});
  const std::vector<LaneRun> one = runKernel(problem, targets, ikKernel(2), 48);
  for (int width : laneWidths()) {
    const std::vector<LaneRun> wide = runKernel(problem, targets, ikKernel(width), 48);
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].x, wide[i].x);
      EXPECT_EQ(one[i].next, wide[i].next);
      EXPECT_EQ(one[i].error, wide[i].error);
      EXPECT_EQ(one[i].jacobian, wide[i].jacobian);
    }
  }
}

TEST(IkLanes, HalfRotationsAreAboutTheRightAxis) {
  Config config;
  config.addText("world {}\nx (world) { joint: hingeX }\ny (x) { joint: hingeY }\nz (y) { joint: hingeZ }\n");
  config.setJointState(Vector3d(.3, .2, .1));
  for (const Vector3d& axis :
       {Vector3d(1., 0., 0.), Vector3d(0., 1., 0.), Vector3d(0., 0., 1.), Vector3d(1., 2., -2.)}) {
    const Pose start = config.getFrame("z").getPose();
    const IkResult result =
        solveIk(config, {IkTarget::toRotation("z", Quaterniond(Eigen::AngleAxisd(M_PI, axis.normalized())) * start.q)});
    EXPECT_TRUE(result.feasible());
    EXPECT_EQ(result.attempts, 1);
  }
  const Vector3d now = config.getFrame("z").getPose().q * Vector3d::UnitX();
  const IkResult opposite = solveIk(config, {IkTarget::toDirection("z", Vector3d::UnitX(), -now)});
  EXPECT_TRUE(opposite.feasible());
  EXPECT_EQ(opposite.attempts, 1);
}

TEST(IkLanes, JointsWithQuaternionsAreLeftToTheSearchWithoutLanes) {
  Config config;
  config.addText("world {}\nball (world) { joint: quatBall }\ntip (ball) { pose: [0 0 1] }\n");
  const std::vector<IkTarget> targets = {IkTarget::toPosition("tip", {0., .6, .8})};
  EXPECT_FALSE(IkLaneModel(IkProblem(config, targets, {})).supported());
  EXPECT_TRUE(solveIk(config, targets).feasible());
}

TEST(IkLanes, TheSearchWithoutLanesSolvesAsWell) {
  Config config = treeOfJoints(), posed = config;
  Rng rng(1);
  posed.setRandom(rng);
  const Pose left = posed.getFrame("left").getPose(), right = posed.getFrame("right").getPose();
  const std::vector<IkTarget> targets = {
      IkTarget::toPose("left", left), IkTarget::toDirection("right", Vector3d::UnitX(), right.q * Vector3d::UnitX())};
  const auto problem = std::make_shared<const IkProblem>(config, targets, IkOptions());
  const IkResult alone = IkSearch(problem).solve(targets, [] { return false; }), in_lanes = solveIk(config, targets);
  EXPECT_TRUE(alone.feasible()) << alone.message;
  EXPECT_TRUE(in_lanes.feasible()) << in_lanes.message;
}

}  // namespace
}  // namespace kinegraph
