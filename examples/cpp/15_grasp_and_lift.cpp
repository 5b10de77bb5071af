// Part 15: physics. A Panda grasps a box of 1 kg, lifts and rotates it, and the box does not slip.
//
// A Simulation moves the Config itself: motors move the joints along a reference, gravity and contacts the box.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

/// Returns joint values with the hand at a position, pointing down.
VectorXd reach(const Config& C, const Vector3d& position) {
  const IkResult result = solveIk(C, {IkTarget::toPosition("l_gripper", position),
                                      IkTarget::toDirection("l_gripper", Vector3d::UnitZ(), Vector3d::UnitZ()),
                                      IkTarget::toDirection("l_gripper", Vector3d::UnitY(), Vector3d::UnitX())});
  if (!result.feasible()) throw Error(result.str());
  return result.q;
}

Vector3d inHand(const Config& C) { return C.eval(FS::positionRel, {"box", "l_gripper"}).y; }

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  const Vector3d start(0., .3, .68);
  Frame box = C.addFrame("box").setShape(ST::ssBox, {.06, .06, .06, .005}).setPosition(start).setColor({1, .5, 0});
  box.setMass(1.);
  const VectorXd above = reach(C, start + Vector3d(0, 0, .12)), at = reach(C, start),
                 up = reach(C, start + Vector3d(0, 0, .2));
  VectorXd turned = up;
  turned[0] += 1.;
  C.setJointState(above);
  Simulation S(C);
  const auto go = [&](const VectorXd& q) {
    S.setSplineRef(q.transpose(), VectorXd::Ones(1));
    S.multi_step(1., .01);
  };

  go(at);
  S.closeGripper("l_gripper", 0., .3, 30.);
  while (!S.gripperIsDone("l_gripper")) S.step();
  std::cout << "fingers are apart by " << S.getGripperWidth("l_gripper") << " m\n";

  const Vector3d held = inHand(C);
  for (const VectorXd& q : {up, turned, up}) go(q);
  const double slip = 1e3 * (inHand(C) - held).norm();
  std::cout << "lifted and rotated; it has slipped by " << slip << " mm\n";

  const SimulationState state = S.getState();  // from here, the run repeats bit for bit
  go(at);
  const Vector3d first = box.getPosition();
  S.setState(state);
  go(at);
  const bool same = first == box.getPosition();
  S.moveGripper("l_gripper", .08);
  S.multi_step(.5, .01);
  std::cout << "put down at " << box.getPosition().transpose() << "\n";
  C.view(true, "the box is back");
  return slip < .05 && same && (box.getPosition() - start).norm() < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
