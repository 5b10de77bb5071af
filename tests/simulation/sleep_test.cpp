#include <gtest/gtest.h>

#include <cstring>

#include "kinegraph/common/errors.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph {
namespace {

Frame addCube(Config& C, const std::string& name, const Vector3d& position) {
  return C.addFrame(name).setShape(ShapeType::ssBox, {.06, .06, .06, .005}).setPosition(position).setMass(.1);
}

void wait(Simulation& simulation, double seconds) {
  for (int i = 0; i < int(std::round(seconds / .01)); ++i) simulation.step();
}

bool sleeps(const Simulation& simulation) {
  const MatrixXd velocities = simulation.get_frameVelocities();
  return (velocities.array() == 0.).all();
}

/// A table with two stacked cubes and a third one beside them, all asleep, and a pusher on a rail.
struct SleepingCubes : testing::Test {
  SleepingCubes() {
    C.addFrame("table").setShape(ShapeType::box, {2., 2., .1}).setPosition({0., 0., .95});
    C.addText(
        "rail: { X: [-.5 0 1.03] } pusher (rail): { joint: transX, shape: box, size: [.04 .2 .04], mass: 2, "
        "ctrl_limits: [1 100 -1] }");
    addCube(C, "lower", {0., 0., 1.0301});
    addCube(C, "upper", {0., 0., 1.0902});
    addCube(C, "beside", {0., .3, 1.0301});
    simulation = std::make_unique<Simulation>(C);
    wait(*simulation, 1.);
    EXPECT_TRUE(sleeps(*simulation));
    start = simulation->getState();
  }
  Vector3d position(const char* name) const { return C.getFrame(name).getPosition(); }
  void expectBesideUnmoved() const { EXPECT_EQ(simulation->getState().freePos.row(2), start.freePos.row(2)); }

  Config C;
  std::unique_ptr<Simulation> simulation;
  SimulationState start;
};

TEST_F(SleepingCubes, KeepTheirBits) {
  wait(*simulation, 5.);
  EXPECT_EQ(simulation->getState().freePos, start.freePos);
  SimulationOptions options;
  options.sleep = false;
  Config copy = C;
  Simulation awake(copy, SimulationEngine::physx, options);
  awake.restore(start);
  for (int i = 0; i < 500; ++i) awake.advance({}, .01, ControlMode::none);
  EXPECT_FALSE(sleeps(awake));
  EXPECT_TRUE(awake.getState().freePos.isApprox(start.freePos, 1e-6));
}

TEST_F(SleepingCubes, CarryTheirWeight) {
  for (const bool restored : {false, true}) {
    if (restored) simulation->setState(start);
    double on_table = 0., on_lower = 0.;
    for (const Contact& contact : simulation->getContacts()) {
      EXPECT_LT(contact.distance, 0.);
      const double down = std::abs(contact.force.z());
      (contact.frame_a == "table" || contact.frame_b == "table" ? on_table : on_lower) += down;
    }
    EXPECT_NEAR(on_table, .3 * 9.81, 1e-3);
    EXPECT_NEAR(on_lower, .1 * 9.81, 1e-3);
  }
}

TEST_F(SleepingCubes, WakeWhenSomethingFallsOntoThem) {
  addCube(C, "falling", {.05, 0., 2.5}).setMass(3.);
  wait(*simulation, .3);
  const MatrixXd velocities = simulation->get_frameVelocities();
  EXPECT_EQ(velocities.topRows(3).norm(), 0.);
  EXPECT_LT(velocities(3, 2), -2.);
  wait(*simulation, 1.);
  EXPECT_GT((position("upper") - Vector3d(start.freePos.row(1).head<3>())).norm(), 1e-3);
}

TEST_F(SleepingCubes, WakeWhenARobotPushesThem) {
  for (int i = 0; i < 200; ++i) simulation->step(VectorXd::Constant(1, .4), .005, ControlMode::velocity);
  EXPECT_GT(position("lower").x(), -.1 + .02 + .03 - 1e-3);
  expectBesideUnmoved();
}

TEST_F(SleepingCubes, WakeByAForce) {
  simulation->applyForce("lower", {0., 5., 0.});
  wait(*simulation, .1);
  EXPECT_GT(position("lower").y(), .01);
  expectBesideUnmoved();
  simulation->clearForces();
  wait(*simulation, 2.);
  EXPECT_TRUE(sleeps(*simulation));
}

TEST_F(SleepingCubes, WakeByAPerturbation) {
  simulation->perturb("upper", Vector3d::Zero(), {0., 0., 1.5});
  wait(*simulation, .5);
  EXPECT_GT(position("upper").z(), 1.2);
  expectBesideUnmoved();
  simulation->endPerturbation();
  wait(*simulation, 2.);
  EXPECT_TRUE(sleeps(*simulation));
  EXPECT_LT(position("upper").z(), 1.1);
}

TEST_F(SleepingCubes, WakeByAChangedState) {
  SimulationState state = start;
  state.freePos(0, 0) = .6;  // the upper cube has lost its support
  simulation->setState(state);
  wait(*simulation, .5);
  EXPECT_NEAR(position("upper").z(), 1.03, 1e-3);
  state = start;
  state.freeVel(2, 1) = 1.;
  simulation->setState(state);
  wait(*simulation, .1);
  EXPECT_GT(position("beside").y(), .33);
}

TEST_F(SleepingCubes, WakeWhenTheConfigIsPushed) {
  C.getFrame("lower").setPosition({.6, 0., 1.03});
  simulation->pushConfigToSim();
  wait(*simulation, .5);
  EXPECT_NEAR(position("upper").z(), 1.03, 1e-3);
}

TEST_F(SleepingCubes, WakeWhenTheirTableIsMoved) {
  C.getFrame("table").setPosition({0., 0., .45});
  simulation->pushConfigToSim();
  wait(*simulation, 1.);
  EXPECT_NEAR(position("beside").z(), .53, 1e-3);
}

TEST_F(SleepingCubes, WakeWhenTheirSupportIsDeleted) {
  C.delFrame("lower");
  wait(*simulation, .5);
  EXPECT_NEAR(position("upper").z(), 1.03, 1e-3);
}

TEST_F(SleepingCubes, FollowWhatTheyAreAttachedTo) {
  simulation->attach("pusher", "beside");
  for (int i = 0; i < 50; ++i) simulation->step(VectorXd::Constant(1, -.4), .01, ControlMode::velocity);
  EXPECT_NEAR(position("beside").x(), -.2, .02);
  simulation->detach("pusher", "beside");
  wait(*simulation, 1.);
  EXPECT_TRUE(sleeps(*simulation));
}

TEST(Sleep, ASlowBodyInTheAirDoesNotStop) {
  Config C;
  addCube(C, "cube", {0., 0., 1.});
  SimulationOptions options;
  options.gravity = 0.;
  Simulation simulation(C, SimulationEngine::physx, options);
  MatrixXd velocity = MatrixXd::Zero(1, 6);
  velocity(0, 0) = 2e-6;
  simulation.pushConfigToSim(velocity);
  wait(simulation, 1.);
  EXPECT_NEAR(C.getFrame("cube").getPosition().x(), 2e-6, 1e-12);
}

TEST(Sleep, APendulumThatHardlyMovesDoesNotStop) {
  Config C;
  C.addText(
      "hinge: { X: [0 0 2] } rod (hinge): { joint: hingeY, noMotor: true, shape: capsule, size: [.5 .02], mass: 1 }");
  C.addFrame("tip", "rod").setRelativePosition({0., 0., .5}).setShape(ShapeType::sphere, {.05}).setMass(1.);
  C.setJointState(VectorXd::Constant(1, 1e-7));  // almost upright
  Simulation simulation(C);
  wait(simulation, 5.);
  EXPECT_GT(std::abs(C.getJointState()[0]), .1);
}

/// Cubes that fall onto a table and a heap, one after the other, while an arm moves: some sleep, wake and sleep again.
Config falling() {
  Config C;
  C.addFrame("table").setShape(ShapeType::box, {2., 2., .1}).setPosition({0., 0., .95});
  C.addText(
      "rail: { X: [-.6 0 1.03] } pusher (rail): { joint: transX, shape: box, size: [.04 .3 .04], mass: 2, "
      "ctrl_limits: [1 100 -1] }");
  for (int i = 0; i < 6; ++i)
    addCube(C, "cube" + std::to_string(i), {.02 * (i % 2), .25 * (i % 3) - .25, 1.04 + .25 * i});
  return C;
}

VectorXd pushAt(int step) { return VectorXd::Constant(1, step % 200 < 100 ? .45 : -.45); }

TEST(Sleep, StatesContinueWithTheSameBitsAnywhere) {
  Config C = falling(), D = falling();
  Simulation simulation(C);
  std::vector<SimulationState> states;
  int sleeping = 0;
  for (int i = 0; i < 500; ++i) {
    simulation.step(pushAt(i), .01, ControlMode::velocity);
    states.push_back(simulation.getState());
    sleeping += int((states.back().freeVel.rowwise().lpNorm<Eigen::Infinity>().array() == 0.).count());
  }
  EXPECT_GT(sleeping, 300);
  EXPECT_LT(sleeping, 2700);
  Simulation other(D);
  for (std::size_t from = 7; from < states.size(); from += 23) {
    other.setState(states[from]);
    EXPECT_EQ(other.getState(), states[from]);
    for (std::size_t i = from + 1; i < std::min(states.size(), from + 60); ++i) {
      other.step(pushAt(int(i)), .01, ControlMode::velocity);
      ASSERT_EQ(other.getState(), states[i]) << "restored after step " << from << ", differs after " << i;
    }
  }
}

TEST(Sleep, BatchesHaveTheSameBitsForAnyNumberOfThreads) {
  SimulationBatch one(falling(), 6, 1), three(falling(), 6, 3);
  for (int i = 0; i < 250; ++i) {
    MatrixXd u(6, 1);
    for (int e = 0; e < 6; ++e) u(e, 0) = pushAt(i + 30 * e)[0];
    one.step(u, .01, ControlMode::velocity);
    three.step(u, .01, ControlMode::velocity);
  }
  for (int e = 0; e < 6; ++e) EXPECT_EQ(one.getState(e), three.getState(e));
}

TEST(Sleep, LessFrictionLetsABodyOnASlopeSlide) {
  Config C;
  const Quaterniond lean(Eigen::AngleAxisd(.3, Vector3d::UnitY()));
  C.addFrame("slope", "", "shape: box, size: [6 2 .1], friction: .2").setPose(Pose(Vector3d(0., 0., 3.), lean));
  C.addFrame("cube", "", "shape: ssBox, size: [.06 .06 .06 .005], mass: .1, friction: 1")
      .setPose(Pose(Vector3d(0., 0., 3.) + lean * Vector3d(0., 0., .0801), lean));
  SimulationBatch batch(C, 2);
  batch.step({}, .01, ControlMode::none, 100);
  EXPECT_EQ(batch.freeVelocities().norm(), 0.);
  const MatrixXd before = batch.freePoses();
  batch.setFrictions("cube", Eigen::Vector2d(1., 0.));
  batch.step({}, .01, ControlMode::none, 50);
  EXPECT_NEAR(batch.freePoses()(0, 0), before(0, 0), 1e-6);
  EXPECT_GT(batch.freePoses()(1, 0), before(1, 0) + .01);
}

TEST(Sleep, StatesOfEarlierVersionsAreReadAndBrokenOnesRefused) {
  Config C;
  addCube(C, "cube", {0., 0., .0301});
  Simulation simulation(C);
  wait(simulation, 1.);
  SimulationState state = simulation.getState();
  ASSERT_EQ((state.freeVel.array() == 0.).count(), 6);
  std::uint64_t numbers = 0;
  std::memcpy(&numbers, state.remainder.data() + 8, 8);
  const std::size_t sleep = 16 + 8 * numbers;  // the mark, and the physics with their size
  SimulationState broken = state, earlier = state;
  const int far = 7;
  std::memcpy(broken.remainder.data() + sleep + 8, &far, sizeof far);
  EXPECT_THROW(simulation.setState(broken), ValueError);
  earlier.remainder.erase(sleep, 8 + 4);
  earlier.remainder[5] = '2';
  simulation.setState(earlier);
  EXPECT_EQ(simulation.getState().freePos, state.freePos);
  simulation.step();
  EXPECT_NEAR(C.getFrame("cube").getPosition().z(), state.freePos(0, 2), 1e-6);
}

}  // namespace
}  // namespace kinegraph
