// Part 4: a manipulator of two links. Its joint angles determine the position of its end effector.
//
// The arm moves in the y-z plane of the world. With the angles (a, b, c) the end effector is at
//
//     y = .35 sin a + .33 sin(a + b),    z = .35 cos a + .33 cos(a + b),
//
// with the distances .35 and .33 m between its hinges. The third hinge only rotates the end effector.
#include <kinegraph/kinegraph.h>

#include <iostream>
#include <numbers>

using namespace kinegraph;
using std::numbers::pi;

Vector3d byHand(const VectorXd& q) {
  const double a = q[0], ab = q[0] + q[1];
  return {0, .35 * std::sin(a) + .33 * std::sin(ab), .35 * std::cos(a) + .33 * std::cos(ab)};
}

int main() try {
  Config C;
  C.addFile(SCENES "two_link_arm.g");
  const Frame end = C.getFrame("endeffector");
  std::cout << "frames:";
  for (const std::string& name : C.getFrameNames()) std::cout << " " << name;
  std::cout << "\nq has " << C.getJointDimension() << " entries: " << C.getJointState().transpose() << "\n";

  double worst = 0.;
  for (const Vector3d& q : {Vector3d(0, 0, 0), Vector3d(.3, .4, .5), Vector3d(pi / 2, 0, 0), Vector3d(-.5, 1.5, 0)}) {
    C.setJointState(q);
    const double difference = (end.getPosition() - byHand(q)).norm();
    std::cout << "q = " << q.transpose() << ": end effector at " << end.getPosition().transpose()
              << ", by hand the same to " << difference << " m\n";
    worst = std::max(worst, difference);
    C.view(true, "the arm in another configuration");
  }

  // A slow wave: every joint swings with its own phase.
  for (double t = 0; t < 2 * pi; t += .1) {
    C.setJointState(.6 * Vector3d(std::sin(t), std::sin(t + 1), std::sin(t + 2)));
    C.view();
  }
  return worst < 1e-9 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
