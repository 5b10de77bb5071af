// Part 23: plans that improve with more evaluations; and an explanation if there is none.
#include <kinegraph/kinegraph.h>

#include <cmath>
#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame tray = C.addFrame("tray", "table").setRelativePosition({.35, .3, .055});
  tray.setShape(ST::ssBox, {.2, .2, .01, .004}).setColor({.3, .6, .3}).setContact(1);
  for (const auto& [name, x] : {std::pair("cup", -.3), std::pair("jug", 0.)}) {
    Frame thing = C.addFrame(name, "table").setRelativePosition({x, .3, .1}).setJoint(JT::rigid);
    thing.setShape(ST::ssBox, {.05, .05, .1, .005}).setColor({1, .5, 0}).setContact(1);
  }

  TaskPlans plans = planTasks(C, "(on tray cup) (on tray jug)", {.max_evaluations = 30000});
  double duration = INFINITY;
  bool improves = true;
  while (const auto plan = plans.next()) {
    std::cout << plan->duration() << " s after " << plan->evaluations << " evaluations\n";
    improves = improves && plan->duration() < duration;
    duration = plan->duration();
  }

  // The cup stands in a closed box.
  Frame lid = C.addFrame("lid", "table").setRelativePosition({-.3, .3, .19});
  lid.setShape(ST::ssBox, {.3, .3, .02, .004}).setColor({.7, .7, .9}).setContact(1);
  for (int k = 0; k < 4; ++k) {
    const bool along_x = k < 2;
    const double side = k % 2 == 0 ? -.1 : .1;
    Frame wall = C.addFrame("wall" + std::to_string(k), "table");
    wall.setRelativePosition({-.3 + (along_x ? side : 0), .3 + (along_x ? 0 : side), .115});
    wall.setShape(ST::ssBox, {along_x ? .02 : .2, along_x ? .2 : .02, .13, .004}).setColor({.7, .7, .9}).setContact(1);
  }
  const TaskPlan caged = planTask(C, "(on tray cup)");
  std::cout << caged.explain() << "\n" << caged.searchTree() << "\n";
  caged.view(C, false);  // shows a red copy of the arm at the nearest approach
  return improves && std::isfinite(duration) && !caged.feasible() ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
