#include "kinegraph/kinematics/velocity_dynamics.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/dynamics.h"
#include "tests/kinematics/random_vector.h"

namespace kinegraph {
namespace {

/// A floating base with joints of several kinds, one of which mimics another.
Config walker() {
  Config config;
  config.addText(R"g(
    world: {}
    base (world): { joint: free, Q: "t(.1 .2 .9) d(40 1 2 3)", shape: ssBox, size: [.3 .2 .2 .01], mass: 5 }
    hip (base): { pre: "t(.1 .1 -.1) d(30 0 1 1)", joint: quatBall, shape: capsule, size: [.4 .05], mass: 2 }
    knee (hip): { pre: [0 0 -.4], joint: hingeY, shape: capsule, size: [.4 .04], mass: 1 }
    foot (knee): { pre: [0 0 -.3], joint: hingeY, mimic: knee, shape: box, size: [.2 .1 .05], mass: .4 }
    tail (base): { pre: [-.2 0 0], joint: transXYPhi, shape: box, size: [.1 .1 .2], mass: .6, inertia: [.01 .002 .001 .02 .003 .03] }
  )g");
  return config;
}

VectorXd randomState(const Config& config, Rng& rng) {
  VectorXd q = randomVector(config.getJointDimension(), rng);
  for (const auto& range : config.state().model().unit_norms) q.segment(range.first, range.count).normalize();
  return q;
}

struct Sample {
  Config config = walker();
  VectorXd q, v;
  Rng rng;
  explicit Sample(int seed) : rng(std::uint64_t(seed)) {
    q = randomState(config, rng);
    config.setJointState(q);
    v = randomVector(velocityDimension(config), rng);
  }
  RigidBodyDynamics terms() const { return rigidBodyDynamics(config, v); }
};

TEST(VelocityDynamics, AFreeJointHasSixVelocitiesAndABallThree) {
  EXPECT_EQ(velocityDimension(walker()), 6 + 3 + 1 + 3);
  EXPECT_EQ(walker().getJointDimension(), 7 + 4 + 1 + 3);
}

TEST(VelocityDynamics, TheMapKeepsTheNormsOfQuaternions) {
  const Sample sample(1);
  const VectorXd dq = velocityMap(sample.config) * sample.v;
  for (const auto& range : sample.config.state().model().unit_norms)
    EXPECT_NEAR(sample.q.segment(range.first, range.count).dot(dq.segment(range.first, range.count)), 0., 1e-14);
}

TEST(VelocityDynamics, TermsAreThoseOfTheEquationOfMotionInQ) {
  for (int seed = 0; seed < 5; ++seed) {
    const Sample sample(seed);
    const MatrixXd T = velocityMap(sample.config);
    const EquationOfMotion inQ = sample.config.equationOfMotion(T * sample.v);
    const RigidBodyDynamics terms = sample.terms();
    EXPECT_NEAR((terms.M - T.transpose() * inQ.M * T).cwiseAbs().maxCoeff(), 0., 1e-11);
    EXPECT_NEAR((terms.C * sample.v + terms.g - T.transpose() * inQ.F).cwiseAbs().maxCoeff(), 0., 1e-10);
  }
}

TEST(VelocityDynamics, TheMassMatrixOfAFloatingBaseIsRegular) {
  const Sample sample(2);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(sample.terms().M);
  EXPECT_GT(principal.eigenvalues()[0], 1e-4);
}

TEST(VelocityDynamics, TheRateOfTheMassMatrixIsCoriolisPlusItsTranspose) {
  Sample sample(3);
  const RigidBodyDynamics terms = sample.terms();
  const VectorXd dq = velocityMap(sample.config) * sample.v;
  const double h = 1e-5;
  sample.config.setJointState(sample.q + h * dq);
  const MatrixXd after = sample.terms().M;
  sample.config.setJointState(sample.q - h * dq);
  const MatrixXd rate = (after - sample.terms().M) / (2. * h);
  EXPECT_NEAR((rate - terms.C - terms.C.transpose()).cwiseAbs().maxCoeff(), 0., 1e-6);
}

TEST(VelocityDynamics, TheLinearMomentumIsThatOfTheCenterOfMass) {
  Sample sample(4);
  const VectorXd momentum = centroidalMomentumMatrix(sample.config) * sample.v;
  const VectorXd dq = velocityMap(sample.config) * sample.v;
  const double h = 1e-6;
  sample.config.setJointState(sample.q + h * dq);
  const auto [mass, after] = sample.config.centerOfMass();
  sample.config.setJointState(sample.q - h * dq);
  const Vector3d velocity = (after - sample.config.centerOfMass().second) / (2. * h);
  EXPECT_NEAR((momentum.head<3>() - mass * velocity).norm(), 0., 1e-6);
}

TEST(VelocityDynamics, FreeFallKeepsTheAngularMomentumAboutTheCenterOfMass) {
  Sample sample(5);
  const RigidBodyDynamics terms = sample.terms();
  const VectorXd dv = terms.M.ldlt().solve(-terms.C * sample.v - terms.g), v = sample.v;
  const auto momentumAt = [&](double t) {  // to second order
    sample.config.setJointState(sample.q);
    const VectorXd middle = sample.q + .5 * t * (velocityMap(sample.config) * v);
    sample.config.setJointState(middle);
    sample.config.setJointState(sample.q + t * (velocityMap(sample.config) * (v + .5 * t * dv)));
    return VectorXd(centroidalMomentumMatrix(sample.config) * (v + t * dv));
  };
  const VectorXd rate = (momentumAt(1e-5) - momentumAt(-1e-5)) / 2e-5;
  EXPECT_NEAR(rate.tail<3>().norm(), 0., 1e-4);
  EXPECT_NEAR((rate.head<3>() - sample.config.centerOfMass().first * kGravity).norm(), 0., 1e-4);
}

TEST(VelocityDynamics, VelocitiesOfAnotherNumberAreAnError) {
  EXPECT_THROW(rigidBodyDynamics(walker(), VectorXd::Zero(15)), ValueError);
}

}  // namespace
}  // namespace kinegraph
