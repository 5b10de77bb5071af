// Part 6: inverse kinematics as an optimization. Which joint angles bring the gripper to the target?
//
// Of all solutions, we want those near the present configuration and near home:
//
//     minimize  |.1 (q - q0)|^2 + |.1 (q - q_home)|^2   subject to   10 (gripper - target) = 0
#include <kinegraph/kinegraph.h>

#include <chrono>
#include <iostream>
#include <thread>

using namespace kinegraph;

const VectorXd kHome{{0., -.5, 0., -2., 0., 2., -.5}};

std::pair<VectorXd, SolverResult> inverseKinematics(const Config& C) {
  Komo komo(C, 1, 1, 0);  // one phase with one slice; positions only, no collisions
  komo.addObjective({}, FS::jointState, {}, OT::sos, .1, C.getJointState());
  komo.addObjective({}, FS::jointState, {}, OT::sos, .1, kHome);
  komo.addObjective({}, FS::positionDiff, {"l_gripper", "target"}, OT::eq, 10.);
  const SolverResult result = komo.solve();
  return {komo.getPath().row(0), result};
}

/// Distance of gripper and target in mm.
double gap(const Config& C) { return 1e3 * C.eval(FS::positionDiff, {"l_gripper", "target"}).y.norm(); }

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Frame target = C.addFrame("target", "table").setShape(ST::marker, {.1}).setRelativePosition({0, .3, .3});
  const Vector3d center = target.getPosition();
  C.view(true, "the target is the marker in front of the robot");

  const auto [q, result] = inverseKinematics(C);
  std::cout << "before: " << gap(C) << " mm; answer: " << result.str() << "\n";
  C.setJointState(q);
  std::cout << "after:  " << gap(C) << " mm, q = " << q.transpose() << "\n\n";
  C.view(true, "the gripper is at the target");

  // The target moves randomly; each solution starts from the previous one.
  Rng rng(0);
  bool reached = gap(C) < .1;
  Vector3d position = center;
  for (int i = 0; i < 20; ++i) {
    position = center + .98 * (position - center) + .02 * Vector3d(rng.normal(), rng.normal(), rng.normal());
    target.setPosition(position);
    const auto start = std::chrono::steady_clock::now();
    const auto [q, result] = inverseKinematics(C);
    const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
    C.setJointState(q);
    std::cout << "target " << position.transpose() << ": feasible " << result.feasible << ", " << gap(C) << " mm off, "
              << time.count() << " ms\n";
    C.view();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    reached = reached && result.feasible && gap(C) < .1;
  }
  return reached ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
