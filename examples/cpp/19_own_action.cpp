// Part 19: a custom action with two variants: an object in the hand is shown, high or low.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

void show(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
  const double height = variant == "high" ? 1.2 : .9;
  const MatrixXd only_z = Eigen::RowVector3d(0, 0, 10);
  w.komo().addObjective({time}, FS::position, {action[1]}, OT::eq, only_z, {0, 0, height});
}

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame cup = C.addFrame("cup", "table").setRelativePosition({-.3, .25, .1}).setJoint(JT::rigid);
  cup.setShape(ST::ssBox, {.05, .05, .1, .005}).setColor({1, .5, 0}).setContact(1);

  TaskOptions options;
  options.domain = defaultDomain();
  addAction(*options.domain, "show", {"Obj", "Hand"}, "(is_gripper Hand) (is_object Obj) (on Hand Obj)", "(shown Obj)");
  options.rules["show"] = {show, [](const Config&, const TaskAction&) {
                             return std::vector<std::string>{"high", "low"};
                           }};
  const TaskPlan plan = planTask(C, "(shown cup)", options);
  std::cout << plan.str() << "\n";
  return plan.feasible() ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
