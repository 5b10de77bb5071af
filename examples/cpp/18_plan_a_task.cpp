// Part 18: from a goal to a motion. Objects in the way are put aside first. An impossible goal is explained.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame tray = C.addFrame("tray", "table").setRelativePosition({.25, .35, .055});
  tray.setShape(ST::ssBox, {.09, .09, .01, .004}).setColor({.3, .6, .3}).setContact(1);
  Frame cup = C.addFrame("cup", "table").setRelativePosition({-.3, .25, .1}).setJoint(JT::rigid);
  cup.setShape(ST::ssBox, {.05, .05, .1, .005}).setColor({1, .5, 0}).setContact(1);
  Frame jug = C.addFrame("jug", "tray").setRelativePosition({0, 0, .055}).setJoint(JT::rigid);
  jug.setShape(ST::ssBox, {.05, .05, .1, .005}).setColor({0, .5, 1}).setContact(1);

  const TaskPlan plan = planTask(C, "(on tray cup) (on table jug)");
  std::cout << plan.str() << "\n";
  if (!plan.feasible()) return 1;
  Config end = plan.scenes.back();  // with what is held at last attached
  end.setJointState(plan.eval(plan.duration()).q);
  end.view(true, "the cup is on the tray");
  const std::vector<std::string> wrong = checkTaskPlan(C, plan);

  // A custom action: the cup is shown.
  TaskOptions options;
  options.domain = defaultDomain();
  addAction(*options.domain, "show", {"Obj", "Hand"}, "(is_gripper Hand) (is_object Obj) (on Hand Obj)", "(shown Obj)");
  options.rules["show"] = {[](TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
                             const double height = variant == "high" ? 1.2 : .9;
                             w.komo().addObjective({time}, FS::position, {action[1]}, OT::eq,
                                                   MatrixXd(Eigen::RowVector3d(0, 0, 10)), {0, 0, height});
                           },
                           [](const Config&, const TaskAction&) {
                             return std::vector<std::string>{"high", "low"};
                           }};
  const TaskPlan shown = planTask(C, "(shown cup)", options);
  std::cout << shown.str() << "\n";

  // No motion achieves this, and the result explains the reason.
  C.addFrame("far", "table").setRelativePosition({0, 5, .055}).setShape(ST::ssBox, {.2, .2, .01, .004});
  const TaskPlan far = planTask(C, "(on far cup)");
  std::cout << far.str() << "\n";
  return wrong.empty() && shown.feasible() && far.status == TaskStatus::infeasible ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
