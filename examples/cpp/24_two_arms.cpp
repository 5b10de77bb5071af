// Part 24: two Pandas. One hands over an object to the other, which reaches the goal.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandasTable.g"));
  Frame rod = C.addFrame("rod", "table").setRelativePosition({-.75, .25, .15}).setJoint(JT::rigid);
  rod.setShape(ST::ssBox, {.04, .04, .2, .005}).setColor({1, .5, 0}).setContact(1);
  Frame pad = C.addFrame("pad", "table").setRelativePosition({.8, .2, .055});
  pad.setShape(ST::ssBox, {.12, .12, .01, .004}).setColor({.3, .6, .3}).setContact(1);

  const TaskPlan plan = planTask(C, "(on pad rod)");
  std::cout << plan.str() << "\n";
  if (!plan.feasible() || !checkTaskPlan(C, plan).empty()) return 1;
  plan.play(C);
  return 0;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
