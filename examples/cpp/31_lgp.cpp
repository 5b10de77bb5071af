// Part 31: logic-geometric programs. A search in logic proposes plans, and waypoints decide whether an arm can execute
// them.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

/// A custom action, and waypoints without collisions.
class Grasps : public default_LGP_TAMP_Abstraction {
 public:
  using default_LGP_TAMP_Abstraction::DefaultLgpAbstraction;

  std::shared_ptr<KOMO> setup_sequence(const Config& scene, int K) override {
    const auto komo = default_LGP_TAMP_Abstraction::setup_sequence(scene, K);
    komo->addObjective({}, FS::accumulatedCollisions, {}, OT::eq, 1.);
    komo->addObjective({}, FS::jointLimits, {}, OT::ineq, 1.);
    return komo;
  }

  void add_action_constraints(const std::shared_ptr<KOMO>& komo, double time, const TaskAction& prev_action,
                              const TaskAction& action) override {
    if (action[0] != "grasp")
      return default_LGP_TAMP_Abstraction::add_action_constraints(komo, time, prev_action, action);
    const std::string &obj = action[1], &hand = action[3];
    KOMO_ManipulationHelper m;
    m.komo = komo;
    const std::string held = "held_" + obj + "_" + std::to_string(int(time));
    m.add_stable_frame(JT::free, hand, held);
    switchTo(m, time, held, obj);
    m.grasp_box(time, hand, obj, "l_palm", "y");
  }
};

int main() try {
  setLogSink(printMessage);
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  const auto tray = [&](const std::string& name, const Vector3d& at) {
    Frame frame = C.addFrame(name, "table", "logical: { is_place }").setRelativePosition(at);
    frame.setShape(ST::ssBox, {.07, .07, .01, .004});
  };
  const auto thing = [&](const std::string& name, const std::string& place) {
    Frame frame = C.addFrame(name, place, "logical: { is_object }").setRelativePosition({0, 0, .055});
    frame.setJoint(JT::rigid).setShape(ST::ssBox, {.06, .06, .1, .005}).setContact(1);
  };
  tray("trayG", {.4, .3, .055});
  tray("trayB", {-.3, .5, .055});
  tray("stand", {-.2, .25, .055});
  thing("objG", "stand");
  thing("objB", "trayG");  // target place of objG

  LGP_Tool lgp(C, std::make_shared<Grasps>(C, SCENES "31_lgp.lgp"));
  if (!lgp.solve()) throw Error(lgp.message);
  lgp.view_solved();
  lgp.solvePiecewiseMotions();
  const SolverReturn result = lgp.solveFullMotion();

  const Config end = lgp.getSolvedKOMO()->configuration(int(lgp.getSolvedPlan().size()) - 1);
  bool stands = true;
  for (const auto& [obj, place] : {std::pair{"objG", "trayG"}, std::pair{"objB", "trayB"}}) {
    const Vector3d off = end.getFrame(obj).getPosition() - end.getFrame(place).getPosition();
    std::cout << obj << " stands " << off.z() << " m above " << place << "\n";
    stands = stands && std::abs(off.z() - .055) < 1e-3;
  }
  return stands && result.feasible ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
