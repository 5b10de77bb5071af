// Part 30: a cup goes into a closed drawer. The geometry alone implies that the drawer has to be opened first.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

struct Board {
  const char* name;
  Vector3d at, size;
};

void addBoards(Config& C, const char* parent, const std::vector<Board>& boards, double mass) {
  for (const auto& [name, at, size] : boards) {
    Frame board = C.addFrame(name, parent).setRelativePosition(at);
    board.setShape(ST::ssBox, {size.x(), size.y(), size.z(), .004}).setColor({.8, .6, .4, .6}).setContact(1);
    if (mass > 0) board.setMass(mass);
  }
}

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("cabinet", "table").setRelativePosition({.05, .45, .05});
  addBoards(C, "cabinet",
            {{"left", {-.14, .15, .08}, {.02, .3, .16}},
             {"right", {.14, .15, .08}, {.02, .3, .16}},
             {"back", {0, .31, .08}, {.3, .02, .16}},
             {"roof", {0, .16, .17}, {.3, .32, .02}}},
            0);

  // It has a joint of one dof with limits, and no motor, so a simulated hand can move it.
  Frame drawer = C.addFrame("drawer", "cabinet").setJoint(JT::transY, {-.2, 0}).setJointState(VectorXd::Zero(1));
  setAttributes(drawer, "logical: { is_drawer }, noMotor, jointFriction: 2.");
  addBoards(C, "drawer",
            {{"floor", {0, .14, .02}, {.24, .26, .02}},
             {"front", {0, -.01, .07}, {.25, .02, .12}},
             {"handle", {0, -.07, .1}, {.02, .02, .08}}},
            .2);
  Frame handle = C.getFrame("handle");
  setAttributes(handle, "logical: { is_handle }");

  Frame cup = C.addFrame("cup", "table").setRelativePosition({.4, .1, .09}).setJoint(JT::rigid);
  cup.setShape(ST::ssBox, {.04, .05, .08, .004}).setColor({1, .5, 0}).setContact(1).setMass(.1);

  const TaskPlan plan = planTask(C, "(on floor cup) (closed drawer)");
  std::cout << plan.str() << "\n";
  if (!plan.feasible()) return 1;

  BotOp bot(C);
  const TaskExecution run = plan.execute(bot);
  std::cout << run.str() << "\nthe drawer is " << doorStates(bot.getWorld()).at("drawer") << "\n";
  bot.getWorld().view(false, "put away");
  return run.feasible ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
