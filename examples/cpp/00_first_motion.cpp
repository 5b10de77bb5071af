// A first motion: a robot plans around a column, and follows the plan in simulation.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

/// Where the gripper has to be, in the world; the hand comes from above.
std::vector<IkTarget> above(double x, double y, double z) {
  return {IkTarget::toPosition("l_gripper", {x, y, z}),
          IkTarget::toDirection("l_gripper", Vector3d::UnitZ(), Vector3d::UnitZ())};
}

int main() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));                                             // a Panda at a table
  Frame column = C.addFrame("column", "table").setShape(ShapeType::ssBox, {.1, .1, .8, .02});  // m; radius of edges
  column.setRelativePosition({0., .35, .4}).setContact(1);  // without contact it would not be an obstacle

  const IkResult first = solveIk(C, above(-.35, .3, .9));
  std::cout << first.str() << "\n";
  C.setJointState(first.q);

  // 1 cm from everything, also between the samples
  const MotionPlan plan = planMotion(C, MotionGoal(above(.35, .3, .9)), {.margin = .01});
  std::cout << plan.str() << "\n";  // or the reason for which there is none
  std::cout << "least distance: " << plan.clearance() << " m\n";

  BotOp bot(C);  // a simulated robot in a copy of the scene
  bot.follow(plan);
  bot.wait(C);
  std::cout << "the gripper is at " << C.getFrame("l_gripper").getPosition().transpose() << "\n";
  C.viewPath(plan.path, plan.duration());  // plays the motion on a page in the browser
}
