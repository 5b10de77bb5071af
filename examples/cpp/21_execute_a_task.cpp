// Plans a tower of three cubes, builds it with a simulated robot, and repairs it after a failure.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  const auto cube = [&](const std::string& name, double x, double y, const std::vector<double>& color) {
    Frame frame = C.addFrame(name, "table").setRelativePosition({x, y, .075}).setJoint(JT::rigid);
    frame.setShape(ST::ssBox, {.05, .05, .05, .004}).setColor(color).setContact(1).setMass(.1);
  };
  cube("red", -.3, .2, {1, .3, .2});
  cube("green", .3, .3, {.3, .8, .3});
  cube("blue", .1, .45, {.2, .4, 1});

  TaskPlan plan = planTask(C, "(on green red) (on blue green)");
  std::cout << plan.str() << "\n";
  std::cout << plan.duration() << " s; after 1 s the arm is at " << plan.eval(1.).q.transpose() << "\n";

  Config world = C;  // in the robot's world, one cube differs from the plan
  world.getFrame("blue").setRelativePosition({.1, .37, .075});
  BotOp bot(world);
  Config seen = worldOf(bot, plan);
  TaskRun run(plan, bot, seen);
  while (const auto event = run.next()) std::cout << event->str() << "\n";
  std::cout << run.result().str() << "\n";
  bot.getWorld().view(false, "the tower");
  return run.result().feasible ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
