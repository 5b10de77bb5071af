#include "kinegraph/kinematics/dynamics.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/scene/config.h"
#include "tests/kinematics/random_vector.h"

namespace kinegraph {
namespace {

Config sceneOf(const std::string& text) {
  Config config;
  config.addText(text);
  return config;
}

/// All kinds of joints in one tree, with bodies away from their joints.
Config tree() {
  return sceneOf(R"g(
    base: { X: "t(.1 .2 .3) d(40 1 2 3)" }
    a (base): { joint: hingeX, shape: box, size: [.2 .3 .4], mass: 2 }
    b (a): { pre: "t(0 .1 .5) d(30 0 1 1)", joint: transXYPhi, shape: capsule, size: [.4 .05], mass: 1 }
    b_tool (b): { Q: [.2 .1 .3], shape: box, size: [.1 .2 .1], mass: .7, inertia: [.01 .002 .001 .02 .003 .03] }
    c (b): { pre: [.1 .2 0], joint: quatBall, shape: ssBox, size: [.3 .2 .1 .01], mass: 1.5 }
    c_load (c): { Q: "t(.1 .2 .1) d(20 1 0 0)", shape: sphere, size: [.1], mass: .3 }
    d (a): { pre: [0 .3 0], joint: hinge, axis: [0 1 1], shape: box, size: [.5 .1 .1], mass: .8 }
    d_end (d): { Q: [.4 0 0], shape: sphere, size: [.05], mass: .4 }
    e (d): { pre: [.5 0 0], joint: hinge, axis: [1 0 0], mimic: d, shape: box, size: [.1 .1 .2], mass: .6 }
  )g");
}

double energy(Config& config, const VectorXd& q, const VectorXd& dq) {
  config.setJointState(q);
  return kineticEnergy(config.state(), config.inertias(), dq);
}

TEST(Dynamics, AHangingPointPendulumNeedsTheTorqueOfItsWeight) {
  Config pendulum = sceneOf("a: {}\nb (a): { joint: hingeX }\nc (b): { Q: [0 0 -.5], mass: 2, inertia: [0 0 0] }");
  const double q = .7;
  pendulum.setJointState(VectorXd::Constant(1, q));
  const EquationOfMotion equation = pendulum.equationOfMotion(VectorXd::Constant(1, 3.));
  EXPECT_NEAR(equation.M(0, 0), 2. * .25, 1e-12);
  EXPECT_NEAR(equation.F[0], 2. * 9.81 * .5 * std::sin(q), 1e-12);
}

TEST(Dynamics, MassesOffTheJointAreSeenThroughTheParallelAxisTheorem) {
  LinkInertia link;
  link.add({2., Vector3d(.1, 0., 0.), Matrix3d::Identity()}, RigidTransform{});
  link.add({2., Vector3d(-.1, 0., 0.), Matrix3d::Identity()}, RigidTransform{});
  EXPECT_DOUBLE_EQ(link.mass, 4.);
  EXPECT_NEAR(link.com.norm(), 0., 1e-15);
  EXPECT_TRUE(link.matrix.isApprox(Vector3d(2., 2.04, 2.04).asDiagonal().toDenseMatrix(), 1e-12));
}

TEST(Dynamics, KineticEnergyIsHalfTheQuadraticFormOfTheMassMatrix) {
  Config config = tree();
  Rng rng(1);
  for (int sample = 0; sample < 10; ++sample) {
    const VectorXd q = config.getJointState() + .5 * randomVector(config.getJointDimension(), rng);
    const VectorXd dq = randomVector(config.getJointDimension(), rng);
    const double T = energy(config, q, dq);
    const MatrixXd M = config.equationOfMotion(dq).M;
    EXPECT_TRUE(M.isApprox(M.transpose(), 1e-12));
    EXPECT_NEAR(.5 * dq.dot(M * dq), T, 1e-10 * T);
  }
}

TEST(Dynamics, ForcesFollowLagrange) {
  // F = dM/dt dq - d(dq' M dq / 2)/dq + dV/dq, by central differences.
  Config config = tree();
  const int n = config.getJointDimension();
  Rng rng(2);
  for (int sample = 0; sample < 5; ++sample) {
    const VectorXd q = config.getJointState() + .5 * randomVector(n, rng), dq = randomVector(n, rng);
    const auto massTimes = [&](const VectorXd& at) {
      config.setJointState(at);
      return VectorXd(config.equationOfMotion(dq).M * dq);
    };
    const auto potential = [&](const VectorXd& at) {
      config.setJointState(at);
      return potentialEnergy(config.state(), config.inertias());
    };
    const double h = 1e-5;
    VectorXd expected = (massTimes(q + h * dq) - massTimes(q - h * dq)) / (2. * h);
    for (int i = 0; i < n; ++i) {
      const VectorXd e = h * VectorXd::Unit(n, i);
      expected[i] +=
          (potential(q + e) - potential(q - e) - energy(config, q + e, dq) + energy(config, q - e, dq)) / (2. * h);
    }
    config.setJointState(q);
    EXPECT_LT((config.equationOfMotion(dq).F - expected).norm(), 1e-6 * (1. + expected.norm()));
    config.setJointState(tree().getJointState());
  }
}

TEST(Dynamics, NewtonEulerEqualsTheEquationOfMotion) {
  Config config = tree();
  const int n = config.getJointDimension();
  Rng rng(3);
  for (int sample = 0; sample < 10; ++sample) {
    config.setJointState(config.getJointState() + .2 * randomVector(n, rng));
    const VectorXd dq = randomVector(n, rng), ddq = randomVector(n, rng);
    const EquationOfMotion equation = config.equationOfMotion(dq);
    EXPECT_TRUE(config.inverseDynamics(dq, ddq).isApprox(equation.M * ddq + equation.F, 1e-10));
  }
}

TEST(Dynamics, AWrongNumberOfVelocitiesIsAnError) {
  Config config = tree();
  EXPECT_THROW(config.equationOfMotion(VectorXd::Zero(2)), ValueError);
}

}  // namespace
}  // namespace kinegraph
