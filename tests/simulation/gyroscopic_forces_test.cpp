#include <gtest/gtest.h>

#include "kinegraph/simulation/simulation.h"

namespace kinegraph {
namespace {

SimulationOptions inSpace() {
  SimulationOptions options;
  options.gravity = 0.;
  options.ground = false;
  return options;
}

/// A body of .5 kg without symmetry, its center at `center` in its frame.
struct Tumbling {
  Tumbling(const Vector3d& center, double spin) : C(make(center)), simulation(C, SimulationEngine::physx, inSpace()) {
    MatrixXd velocity(1, 6);
    velocity << 0., 0., 0., .3 * spin, spin, .2 * spin;
    simulation.pushConfigToSim(velocity, {});
  }
  static Config make(const Vector3d& center) {
    Config C;
    C.addFrame("body").setPosition({0., 0., 1.});
    C.addFrame("part", "body").setRelativePosition(center).setMass(.5, {.0008, .0010, .0016});
    return C;
  }
  Vector3d turn() const { return R().transpose() * simulation.get_frameVelocities().row(0).tail<3>().transpose(); }
  Matrix3d R() const { return C.getFrame("body").getRotationMatrix(); }
  double energy() const { return .5 * turn().dot(inertia.cwiseProduct(turn())); }
  Vector3d momentum() const { return R() * inertia.cwiseProduct(turn()); }
  Vector3d place() const { return C.getFrame("part").getPosition(); }

  Vector3d inertia{.0008, .0010, .0016};
  Config C;
  Simulation simulation;
};

TEST(GyroscopicForces, AFreeBodyKeepsItsEnergyAndItsAngularMomentum) {
  for (const Vector3d& center : {Vector3d(0., 0., 0.), Vector3d(.03, .02, .05)}) {
    for (const double spin : {10., 40., 100.}) {
      Tumbling body(center, spin);
      const double energy = body.energy(), h = body.simulation.options().inner_step;
      const Vector3d momentum = body.momentum();
      Vector3d first(0., 0., 0.), last(0., 0., 0.);
      for (int i = 0; i < 1000; ++i) {
        body.simulation.step({}, .01);
        // velocities are those of half a step before: both go around their values with h / 2 times the spin
        ASSERT_NEAR(body.energy(), energy, 2e-3 * energy) << spin << ", step " << i;
        ASSERT_LT((body.momentum() - momentum).norm(), h * spin * momentum.norm()) << spin << ", step " << i;
        if (i < 200) first += body.momentum() / 200.;
        if (i >= 800) last += body.momentum() / 200.;
      }
      EXPECT_LT((first - last).norm(), .1 * h * spin * momentum.norm()) << spin;
    }
  }
}

TEST(GyroscopicForces, TheCenterOfAFreeBodyGoesStraight) {
  Tumbling body({.03, .02, .05}, 40.);
  const Vector3d start = body.place();
  body.simulation.step({}, .01);
  const Vector3d velocity = (body.place() - start) / .01;
  for (int i = 1; i < 500; ++i) body.simulation.step({}, .01);
  EXPECT_LT((body.place() - start - 5. * velocity).norm(), 1e-9);
  EXPECT_GT(velocity.norm(), 1.);  // that of its frame was zero
}

TEST(GyroscopicForces, AFastTopOnAJointKeepsItsEnergy) {
  constexpr double lean = .4, mass = .5, length = .05, weight = mass * 9.81 * length;
  const Vector3d inertia(.00205, .00205, .0016);  // about the tip
  Config C;
  C.addText(
      "tip: { X: [0 0 1] } top (tip): { joint: quatBall, noMotor: true } "
      "disc (top): { Q: [0 0 .05], mass: .5, inertia: [.0008 .0008 .0016] }");
  const Quaterniond start(Eigen::AngleAxisd(lean, Vector3d::UnitX()));
  C.setJointState(wxyz(start));
  Simulation simulation(C);
  const auto rate = [](const Quaterniond& q, const Vector3d& turn) -> Vector4d {
    return wxyz(q * Quaterniond(0., .5 * turn.x(), .5 * turn.y(), .5 * turn.z()));
  };
  simulation.pushConfigToSim({}, rate(start, {5., 0., 100.}));
  const auto energy = [&] {
    const Vector4d q = simulation.get_q(), qDot = simulation.get_qDot();
    const Quaterniond p(q[0], q[1], q[2], q[3]), v(qDot[0], qDot[1], qDot[2], qDot[3]);
    const Vector3d turn = 2. * (p.conjugate() * v).vec();
    return .5 * turn.dot(inertia.cwiseProduct(turn)) + weight * (p * Vector3d::UnitZ()).z();
  };
  const double before = energy();
  for (int i = 0; i < 2000; ++i) {
    simulation.step({}, .01);
    ASSERT_NEAR(energy(), before, 1e-3 * before) << simulation.get_t();  // without: thousands of times that
  }
}

TEST(GyroscopicForces, AFlyingBaseWithAWheelStaysInBounds) {
  Config C;
  C.addText(
      "base: { X: [0 0 1], multibody: true, multibody_fixedBase: false, mass: 1, inertia: [.002 .003 .004] } "
      "wheel (base): { joint: hingeY, pre: [.1 0 0], noMotor: true, mass: .3, inertia: [.0005 .001 .0005] }");
  Simulation simulation(C, SimulationEngine::physx, inSpace());
  MatrixXd velocity(1, 6);
  velocity << 0., 0., 0., 12., 40., 8.;
  simulation.pushConfigToSim(velocity, VectorXd::Constant(1, 120.));
  const auto size = [&] { return simulation.get_frameVelocities().norm() + std::abs(simulation.get_qDot()[0]); };
  const double before = size();
  for (int i = 0; i < 1000; ++i) {
    simulation.step({}, .01);
    ASSERT_NEAR(size(), before, .01 * before) << simulation.get_t();  // without: not a number after 2 s
  }
}

TEST(GyroscopicForces, ABodyThatRotatesTooFastIsNamedOnce) {
  Tumbling body({0., 0., 0.}, 400.);
  body.simulation.step({}, .1);
  const std::vector<std::string> warnings = body.simulation.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("'body' rotates by more than .5 rad in an inner step of 0.002 s"), std::string::npos)
      << warnings[0];
  body.simulation.step({}, .1);
  EXPECT_TRUE(body.simulation.takeWarnings().empty());
}

}  // namespace
}  // namespace kinegraph
