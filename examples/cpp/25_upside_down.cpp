// Part 25: a box has to stand upside down. The wrist cannot turn it over in one grasp: it is laid on its side first.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFrame("table").setPosition({0, 0, .55}).setShape(ST::ssBox, {2, 2, .1, .02}).setContact(1);
  C.addFrame("base").setPosition({0, 0, .6});
  Frame carriage = C.addFrame("carriage", "base").setJoint(JT::trans3, {-.9, -.9, 0, .9, .9, 1});
  carriage.setJointState(Vector3d(0, 0, .5));
  Frame hand = C.addFrame("g_gripper", "carriage").setShape(ST::marker, {.05});
  setAttributes(hand, "opening: .09");
  hand.setJoint(JT::hingeX, {-1.66, 1.66}).setJointState(VectorXd::Zero(1));
  Frame palm = C.addFrame("g_palm", "g_gripper").setRelativePosition({0, 0, .08});
  palm.setShape(ST::ssBox, {.1, .2, .04, .004}).setColor({.5, .5, .5}).setContact(1);
  Frame box = C.addFrame("box", "table").setRelativePosition({.3, .2, .11}).setJoint(JT::rigid);
  box.setShape(ST::ssBox, {.07, .08, .12, .004}).setColor({1, .5, 0}).setContact(1);

  const TaskPlan plan = planTask(C, "(up zNeg box)");
  std::cout << plan.str() << "\n";
  if (!plan.feasible() || plan.actions.size() != 4) return 1;
  plan.play(C);
  const Vector3d z = C.getFrame("box").getPose().q * Vector3d::UnitZ();
  std::cout << "the box's z axis is now " << z.transpose() << "\n";
  return z.z() < -.99 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
