#include <gtest/gtest.h>

#include <random>

#include "kinegraph/simulation/simulation.h"

namespace kinegraph {
namespace {

/// Two arms with hands on slides over a table and the ground, a box that flies, and one on a ball joint.
Config arms() {
  Config C;
  C.addText(
      "table: { X: [0 0 .4], shape: ssBox, size: [1.2 1.2 .06 .01] } "
      "base: { X: [-.3 0 .62] } a (base): { joint: hingeZ, shape: capsule, size: [.1 .05], mass: 1 } "
      "b (a): { pre: \"t(0 0 .15)\", joint: hingeY, mass: 1 } b1 (b): { Q: [0 0 .2], shape: ssBox, size: [.06 .06 .3 "
      ".01] } "
      "c (b): { pre: \"t(0 0 .42)\", joint: hingeX, mass: 1 } c1 (c): { Q: [0 0 .15], shape: cylinder, size: [.2 .03] "
      "} "
      "d (c): { pre: \"t(0 0 .3)\", joint: transY, mass: .3, shape: ssCylinder, size: [.1 .03 .01] } "
      "base2: { X: [.35 0 .62] } e (base2): { joint: hingeZ, shape: capsule, size: [.1 .05], mass: 1 } "
      "f (e): { pre: \"t(0 0 .15)\", joint: hingeY, mass: 1 } f1 (f): { Q: [0 0 .25], shape: capsule, size: [.3 .04] } "
      "post: { X: [0 .4 .85] } swing (post): { joint: quatBall, noMotor: true } "
      "bob (swing): { Q: [0 0 .12], shape: ssBox, size: [.08 .08 .1 .01], mass: .2 } "
      "box: { X: [0 -.3 1.2], shape: ssBox, size: [.1 .08 .06 .01], mass: .3 }");
  return C;
}

/// Compares the contacts of each inner step with those of a search in another simulation of the same state.
TEST(ContactSearch, LeavesOutNoContact) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1., 1.);
  int with = 0, without = 0;
  for (int run = 0; run < 6; ++run) {
    Config C = arms(), D = arms();
    Simulation simulation(C), other(D);
    const long joints = simulation.get_qDot().size();
    VectorXd u = VectorXd::Zero(joints);
    for (int i = 0; i < 700; ++i) {
      if (i % 100 == 0) {
        for (double& x : u) x = 3. * uniform(random);
      }
      const SimulationState before = simulation.getState();
      simulation.advance(u, .002, ControlMode::velocity);
      const std::vector<Contact> found = simulation.getContacts();
      other.restore(before);
      const std::vector<Contact> all = other.getContacts();
      ASSERT_EQ(found.size(), all.size()) << "run " << run << ", step " << i;
      for (std::size_t k = 0; k < all.size(); ++k) EXPECT_NEAR(found[k].distance, all[k].distance, 1e-12);
      ++(all.empty() ? without : with);
    }
  }
  EXPECT_GT(with, 300);
  EXPECT_GT(without, 300);
}

}  // namespace
}  // namespace kinegraph
