// Part 17: waypoints for picking and placing a box, then the motions between them.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame box = C.addFrame("box", "table").setRelativePosition({-.25, .3, .11}).setJoint(JT::rigid);
  box.setShape(ST::ssBox, {.06, .05, .12, .005}).setColor({1, .5, 0}).setContact(1);
  Frame goal = C.addFrame("goal", "table").setRelativePosition({.3, .3, .055});
  goal.setShape(ST::ssBox, {.2, .2, .01, .004}).setColor({.3, .6, .3});

  ManipulationHelper m("pick and place");
  m.setup_pick_and_place_waypoints(C, "l_gripper", "box");
  m.grasp_box(1., "l_gripper", "box", "l_palm", "x");
  m.place_box(2., "box", "goal", "l_palm", "z");
  bool feasible = m.solve().feasible;

  for (const int phase : {0, 1}) {
    ManipulationHelper motion = m.sub_motion(phase);
    feasible = motion.solve().feasible && feasible;
    motion.komo->viewPlay();
  }
  return feasible ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
