// Collision-free motions to a goal. If there is none, planMotion says why.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

namespace {

/// A base on wheels before a wall with a door.
Config room(double width) {
  Config C;
  C.addFrame("floor");
  C.addFrame("base", "floor").setJoint(JointType::transXYPhi, {-2., -2., -4., 2., 2., 4.});
  C.addFrame("body", "base").setShape(ShapeType::ssBox, {.5, .3, .4, .02}).setContact(1);
  for (const double side : {1., -1.}) {
    Frame wall = C.addFrame(side > 0. ? "left" : "right", "floor");
    wall.setShape(ShapeType::box, {.1, 3., 1.}).setRelativePosition({0., side * (1.5 + .5 * width), 0.}).setContact(1);
  }
  C.setJointState(VectorXd{{-1., 1.2, 1.57}});
  return C;
}

}  // namespace

int main() try {
  // Around a column, 1 cm from everything, to a target of the gripper.
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame column = C.addFrame("column", "table");
  column.setShape(ShapeType::ssBox, {.1, .1, .8, .02}).setRelativePosition({0., .35, .4}).setContact(1);
  VectorXd start = C.getJointState(), goal = start;
  start[0] -= .6;
  goal[0] += .6;
  const MotionPlan around = planMotion(C, goal, {.margin = .01}, start);
  std::cout << around.explain() << "\n";
  if (!around.feasible() || around.clearance() < .0099) return 1;
  const Config picture = around.picture(C);  // with the trees, the raw path and the path as lines
  std::cout << picture.getFrames().size() - C.getFrames().size() << " frames of lines\n";

  // To a position of the gripper: several configurations are goals.
  const MotionPlan reach = planMotion(C, MotionGoal({IkTarget::toPosition("l_gripper", {.35, .3, 1.})}), {}, start);
  std::cout << reach.str() << "\n";
  if (!reach.feasible()) return 1;

  // Through a door, and an impossible motion through a narrower one.
  for (const double width : {.5, .25}) {
    const MotionPlan plan = planMotion(room(width), VectorXd{{1., 1., 1.57}}, {.max_evaluations = 20000});
    std::cout << plan.str() << "\n";
    if (plan.feasible() != (width > .3)) return 1;
    if (!plan.feasible()) std::cout << "most motions ended at " << plan.obstacles.front().name << "\n";
  }
  return 0;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
