#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/kinematics/dynamics.h"
#include "kinegraph/simulation/simulation.h"

namespace kinegraph {
namespace {

constexpr double kG = 9.81;

Frame addBall(Config& C, double radius, const Vector3d& position, double mass = 1.) {
  Frame ball = C.addFrame("ball");
  ball.setShape(ShapeType::sphere, {radius}).setPosition(position);
  ball.setMass(mass, {.4 * mass * radius * radius, .4 * mass * radius * radius, .4 * mass * radius * radius});
  return ball;
}

Frame addBox(Config& C, const std::string& name, const Vector3d& position, double mass = .1) {
  return C.addFrame(name).setShape(ShapeType::ssBox, {.06, .06, .06, .005}).setPosition(position).setMass(mass);
}

void run(Simulation& simulation, double seconds, double tau = .01) {
  for (int i = 0; i < int(std::round(seconds / tau)); ++i) simulation.step({}, tau);
}

/// A plate that is inclined by `angle` about y, and the unit vector down its slope.
Vector3d addSlope(Config& C, double angle, double friction) {
  C.addFrame("slope", "", "shape: box, size: [6 2 .1], friction: " + std::to_string(friction))
      .setPose(Pose(Vector3d(0., 0., 3.), Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()))));
  return {std::cos(angle), 0., -std::sin(angle)};
}

TEST(SimulationLaws, FreeFallIsThatOfTheInnerSteps) {
  Config C;
  addBall(C, .05, {0., 0., 5.});
  SimulationOptions options;
  Simulation simulation(C, SimulationEngine::physx, options);
  run(simulation, .5);
  const double h = options.inner_step, n = .5 / h;
  EXPECT_NEAR(C.getFrame("ball").getPosition().z(), 5. - kG * h * h * n * (n + 1.) / 2., 1e-9);
  EXPECT_NEAR(simulation.get_frameVelocities()(0, 2), -kG * .5, 1e-9);
  EXPECT_NEAR(simulation.get_t(), .5, 1e-12);
}

TEST(SimulationLaws, ABallRestsOnTheGround) {
  Config C;
  addBall(C, .2, {0., 0., .25});
  Simulation simulation(C);
  run(simulation, 2.);
  EXPECT_NEAR(C.getFrame("ball").getPosition().z(), .2, 1e-4);
  EXPECT_LT(simulation.get_frameVelocities().norm(), 1e-6);
}

TEST(SimulationLaws, BoxesSlideAsCoulombSays) {
  for (const double degrees : {20., 30., 45.}) {
    const double angle = degrees * M_PI / 180., friction = .3;
    Config C;
    const Vector3d down = addSlope(C, angle, friction);
    const Quaterniond q(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
    C.addFrame("box", "", "shape: box, size: [.1 .1 .05], mass: 1, friction: .3")
        .setPose(Pose(Vector3d(0., 0., 3.) + q * Vector3d(-2., 0., .075), q));
    const Vector3d start = C.getFrame("box").getPosition();
    Simulation simulation(C);
    run(simulation, .5);
    const double way = (C.getFrame("box").getPosition() - start).dot(down);
    const double expected = .5 * kG * (std::sin(angle) - friction * std::cos(angle)) * .25;
    EXPECT_NEAR(way, expected, .01 * expected) << degrees;
  }
}

TEST(SimulationLaws, AnObjectHeldByFrictionDoesNotCreep) {
  const double angle = 20. * M_PI / 180.;
  Config C;
  addSlope(C, angle, .5);
  const Quaterniond q(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  C.addFrame("box", "", "shape: box, size: [.1 .1 .05], mass: 1, friction: .5")
      .setPose(Pose(Vector3d(0., 0., 3.) + q * Vector3d(0., 0., .075), q));
  Simulation simulation(C);
  run(simulation, 1.);
  const Vector3d start = C.getFrame("box").getPosition();
  run(simulation, 5.);
  EXPECT_LT((C.getFrame("box").getPosition() - start).norm(), 2e-6);
}

TEST(SimulationLaws, ABallRollsDownWithFiveSeventhsOfTheSlope) {
  const double angle = 20. * M_PI / 180.;
  Config C;
  const Vector3d down = addSlope(C, angle, 1.);
  const Quaterniond q(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  addBall(C, .05, Vector3d(0., 0., 3.) + q * Vector3d(-1., 0., .1));
  const Vector3d start = C.getFrame("ball").getPosition();
  SimulationOptions options;
  options.rolling_friction = 0.;
  Simulation simulation(C, SimulationEngine::physx, options);
  run(simulation, 1.);
  const double expected = .5 * 5. / 7. * kG * std::sin(angle);
  EXPECT_NEAR((C.getFrame("ball").getPosition() - start).dot(down), expected, .01 * expected);
}

TEST(SimulationLaws, APendulumKeepsItsEnergy) {
  Config C;
  C.addText(
      "hub: { X: [0 0 2] } arm (hub): { joint: hingeX, q: 1.5, noMotor: true } "
      "bob (arm): { Q: [0 0 -.5], shape: sphere, size: [.05], mass: 1 }");
  const auto energy = [&](const Simulation& s) {
    C.setJointState(s.get_q());
    return kineticEnergy(C.state(), C.inertias(), s.get_qDot()) + potentialEnergy(C.state(), C.inertias());
  };
  Simulation simulation(C);
  const double before = energy(simulation);
  double lowest = 3.;
  for (int i = 0; i < 500; ++i) {
    simulation.step();
    lowest = std::min(lowest, C.getFrame("bob").getPosition().z());
    EXPECT_NEAR(energy(simulation), before, .02) << simulation.get_t();  // of 4.9 J that it exchanges
  }
  EXPECT_NEAR(lowest, 1.5, 1e-3);
}

TEST(SimulationLaws, ATowerOfTenStandsStill) {
  Config C;
  for (int i = 0; i < 10; ++i) addBox(C, "box" + std::to_string(i), {0., 0., .03 + .06 * i});
  Simulation simulation(C);
  run(simulation, 1.);
  const Vector3d top = C.getFrame("box9").getPosition();
  EXPECT_NEAR(top.z(), .57, 1.5e-4);  // sags by .12 mm
  run(simulation, 4.);
  EXPECT_LT((C.getFrame("box9").getPosition() - top).norm(), 1e-5);
}

TEST(SimulationLaws, ABoxDoesNotSlipOnATurntable) {
  Config C;
  C.addText("hub: {} disc (hub): { joint: hingeZ, shape: cylinder, size: [.05 .6], mass: 1 }");
  addBox(C, "box", {.4, 0., .055});
  SimulationOptions options;
  options.ground = false;
  Simulation simulation(C, SimulationEngine::physx, options);
  MatrixXd velocity(1, 6);
  velocity << 0., .4, 0., 0., 0., 1.;
  simulation.pushConfigToSim(velocity, VectorXd::Constant(1, 1.));
  for (int i = 0; i < 500; ++i) simulation.step(VectorXd::Constant(1, 1.), .01, ControlMode::velocity);
  const Vector3d box = C.getFrame("box").getPosition();
  EXPECT_NEAR(box.head<2>().norm(), .4, 1e-5);
}

}  // namespace
}  // namespace kinegraph
