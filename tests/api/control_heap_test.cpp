// The calls that docs/cpp.md lists for control loops request no memory after the first ones.
#include <gtest/gtest.h>

#include "kinegraph/features/make_residual.h"
#include "kinegraph/kinegraph.h"
#include "tests/support/malloc_count.h"

using namespace kinegraph;

namespace {

using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Config heapArm() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("target").setPosition(C.getFrame("l_gripper").getPosition());
  return C;
}

/// Counts the requests of `call`, after some calls that do not count.
template <class Call>
long requestsOf(const Call& call) {
  for (int i = 0; i < 20; ++i) call(i);
  const long before = heap_requests;
  for (int i = 20; i < 120; ++i) call(i);
  return heap_requests - before;
}

}  // namespace

TEST(ControlHeap, KinematicsAndDynamicsRequestNoMemory) {
  Config C = heapArm();
  VectorXd q = C.getJointState(), forces(q.size()), y(3);
  Rows J(3, q.size());
  Residual position = makeResidual(C.state(), FS::position, {"l_gripper"});
  const Frame gripper = C.getFrame("l_gripper");
  const long requests = requestsOf([&](int i) {
    q[0] = 1e-3 * i;
    C.setJointState(q);
    J.setZero();
    eval(C, position, y, J);
    C.inverseDynamics(q, q, forces);
    EXPECT_NEAR((gripper.getPosition() - y).norm(), 0., 1e-12);
  });
  EXPECT_EQ(requests, 0);
  EXPECT_EQ(forces, C.inverseDynamics(q, q));
  VectorXd few(3);
  EXPECT_THROW(C.inverseDynamics(q, q, few), ValueError);
}

TEST(ControlHeap, TrajectoriesRequestNoMemory) {
  const MatrixXd path{{0., 0.}, {1., .2}, {1.2, 1.}};
  const TimedPath timed = retime(path, {VectorXd::Constant(2, 1.), VectorXd::Constant(2, 2.), {}});
  MotionState state;
  EXPECT_EQ(requestsOf([&](int i) { timed.eval(.01 * i, state); }), 0);
  EXPECT_EQ(state.q, timed.eval(1.19).q);
}

TEST(ControlHeap, ModelPredictiveControlRequestsNoMemory) {
  Config C = heapArm();
  Komo komo(C, 1., 20, 2);
  komo.addControlObjective({}, 2, .1);
  komo.addObjective({}, FS::accumulatedCollisions, {}, OT::eq);
  komo.addObjective({}, FS::jointLimits, {}, OT::ineq);
  komo.addObjective({}, FS::positionDiff, {"l_gripper", "target"}, OT::sos, 10.);
  Mpc mpc(komo, {.evaluations = 2});
  const Vector3d center = C.getFrame("target").getPosition();
  const std::string target = "target";
  MatrixXd ahead(20, 3);
  MotionPoint point{C.getJointState(), VectorXd::Zero(7)};
  const long requests = requestsOf([&](int i) {
    for (int s = 0; s < 20; ++s) ahead.row(s) = center + .1 * Vector3d(std::sin(.01 * i + .05 * s), 0., 0.);
    mpc.setPoses(target, ahead);
    mpc.step(point.q, point.velocity, .01);
    mpc.at(.01, point);
  });
  EXPECT_EQ(requests, 0);
  EXPECT_EQ(point.q, mpc.at(.01).q);
  EXPECT_EQ(mpc.horizon().eval(.01).q, point.q);
}

TEST(ControlHeap, SimulationsRequestNoMemory) {
  Config C = heapArm();
  C.addFrame("box").setShape(ST::ssBox, {.06, .06, .06, .005}).setPosition({0., .3, .8}).setMass(1.);
  Simulation simulation(C);
  VectorXd q(7), velocity(7), goal = C.getJointState();
  const long requests = requestsOf([&](int i) {
    goal[0] = 1e-3 * i;
    simulation.step(goal, .01, ControlMode::position);
    simulation.get_q(q);
    simulation.get_qDot(velocity);
  });
  EXPECT_EQ(requests, 0);
  EXPECT_EQ(q, simulation.get_q());
  EXPECT_EQ(velocity, simulation.get_qDot());
  VectorXd few(3);
  EXPECT_THROW(simulation.get_q(few), ValueError);
}

TEST(ControlHeap, DifferentialInverseKinematicsRequestsNoMemory) {
  Config C = heapArm();
  DiffIk ik(C);
  ik.addTask(FS::positionDiff, {"l_gripper", "target"});
  Frame target = C.getFrame("target");
  const Vector3d center = target.getPosition();
  const long requests = requestsOf([&](int i) {
    target.setPosition(center + .1 * Vector3d(std::sin(.01 * i), 0., 0.));
    ik.step(.005);
  });
  EXPECT_EQ(requests, 0);
}
