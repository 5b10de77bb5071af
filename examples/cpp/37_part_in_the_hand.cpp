// A part in the hand moves along a fixed tool.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("plate", "l_gripper").setShape(ShapeType::ssBox, {.16, .1, .01, .002}).setContact(-2);
  C.getFrame("plate").setRelativePosition({0., 0., -.05});
  C.addFrame("nozzle", "table").setShape(ShapeType::capsule, {.1, .01}).setContact(1);
  C.getFrame("nozzle").setRelativePosition({.1, .35, .1});
  C.addFrame("jet", "nozzle").setRelativePosition({0., 0., .08});

  // The nozzle moves in the coordinates of the plate.
  const std::vector<Vector3d> corners = {{-.06, -.03, -.01}, {.06, -.03, -.01}, {.06, .03, -.01}, {-.06, .03, -.01}};
  ToolPath bead("jet", "plate");
  bead.start(Pose(corners[0], Quaterniond::Identity())).free();
  for (const int k : {1, 2, 3, 0}) bead.line(corners[std::size_t(k)], .01);
  const ToolPathPlan plan =
      planToolPath(C, {bead}, {.speed = .1, .acceleration = VectorXd{{6.}}, .jerk = VectorXd{{120.}}});
  std::cout << plan.str() << "\n";
  if (!plan.feasible()) return 1;
  const Vector3d jet = C.getFrame("jet").getPosition();
  C.setJointState(plan.eval(.5 * plan.duration()).q);
  std::cout << "the jet has moved by " << (C.getFrame("jet").getPosition() - jet).norm() << " m\n";
  plan.view(C, {bead}, true);
  return 0;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
